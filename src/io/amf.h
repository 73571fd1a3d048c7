// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

namespace vantage {

/// Whether the bytes are XML whose first element is that of an AMF; of the whole file or its beginning.
bool is_amf(std::string_view bytes);

}  // namespace vantage
