// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "vantage/core/run_context.h"
#include "vantage/view/measure.h"

/// \file
/// Looks at a model and hands what it sees to measures.

namespace vantage {

/// Values of several measures: values[m][i] is that of measure m in view i.
using MeasureValues = std::vector<std::vector<double>>;

/// Measures views of one model by several measures, looking once for all of them. Holds references:
/// what the subject refers to must outlive it. Results do not depend on the number of threads.
class ViewMeasurer {
 public:
  /// \param level the set of views: the icosahedron split this often, 0–6. It is part of the
  ///              definition of measures that need the channel; these look at all of it here.
  /// \throw InvalidInput if a measure needs what the subject lacks. \throw Cancelled
  ViewMeasurer(const MeasureSubject& subject, std::vector<Measure> measures, int level = 3,
               const RunContext& run = {});
  ~ViewMeasurer();
  ViewMeasurer(ViewMeasurer&&) noexcept;             ///< Leaves the other unusable.
  ViewMeasurer& operator=(ViewMeasurer&&) noexcept;  ///< The same.

  [[nodiscard]] const std::vector<Measure>& measures() const;  ///< As given.
  [[nodiscard]] const MeasuredModel& model() const;            ///< What is known of the model.
  [[nodiscard]] const DirectionSet& set() const;               ///< The set of views.

  /// Values over the set; computed once. \throw Cancelled
  const MeasureValues& set_values(const RunContext& run = {});

  /// Values of any views: eyes inside the model and views that see nothing too. \throw Cancelled
  [[nodiscard]] MeasureValues values(std::span<const Viewpoint> eyes,
                                     const RunContext& run = {}) const;

  /// The same of directions, through the subject's camera.
  [[nodiscard]] MeasureValues values(std::span<const Vec3> directions,
                                     const RunContext& run = {}) const;

  /// Values of one measure alone, which looks at no more than it needs. \throw Cancelled
  [[nodiscard]] std::vector<double> values_of(std::size_t m, std::span<const Vec3> directions,
                                              const RunContext& run = {}) const;

  /// Whether the measure looks at faces and can be estimated by FaceDetail::ByCorners.
  [[nodiscard]] bool has_estimates(std::size_t m) const;

  /// These estimates. \pre has_estimates(m). \throw Cancelled
  [[nodiscard]] std::vector<double> estimates_of(std::size_t m, std::span<const Vec3> directions,
                                                 const RunContext& run = {}) const;

  /// Whether set_values() are there.
  [[nodiscard]] bool has_set_values() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace vantage
