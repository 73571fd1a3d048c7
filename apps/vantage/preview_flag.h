// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include <CLI/CLI.hpp>

#include "vantage/pipeline/shape_analysis.h"
#include "vantage/render/render.h"
#include "vantage/report/view_report.h"

#include "session.h"

namespace vantage::cli {

/// --preview: the picture in the terminal.
class PreviewFlag {
 public:
  void add_to(CLI::App& app);

  /// Prints the model as the camera sees it, if that was asked for and `--json` and `-q` were not.
  /// \throw Cancelled
  void show(Session& session, const ShapeAnalysis& shape, const Camera& camera,
            const ViewOptions& options, PictureLook look, const RunContext& run) const;

  /// Whether the picture is wanted.
  [[nodiscard]] bool is_given() const { return !protocol_.empty(); }

 private:
  std::string protocol_{};  // empty: no preview
};

}  // namespace vantage::cli
