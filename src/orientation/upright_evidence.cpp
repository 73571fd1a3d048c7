// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <utility>

#include "orientation/evidence.h"
#include "orientation/silhouette.h"

namespace vantage {
namespace {

/// Evidence for one direction being up, group by group.
class UprightEvidence {
 public:
  UprightEvidence(const MeasuredSides& sides, AxisDirection up)
      : sides_(sides),
        fields_(sides.fields),
        up_(up),
        base_(sides.relief_of(up.opposite())),
        top_(sides.relief_of(up)),
        a_((up.axis + 1) % 3),
        b_((up.axis + 2) % 3),
        columns_(columns_of(fields_.along[up.axis], up.is_positive)),
        one_(bands_of(fields_.along[a_], up)),
        two_(bands_of(fields_.along[b_], up)) {}

  Evidence all() {
    add_stand();
    add_base_and_top();
    add_proportions();
    add_heights();
    add_symmetry();
    add_parallel_faces();
    add_sides();
    add_bands();
    add_origin();
    add_traits();
    add_texture();
    return std::move(evidence_);
  }

 private:
  void add(std::initializer_list<OrientationFeature> features) {
    evidence_.insert(evidence_.end(), features);
  }

  /// How it would stand on its base, and on its head: static stability.
  void add_stand() {
    add({{"base_touch", base_.touch},
         {"top_touch", top_.touch},
         {"base_hull", base_.touch_hull},
         {"top_hull", top_.touch_hull},
         {"base_margin", base_.margin},
         {"top_margin", top_.margin},
         {"base_contacts", base_.contacts},
         {"top_contacts", top_.contacts},
         {"rest", base_.rest},
         {"base_patch", base_.patch}});
  }

  /// What is seen from below and from above.
  void add_base_and_top() {
    add({{"base_depth", base_.depth},
         {"top_depth", top_.depth},
         {"base_relative", base_.relative_depth},
         {"top_relative", top_.relative_depth},
         {"base_detail", base_.detail},
         {"top_detail", top_.detail},
         {"base_flat", base_.flat},
         {"top_flat", top_.flat},
         {"base_back", base_.back},
         {"top_back", top_.back},
         {"base_centre", base_.centre_depth},
         {"base_rim", base_.rim_depth},
         {"top_centre", top_.centre_depth},
         {"top_rim", top_.rim_depth},
         {"dome", top_.rim_depth - top_.centre_depth},
         {"water", top_.water},
         {"base_water", base_.water}});
  }

  void add_proportions() {
    const double height = fields_.extent[up_.axis];
    add({{"height_least", log_ratio(height, std::min(fields_.extent[a_], fields_.extent[b_]))},
         {"height_most", log_ratio(height, std::max(fields_.extent[a_], fields_.extent[b_]))},
         {"filled", columns_.filled}});
  }

  /// Where area, vertices and mass are, from the ground.
  void add_heights() {
    const std::size_t axis = up_.axis;
    const bool is_positive = up_.is_positive;
    add({{"area_height", oriented(fields_.area_mean[axis], up_)},
         {"vertex_height", oriented(fields_.vertex_mean[axis], up_)},
         {"mass_height", oriented(columns_.mass_along, up_)},
         {"outline_height", 0.5 * (one_.mean_height + two_.mean_height)},
         {"base_vertices", is_positive ? fields_.vertex_low[axis] : fields_.vertex_high[axis]},
         {"top_vertices", is_positive ? fields_.vertex_high[axis] : fields_.vertex_low[axis]}});
  }

  void add_symmetry() {
    const auto& mirror = sides_.mirror;
    const auto& half_turn = sides_.half_turn;
    add({{"mirror_level", mirror[up_.axis]},
         {"mirror_least", std::min(mirror[a_], mirror[b_])},
         {"mirror_most", std::max(mirror[a_], mirror[b_])},
         {"half_turn", half_turn[up_.axis]},
         {"half_turn_side", std::min(half_turn[a_], half_turn[b_])},
         {"quarter_turn", sides_.quarter_turn[up_.axis]}});
  }

  void add_parallel_faces() {
    const auto& parallel = fields_.parallel;
    const double net = fields_.net[up_.axis];
    add({{"parallel", parallel[up_.axis]},
         {"perpendicular", fields_.perpendicular[up_.axis]},
         {"parallel_rank", parallel[up_.axis] - std::max(parallel[a_], parallel[b_])},
         {"net", up_.is_positive ? net : -net}});
  }

