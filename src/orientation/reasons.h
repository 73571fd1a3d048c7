// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "orientation/evidence.h"

namespace vantage {

/// The two plainest things that speak for a direction being up, in words: "its flat base and its low
/// centre"; empty if there are none. \param evidence upright_evidence() of it.
std::string reasons_for_up(const Evidence& evidence);

/// The same of a direction being the front. \param evidence front_evidence() of it.
std::string reasons_for_front(const Evidence& evidence);

}  // namespace vantage
