// SPDX-License-Identifier: MIT
#include "vantage/view/view_set.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <utility>

#include "vantage/core/error.h"
#include "vantage/spatial/directions.h"

#include "core/unit_direction.h"
#include "view/cover.h"
#include "view/sphere_angles.h"

namespace vantage {
namespace {

// The table of candidates stays below this. [ours]: 2562 candidates up to 3.3 million vertices.
constexpr double kMostTableBytes = 1024.0 * 1024.0 * 1024.0;
// Refinement: half the 4° between candidates of level 4, down to what no picture shows. [ours]
constexpr double kFirstStepRad = 2.0 * kRadPerDeg;
constexpr double kLastStepRad = 0.1 * kRadPerDeg;
// Coverage is met within the rounding of the sums.
constexpr double kRounding = 1e-12;

int affordable_level(int wanted, std::size_t bits) {
  int level = wanted;
  const auto bytes = [&] {
    return (10.0 * std::ldexp(1.0, 2 * level) + 2.0) * static_cast<double>(bits) / 8.0;
  };
  while (level > 0 && bytes() > kMostTableBytes) {
    --level;
  }
  return level;
}

void check(const ViewSetOptions& options) {
  check_fields(options, kViewSetFields);
  if (options.coverage && !(*options.coverage > 0.0)) {
    throw InvalidInput("option coverage must be above 0");
  }
}

/// The significance of what some view sees, 0 elsewhere.
std::vector<double> reachable_significance(const VisibleSets& candidates, const VisibleSets& given,
                                           std::span<const double> significance) {
  std::vector<std::uint64_t> seen((significance.size() + 63) / 64, 0);
  for (const VisibleSets* sets : {&candidates, &given}) {
    for (std::size_t i = 0; i < sets->view_count(); ++i) {
      const auto row = sets->row(i);
      for (std::size_t w = 0; w < row.size(); ++w) {
        seen[w] |= row[w];
      }
    }
  }
  std::vector<double> reachable(significance.begin(), significance.end());
  for (std::size_t v = 0; v < reachable.size(); ++v) {
    if (((seen[v / 64] >> (v % 64)) & 1U) == 0) {
      reachable[v] = 0.0;
    }
  }
  return reachable;
}

/// What views in some directions see, a bit for each vertex, or some for each face.
using SetsOf = std::function<VisibleSets(std::span<const Vec3>, const RunContext&)>;

class Selection {
 public:
  Selection(SetsOf sets_of, std::size_t bits, const ViewSetOptions& options, const RunContext& run)
      : sets_of_(std::move(sets_of)), options_(options), bits_(bits), quiet_(run.quiet()) {}

  /// \param given the views to measure; if only one, the first of those to choose.
  ViewSet make(std::span<const Vec3> given, bool choose, std::span<const double> significance,
               const RunContext& run) {
    result_.level = affordable_level(options_.level, bits_);
    directions_ = direction_set(ViewSphereBase::Icosahedron, result_.level).directions;
    result_.candidates = directions_.size();
    result_.evaluations = directions_.size() + given.size();
    const VisibleSets candidates = sets_of_(directions_, run.part(0.0, kTableShare));
    const VisibleSets bits = sets_of_(given, quiet_);
    const auto weights = reachable_significance(candidates, bits, significance);
    for (const double w : weights) {
      result_.reachable += w;
    }
    GreedyCover cover(candidates, weights, quiet_);
    bound_.add_state(0.0, cover.gains(quiet_));
    result_.stop = ViewSetStop::Count;
    for (std::size_t i = 0; i < given.size() && !(options_.coverage && is_covered()); ++i) {
      add(cover, given[i], bits.row(i), cover.gain(bits.row(i)));
    }
    if (choose) {
      extend(cover, run);
    } else if (options_.coverage) {
      result_.stop = is_covered() ? ViewSetStop::Coverage : ViewSetStop::Exhausted;
    }
    bound_.add_state(seen_, cover.gains(quiet_));
    result_.least_views = bound_.least_views(seen_ * (1.0 - kRounding));
    if (result_.reachable > 0.0) {
      result_.most_coverage =
          std::min(1.0, bound_.most_covered(result_.views.size()) / result_.reachable);
    }
    return std::move(result_);
  }

 private:
  // Share of the progress bar that the table of candidates takes.
  static constexpr double kTableShare = 0.9;

  [[nodiscard]] bool is_apart(const Vec3& direction) const {
    return std::all_of(result_.views.begin(), result_.views.end(), [&](const ChosenView& view) {
      return angle_between(view.direction, direction) >=
             options_.min_separation_deg * kRadPerDeg * (1.0 - kRounding);
    });
  }

  void extend(GreedyCover& cover, const RunContext& run) {
    while (!finished()) {
      run.advance("views", kTableShare + (1.0 - kTableShare) * result_.views.back().coverage);
      const GreedyCover::Pick pick =
          cover.next([&](std::uint32_t i) { return is_apart(directions_[i]); });
      if (pick.view == GreedyCover::kNone) {
        result_.stop = ViewSetStop::Exhausted;
        return;
      }
      add_refined(cover, directions_[pick.view], pick.gain);
    }
  }

