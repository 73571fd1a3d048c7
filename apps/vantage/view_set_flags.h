// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

#include <CLI/CLI.hpp>

#include "vantage/pipeline/find_views.h"
#include "vantage/report/view_report.h"

#include "look_flags.h"
#include "method_flags.h"
#include "option_flags.h"
#include "output_folder.h"
#include "view_outputs.h"

namespace vantage::cli {

/// The flags of several views and the tour over them, and the files these make.
class ViewSetFlags {
 public:
  /// Adds the flags of the set, and those of the moving picture.
  void add_to(CLI::App& app);
  /// Adds the flags of the set alone.
  void add_set_to(CLI::App& app);

  /// What was asked for, if anything. \throw CLI::ValidationError if the flags do not fit together.
  [[nodiscard]] std::optional<ViewSetRequest> request();
  /// Refuses flags of the set where a method chooses none. \throw CLI::ValidationError
  void require_use(bool is_used);

  /// Whether a moving picture was asked for.
  [[nodiscard]] bool has_tour() const { return !tour_.empty(); }

  /// What was asked for, or `views` of them where no flag says how many.
  [[nodiscard]] ViewSetRequest request_or(int views);

  /// \throw CLI::ValidationError if the tour's file would be another one of the results.
  void check_names(const OutputFolder& output) const;

  /// Of --tour; empty: none.
  [[nodiscard]] const std::string& tour() const { return tour_; }

  /// Adds pictures and cameras of the set, and the moving camera, to the folder; writes --tour.
  void write(OutputFolder& output, const ShapeAnalysis& shape, ShapePictures& pictures,
             const ViewReport& report, UpAxis up, const ViewOptions& options,
             const RunContext& run) const;

 private:
  ViewSetRequest as_given();
  void forget_settings();
  void write_tour(OutputFolder& output, const ShapeAnalysis& shape, ShapePictures& pictures,
                  const ViewReport& report, UpAxis up, double margin_percent,
                  const RunContext& run) const;
  [[nodiscard]] double seconds(const ReportedViewSet& set) const;

  OptionFlags flags_{};
  std::string tour_{};
  CLI::Option* tour_option_ = nullptr;
  double seconds_ = 0.0;
  int fps_ = 15;
  int width_ = 480;
  int height_ = 360;
};

/// The options of a model of a batch: those of the method, and a set of views if one is asked for
/// or `kinds` has pictures of one.
ViewOptions view_options_of(MethodFlags& method, ViewSetFlags& several, const LookFlags& look,
                            const OutputKinds& kinds, std::uint64_t seed);

/// One line a view: where from, what it adds, how much is seen by then.
std::string view_set_table(const ReportedViewSet& set);

}  // namespace vantage::cli