  /// Of the four sides around.
  void add_sides() {
    double touch = 0.0;
    double flat = 0.0;
    double detail = 0.0;
    double back = 0.0;
    double depth = 1.0;
    for (const AxisDirection side : axis_directions()) {
      if (side.axis != up_.axis) {
        const SideRelief& relief = sides_.relief_of(side);
        touch = std::max(touch, relief.touch);
        flat = std::max(flat, relief.flat);
        detail += 0.25 * relief.detail;
        back += 0.25 * relief.back;
        depth = std::min(depth, relief.relative_depth);
      }
    }
    add({{"side_touch_most", touch},
         {"side_flat_most", flat},
         {"side_detail", detail},
         {"side_back", back},
         {"waist_depth", depth}});
  }

  /// How wide, and how much divided, the silhouettes are from the ground to the top.
  void add_bands() {
    const auto width = [&](std::size_t band) {
      return 0.5 * (one_.width[band] + two_.width[band]);
    };
    const auto runs = [&](std::size_t band) { return 0.5 * (one_.runs[band] + two_.runs[band]); };
    double narrowest = 1.0;
    double widest = 0.0;
    double taper = 0.0;
    double runs_taper = 0.0;
    for (std::size_t band = 0; band < kBands; ++band) {
      const double arm = (static_cast<double>(band) + 0.5) / static_cast<double>(kBands) - 0.5;
      narrowest = std::min(narrowest, width(band));
      widest = std::max(widest, width(band));
      taper += arm * width(band);
      runs_taper += arm * runs(band);
    }
    add({{"band_bottom", width(0)},
         {"band_low", 0.5 * (width(1) + width(2))},
         {"band_high", 0.5 * (width(kBands - 3) + width(kBands - 2))},
         {"band_top", width(kBands - 1)},
         {"band_spread", widest - narrowest},
         {"taper", taper},
         {"foot_spread", log_ratio(width(0), width(kBands / 2))},
         {"head_spread", log_ratio(width(kBands - 1), width(kBands / 2))},
         {"runs_bottom", runs(0)},
         {"runs_low", 0.5 * (runs(1) + runs(2))},
         {"runs_high", 0.5 * (runs(kBands - 3) + runs(kBands - 2))},
         {"runs_top", runs(kBands - 1)},
         {"runs_taper", runs_taper}});
  }

  /// Where the coordinates' origin is.
  void add_origin() {
    const auto& origin = fields_.origin;
    const bool is_known = sides_.knows_origin;
    add({{"origin_height", is_known ? oriented(origin[up_.axis], up_) : 0.5},
         {"origin_aside", is_known ? std::abs(origin[a_] - 0.5) + std::abs(origin[b_] - 0.5)
                                   : 2.0 * MeasuredSides::kFar}});
  }

  /// Of faces, edges and parts.
  void add_traits() {
    const SideTraits& upward = sides_.traits_of(up_);
    const SideTraits& downward = sides_.traits_of(up_.opposite());
    const AxisTraits& along = sides_.traits.axis[up_.axis];
    add({{"facing", upward.facing},
         {"facing_down", downward.facing},
         {"facing_height", upward.facing_place},
         {"facing_down_depth", downward.facing_place},
         {"base_area", downward.area_end},
         {"top_area", upward.area_end},
         {"base_open", downward.open_end},
         {"top_open", upward.open_end},
         {"base_parts", downward.parts_end},
         {"top_parts", upward.parts_end},
         {"base_poles", downward.poles},
         {"top_poles", upward.poles},
         {"edges_along", along.edges_along},
         {"parts_height", oriented(along.parts_mean, up_)},
         {"area_spread", along.area_spread},
         {"open_edges", sides_.traits.open},
         {"parts", sides_.traits.parts}});
  }

  /// Which way the pictures on it lie.
  void add_texture() {
    const TextureFlow& flow = sides_.flow;
    const auto k = static_cast<Eigen::Index>(up_.axis);
    double wall_up = 0.0;
    double wall_area = 0.0;
    for (const AxisDirection side : axis_directions()) {
      if (side.axis != up_.axis) {
        wall_up += signed_part(flow.side[side.index()].up, up_);
        wall_area += flow.side[side.index()].area;
      }
    }
    add({{"texture_up", share_of(signed_part(flow.up, up_), flow.share)},
         {"texture_up_along", share_of(flow.up_along[k], flow.share)},
         {"texture_right_along", share_of(flow.right_along[k], flow.share)},
         {"wall_texture_up", share_of(wall_up, wall_area)}});
  }

  const MeasuredSides& sides_;
  const HeightFields& fields_;
  AxisDirection up_;
  const SideRelief& base_;
  const SideRelief& top_;
  std::size_t a_, b_;  // the level axes
  Columns columns_;    // upright ones
  Bands one_, two_;    // of the silhouettes along these
  Evidence evidence_{};
};

}  // namespace

Evidence upright_evidence(const MeasuredSides& sides, AxisDirection up) {
  return UprightEvidence(sides, up).all();
}

}  // namespace vantage