  bool finished() {
    if (options_.views && result_.views.size() >= static_cast<std::size_t>(*options_.views)) {
      result_.stop = ViewSetStop::Count;
      return true;
    }
    if (is_covered()) {
      // Coverage is the reason only if some was asked for.
      const bool is_by_count = options_.views && !options_.coverage;
      result_.stop = is_by_count ? ViewSetStop::Exhausted : ViewSetStop::Coverage;
      return true;
    }
    return false;
  }

  /// Whether there is a view, and all that is to be seen is seen.
  [[nodiscard]] bool is_covered() const {
    return !result_.views.empty() &&
           seen_ >= options_.coverage.value_or(1.0) * result_.reachable * (1.0 - kRounding);
  }

  void add(GreedyCover& cover, const Vec3& direction, std::span<const std::uint64_t> bits,
           double gain) {
    cover.mark_seen(bits);
    seen_ += gain;
    const double share = result_.reachable > 0.0 ? seen_ / result_.reachable : 1.0;
    result_.views.push_back({direction, gain, std::min(1.0, share)});
    // States after 1, 2, 4, … views: the tightest bound comes from an early one, its cost is a
    // pass.
    if (std::has_single_bit(result_.views.size())) {
      bound_.add_state(seen_, cover.gains(quiet_));
    }
  }

  void add_refined(GreedyCover& cover, Vec3 direction, double gain) {
    for (double step = kFirstStepRad; options_.refine && step >= kLastStepRad;) {
      const std::vector<Vec3> ring = ring_around(direction, step);
      const VisibleSets sets = sets_of_(ring, quiet_);
      result_.evaluations += ring.size();
      std::size_t best = ring.size();
      for (std::size_t i = 0; i < ring.size(); ++i) {
        const double value = is_apart(ring[i]) ? cover.gain(sets.row(i)) : 0.0;
        if (value > gain) {
          gain = value;
          best = i;
        }
      }
      if (best == ring.size()) {
        step *= 0.5;
      } else {
        direction = ring[best];
      }
    }
    const VisibleSets bits = sets_of_(std::span(&direction, 1), quiet_);
    add(cover, direction, bits.row(0), gain);
  }

  SetsOf sets_of_;
  const ViewSetOptions& options_;
  std::size_t bits_;
  RunContext quiet_;
  std::vector<Vec3> directions_{};
  ViewSet result_{};
  CoverBound bound_{};
  double seen_ = 0.0;
};

SetsOf sets_of(const VertexVisibility& visibility, const ScoringCamera& camera,
               std::size_t vertices) {
  return [&visibility, &camera, vertices](std::span<const Vec3> views, const RunContext& run) {
    return visible_sets(visibility, camera, views, vertices, run);
  };
}

SetsOf sets_of(const FaceVisibility& faces, const ScoringCamera& camera) {
  return [&faces, &camera](std::span<const Vec3> views, const RunContext& run) {
    return visible_sets(faces, camera, views, run);
  };
}

/// What each of a face's bits adds.
std::vector<double> bit_shares(std::span<const double> of_face) {
  std::vector<double> shares;
  shares.reserve(of_face.size() * kBitsAFace);
  for (const double all : of_face) {
    shares.insert(shares.end(), kBitsAFace, all / static_cast<double>(kBitsAFace));
  }
  return shares;
}

ViewSet chosen(SetsOf sets_of, std::span<const double> significance, const Vec3& first,
               const ViewSetOptions& options, const RunContext& run) {
  check(options);
  const Vec3 unit = unit_direction(first);
  return Selection(std::move(sets_of), significance.size(), options, run)
      .make(std::span(&unit, 1), true, significance, run);
}

ViewSet measured(SetsOf sets_of, std::span<const double> significance,
                 std::span<const Vec3> directions, const ViewSetOptions& options,
                 const RunContext& run) {
  check(options);
  if (directions.empty()) {
    throw InvalidInput("there must be at least one view to measure");
  }
  std::vector<Vec3> units(directions.begin(), directions.end());
  std::ranges::transform(units, units.begin(), unit_direction);
  return Selection(std::move(sets_of), significance.size(), options, run)
      .make(units, false, significance, run);
}

}  // namespace

ViewSet select_views(const VertexVisibility& visibility, std::span<const double> significance,
                     const ScoringCamera& camera, const Vec3& first, const ViewSetOptions& options,
                     const RunContext& run) {
  return chosen(sets_of(visibility, camera, significance.size()), significance, first, options,
                run);
}

ViewSet select_views(const FaceVisibility& faces, std::span<const double> of_face,
                     const ScoringCamera& camera, const Vec3& first, const ViewSetOptions& options,
                     const RunContext& run) {
  return chosen(sets_of(faces, camera), bit_shares(of_face), first, options, run);
}

ViewSet measure_views(const VertexVisibility& visibility, std::span<const double> significance,
                      const ScoringCamera& camera, std::span<const Vec3> directions,
                      const ViewSetOptions& options, const RunContext& run) {
  return measured(sets_of(visibility, camera, significance.size()), significance, directions,
                  options, run);
}

ViewSet measure_views(const FaceVisibility& faces, std::span<const double> of_face,
                      const ScoringCamera& camera, std::span<const Vec3> directions,
                      const ViewSetOptions& options, const RunContext& run) {
  return measured(sets_of(faces, camera), bit_shares(of_face), directions, options, run);
}

}  // namespace vantage
