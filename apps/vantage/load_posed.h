// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "vantage/io/model.h"
#include "vantage/pipeline/view_options.h"

namespace vantage::cli {

class LookFlags;
class Session;

/// Reads a model and turns it as `options` say, which its sidecar completes first.
/// \param look of its pictures, which the sidecar completes too; null: there are none, and nothing that
///             only they show is read.
Model load_posed(Session& session, const std::string& path, ViewOptions& options, LookFlags* look);

}  // namespace vantage::cli
