// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <set>
#include <string>
#include <string_view>

#include "vantage/io/model.h"
#include "vantage/pipeline/find_views.h"
#include "vantage/report/view_report.h"

#include "output_folder.h"

/// \file
/// The files that hold the result of a view, and which of them are wanted.

namespace vantage::cli {

/// Names of the kinds of output that `--write` may ask for; view.json is always written.
class OutputKinds {
 public:
  /// Everything that `view` writes.
  static OutputKinds all();

  /// Parses "best,worst,map". \throw CLI::ValidationError for a kind that does not exist.
  static OutputKinds parse(const std::string& text);

  [[nodiscard]] bool has(std::string_view kind) const { return kinds_.contains(kind); }

  /// Whether any of them is made of pictures.
  [[nodiscard]] bool has_pictures() const;

  /// The kinds in a fixed order, joined by commas.
  [[nodiscard]] std::string text() const;

 private:
  std::set<std::string, std::less<>> kinds_{};
};

/// Adds the pictures among `kinds`, and to the report a warning if that of the best view shows next to nothing, a
/// note if that of the worst does. \return the best view's, if it is among them. \throw Cancelled
std::optional<Image> add_pictures(OutputFolder& output, const OutputKinds& kinds,
                                  ShapePictures& pictures, ViewReport& report,
                                  const ViewOptions& options, const RunContext& run);

/// Adds report.html if it is among `kinds`. \throw Cancelled
void add_report(OutputFolder& output, const OutputKinds& kinds, const Model& loaded,
                const ShapeAnalysis& shape, ShapePictures& pictures, const ViewReport& report,
                const ViewOptions& options, const RunContext& run);

/// Adds map, skeleton and cameras among `kinds`. \param file the model's file name.
void add_data(OutputFolder& output, const OutputKinds& kinds, const Model& loaded,
              const ShapeAnalysis& shape, const ViewReport& report, const std::string& file);

}  // namespace vantage::cli
