// SPDX-License-Identifier: MIT
#include <cmath>
#include <initializer_list>
#include <utility>

#include <Eigen/Geometry>

#include "orientation/evidence.h"
#include "orientation/outline_end.h"
#include "orientation/silhouette.h"

namespace vantage {
namespace {

// The ends of a silhouette, and what lies behind them, shares of the length.
constexpr double kTip = 0.12;
constexpr double kNeck = 0.3;

/// Evidence for one direction being the front, group by group.
class FrontEvidence {
 public:
  FrontEvidence(const MeasuredSides& sides, AxisDirection up, AxisDirection front)
      : sides_(sides),
        fields_(sides.fields),
        up_(up),
        front_(front),
        back_(front.opposite()),
        side_(3 - up.axis - front.axis) {}

  Evidence all() {
    add_front_and_back();
    add_symmetry();
    add_proportions();
    add_places_ahead();
    add_profile();
    add_parallel_faces();
    add_near_heights();
    add_origin();
    add_traits();
    add_texture();
    add_ends();
    return std::move(evidence_);
  }

 private:
  void add(std::initializer_list<OrientationFeature> features) {
    evidence_.insert(evidence_.end(), features);
  }

  /// What is seen from the front and from behind.
  void add_front_and_back() {
    const SideRelief& ahead = sides_.relief_of(front_);
    const SideRelief& behind = sides_.relief_of(back_);
    add({{"front_touch", ahead.touch},
         {"back_touch", behind.touch},
         {"front_hull", ahead.touch_hull},
         {"back_hull", behind.touch_hull},
         {"front_contacts", ahead.contacts},
         {"back_contacts", behind.contacts},
         {"front_depth", ahead.relative_depth},
         {"back_depth", behind.relative_depth},
         {"front_detail", ahead.detail},
         {"back_detail", behind.detail},
         {"front_flat", ahead.flat},
         {"back_flat", behind.flat},
         {"front_back", ahead.back},
         {"back_back", behind.back},
         {"front_margin", ahead.margin},
         {"back_margin", behind.margin},
         {"front_centre", ahead.centre_depth},
         {"back_centre", behind.centre_depth},
         {"front_rim", ahead.rim_depth},
         {"back_rim", behind.rim_depth},
         {"floor_touch", sides_.relief_of(up_.opposite()).touch}});
  }

  void add_symmetry() {
    add({{"mirror_side", sides_.mirror[side_]},
         {"mirror_front", sides_.mirror[front_.axis]},
         {"half_turn", sides_.half_turn[up_.axis]}});
  }

  void add_proportions() {
    const double depth = fields_.extent[front_.axis];
    add({{"width_over_depth", log_ratio(fields_.extent[side_], depth)},
         {"height_over_depth", log_ratio(fields_.extent[up_.axis], depth)}});
  }

  /// How far area, vertices, mass and what is high are towards the front.
  void add_places_ahead() {
    const std::size_t axis = front_.axis;
    const bool is_positive = front_.is_positive;
    const HeightField& plan = fields_.along[up_.axis];
    const Columns columns = columns_of(plan, up_.is_positive);
    const auto place = [&](double u, double v) {
      return oriented(plan.u_axis == axis ? u : v, front_) - 0.5;
    };
    add({{"area_ahead", oriented(fields_.area_mean[axis], front_) - 0.5},
         {"vertex_ahead",
          oriented(fields_.vertex_mean[axis], front_) - oriented(fields_.area_mean[axis], front_)},
         {"mass_ahead", place(columns.mass_u, columns.mass_v)},
         {"outline_ahead", place(columns.outline_u, columns.outline_v)},
         {"high_ahead", place(columns.high_u, columns.high_v)},
         {"front_vertices", is_positive ? fields_.vertex_high[axis] : fields_.vertex_low[axis]},
         {"back_vertices", is_positive ? fields_.vertex_low[axis] : fields_.vertex_high[axis]}});
  }

  /// The silhouette from the side: where its foot and its head are.
  void add_profile() {
    const Bands profile = bands_of(fields_.along[side_], up_);
    const auto middle = [&](std::size_t band) {
      return oriented(profile.middle[band], front_) - 0.5;
    };
    const double low = (middle(0) + middle(1) + middle(2)) / 3.0;
    const double high = (middle(kBands - 3) + middle(kBands - 2) + middle(kBands - 1)) / 3.0;
    add({{"top_ahead", high},
         {"foot_ahead", low},
         {"middle_ahead", middle(kBands / 2)},
         {"foot_to_top", high - low},
         {"foot_width_ahead", middle(0)},
         {"top_width_ahead", middle(kBands - 1)}});
  }

  void add_parallel_faces() {
    const double net = fields_.net[front_.axis];
    add({{"parallel_front", fields_.parallel[front_.axis]},
         {"parallel_side", fields_.parallel[side_]},
         {"perpendicular_front", fields_.perpendicular[front_.axis]},
         {"net_ahead", front_.is_positive ? net : -net}});
  }

  void add_near_heights() {
    const NearHeights near = near_heights(fields_.along[front_.axis], up_, front_);
    add({{"front_height", near.ahead}, {"back_height", near.behind}});
  }

  /// Where the coordinates' origin is.
  void add_origin() {
    const auto& origin = fields_.origin;
    const bool is_known = sides_.knows_origin;
    add({{"origin_ahead", is_known ? oriented(origin[front_.axis], front_) : 0.5},
         {"origin_aside", is_known ? std::abs(origin[side_] - 0.5) : MeasuredSides::kFar}});
  }

  /// Of faces, edges and parts.
  void add_traits() {
    const SideTraits& forward = sides_.traits_of(front_);
    const SideTraits& backward = sides_.traits_of(back_);
    const SurfaceTraits& traits = sides_.traits;
    add({{"front_area", forward.area_end},
         {"back_area", backward.area_end},
         {"front_facing", forward.facing},
         {"back_facing", backward.facing},
         {"front_facing_place", forward.facing_place},
         {"back_facing_place", backward.facing_place},
         {"front_open", forward.open_end},
         {"back_open", backward.open_end},
         {"front_parts", forward.parts_end},
         {"back_parts", backward.parts_end},
         {"front_poles", forward.poles},
         {"back_poles", backward.poles},
         {"parts_ahead", oriented(traits.axis[front_.axis].parts_mean, front_) - 0.5},
         {"edges_front", traits.axis[front_.axis].edges_along},
         {"edges_side", traits.axis[side_].edges_along},
         {"open_edges", traits.open},
         {"parts", traits.parts}});
  }

  /// Which way the pictures on it lie.
  void add_texture() {
    const TextureFlow& flow = sides_.flow;
    const TextureFlow::Side& ahead = flow.side[front_.index()];
    const TextureFlow::Side& behind = flow.side[back_.index()];
    const TextureFlow::Side& above = flow.side[up_.index()];
    const Vec3 to_right = up_.vector().cross(front_.vector());  // of who looks at the front
    const auto right_part = [&](const Vec3& vector) { return vector.dot(to_right); };
    add({{"texture", flow.share},
         {"texture_up_ahead", share_of(signed_part(flow.up, front_), flow.share)},
         {"texture_right", share_of(right_part(flow.right), flow.share)},
         {"front_texture", ahead.area},
         {"back_texture", behind.area},
         {"front_texels", ahead.texels},
         {"back_texels", behind.texels},
         {"front_texture_up", share_of(signed_part(ahead.up, up_), ahead.area)},
         {"back_texture_up", share_of(signed_part(behind.up, up_), behind.area)},
         {"front_texture_right", share_of(right_part(ahead.right), ahead.area)},
         {"back_texture_right", share_of(right_part(behind.right), behind.area)},
         {"top_texture_ahead", share_of(signed_part(above.up, front_), above.area)},
         {"top_texture_right", share_of(right_part(above.right), above.area)}});
  }

  /// The outline's ends, as heads and tails are seen: from the side, and from above.
  void add_ends() {
    const HeightField& beside = fields_.along[side_];
    const HeightField& plan = fields_.along[up_.axis];
    const AxisDirection aside{side_, true};
    const EndOfOutline tip = end_of(beside, front_, up_, 0.0, kTip);
    const EndOfOutline tail = end_of(beside, back_, up_, 0.0, kTip);
    const EndOfOutline neck = end_of(beside, front_, up_, kTip, kNeck);
    const EndOfOutline rump = end_of(beside, back_, up_, kTip, kNeck);
    add({{"tip_filled", tip.filled},
         {"tail_filled", tail.filled},
         {"tip_height", tip.height},
         {"tail_height", tail.height},
         {"neck_filled", neck.filled},
         {"rump_filled", rump.filled},
         {"neck_height", neck.height},
         {"rump_height", rump.height},
         {"tip_width", end_of(plan, front_, aside, 0.0, kTip).filled},
         {"tail_width", end_of(plan, back_, aside, 0.0, kTip).filled},
         {"neck_width", end_of(plan, front_, aside, kTip, kNeck).filled},
         {"rump_width", end_of(plan, back_, aside, kTip, kNeck).filled}});
  }

  const MeasuredSides& sides_;
  const HeightFields& fields_;
  AxisDirection up_, front_, back_;
  std::size_t side_;  // the third axis
  Evidence evidence_{};
};

}  // namespace

Evidence front_evidence(const MeasuredSides& sides, AxisDirection up, AxisDirection front) {
  return FrontEvidence(sides, up, front).all();
}

}  // namespace vantage
