// SPDX-License-Identifier: MIT
#include "orientation/evidence.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "orientation/outline_end.h"

namespace vantage {
namespace {

// A silhouette is cut into so many bands across the height.
constexpr std::size_t kBands = 8;
// The ends of a silhouette, and what lies behind them, shares of the length.
constexpr double kTip = 0.12;
constexpr double kNeck = 0.3;
// An origin this far from the box's centre says nothing, over the box's side.
constexpr double kFar = 0.6;

/// A silhouette from the side, by bands of height from the ground.
struct Bands {
  std::array<double, kBands> width{};   ///< Filled share of the band.
  std::array<double, kBands> runs{};    ///< Mean number of separate runs in its rows.
  std::array<double, kBands> middle{};  ///< Mean place along the row, share of the row.
  double mean_height = 0.0;             ///< Of the silhouette, share of the height.
};

/// \param field whose cells have `up` as one coordinate.
Bands bands_of(const HeightField& field, AxisDirection up) {
  const bool up_is_row = field.v_axis == up.axis;
  const std::size_t heights = up_is_row ? field.rows : field.columns;
  const std::size_t places = up_is_row ? field.columns : field.rows;
  Bands bands;
  std::array<double, kBands> filled{};
  std::array<double, kBands> cells{};
  std::array<double, kBands> lines{};
  double all = 0.0;
  for (std::size_t h = 0; h < heights; ++h) {
    const std::size_t line = up.is_positive ? h : heights - 1 - h;
    const std::size_t band = h * kBands / heights;
    bool was_filled = false;
    lines[band] += 1.0;
    for (std::size_t p = 0; p < places; ++p) {
      const bool is_filled =
          field.is_filled(up_is_row ? line * field.columns + p : p * field.columns + line);
      cells[band] += 1.0;
      if (is_filled) {
        filled[band] += 1.0;
        bands.runs[band] += was_filled ? 0.0 : 1.0;
        bands.middle[band] += (static_cast<double>(p) + 0.5) / static_cast<double>(places);
        bands.mean_height += (static_cast<double>(h) + 0.5) / static_cast<double>(heights);
        all += 1.0;
      }
      was_filled = is_filled;
    }
  }
  for (std::size_t b = 0; b < kBands; ++b) {
    bands.width[b] = cells[b] > 0.0 ? filled[b] / cells[b] : 0.0;
    bands.runs[b] = lines[b] > 0.0 ? bands.runs[b] / lines[b] : 0.0;
    bands.middle[b] = filled[b] > 0.0 ? bands.middle[b] / filled[b] : 0.5;
  }
  bands.mean_height = all > 0.0 ? bands.mean_height / all : 0.5;
  return bands;
}

double oriented(double share, AxisDirection direction) {
  return direction.is_positive ? share : 1.0 - share;
}

/// Mean of what is between the lowest and the highest surface of each cell of a field, and of its
/// cells, along one of the field's own coordinates or its heights; shares of the box's side.
struct Columns {
  double mass_along = 0.5;  ///< Mean height of the columns' mass.
  double mass_u = 0.5;      ///< Mean place of their mass.
  double mass_v = 0.5;
  double outline_u = 0.5;  ///< Mean place of the filled cells.
  double outline_v = 0.5;
  double high_u = 0.5;  ///< Of those cells that reach the upper half from the given side.
  double high_v = 0.5;
  double filled = 0.0;  ///< Share of the cells.
};

Columns columns_of(const HeightField& field, bool up_is_positive) {
  Columns result;
  double mass = 0.0;
  double along = 0.0;
  double cells = 0.0;
  double tall = 0.0;
  Columns sum;
  sum.mass_u = sum.mass_v = sum.outline_u = sum.outline_v = sum.high_u = sum.high_v = 0.0;
  for (std::size_t cell = 0; cell < field.low.size(); ++cell) {
    if (!field.is_filled(cell)) {
      continue;
    }
    const double u =
        (static_cast<double>(cell % field.columns) + 0.5) / static_cast<double>(field.columns);
    const std::size_t row = cell / field.columns;
    const double v = (static_cast<double>(row) + 0.5) / static_cast<double>(field.rows);
    const double low = field.low[cell];
    const double high = field.high[cell];
    const double here = high - low + 1e-3;  // sheets have mass, too
    mass += here;
    along += here * 0.5 * (low + high);
    sum.mass_u += here * u;
    sum.mass_v += here * v;
    sum.outline_u += u;
    sum.outline_v += v;
    cells += 1.0;
    if (field.depth(cell, up_is_positive) < 0.4 * field.extent) {
      sum.high_u += u;
      sum.high_v += v;
      tall += 1.0;
    }
  }
  if (cells > 0.0) {
    result.mass_along = field.extent > 0.0 ? along / mass / field.extent : 0.5;
    result.mass_u = sum.mass_u / mass;
    result.mass_v = sum.mass_v / mass;
    result.outline_u = sum.outline_u / cells;
    result.outline_v = sum.outline_v / cells;
    result.high_u = tall > 0.0 ? sum.high_u / tall : 0.5;
    result.high_v = tall > 0.0 ? sum.high_v / tall : 0.5;
    result.filled = cells / static_cast<double>(field.low.size());
  }
  return result;
}

Vec3 unit(AxisDirection direction) {
  return Vec3::Unit(static_cast<Eigen::Index>(direction.axis)) *
         (direction.is_positive ? 1.0 : -1.0);
}

double signed_part(const Vec3& vector, AxisDirection direction) {
  const double part = vector[static_cast<Eigen::Index>(direction.axis)];
  return direction.is_positive ? part : -part;
}

/// A part over the whole, 0 if there is next to nothing.
double share_of(double part, double whole) {
  return whole > 1e-3 ? part / whole : 0.0;
}

std::size_t index_of(AxisDirection direction) {
  return 2 * direction.axis + (direction.is_positive ? 0 : 1);
}

double log_ratio(double a, double b) {
  return std::log2((a + 0.01) / (b + 0.01));
}

}  // namespace

double value_of(std::string_view name, const Evidence& evidence) {
  return std::find_if(evidence.begin(), evidence.end(),
                      [&](const OrientationFeature& feature) { return feature.name == name; })
      ->value;
}

std::array<AxisDirection, 6> axis_directions() {
  return {{{0, true}, {0, false}, {1, true}, {1, false}, {2, true}, {2, false}}};
}

SideLooks::SideLooks(const TriMesh& surface, const TextureFlow& flow)
    : fields_(surface), traits_(surface), flow_(flow) {
  knows_origin_ = std::all_of(fields_.origin.begin(), fields_.origin.end(),
                              [](double share) { return std::abs(share - 0.5) <= kFar; });
  for (std::size_t axis = 0; axis < 3; ++axis) {
    looks_[2 * axis] = side_look(fields_, axis, true);
    looks_[2 * axis + 1] = side_look(fields_, axis, false);
    mirror_[axis] = mirror_error(fields_, axis);
    half_turn_[axis] = half_turn_error(fields_, axis);
    quarter_turn_[axis] = quarter_turn_error(fields_, axis);
  }
}

Evidence SideLooks::upright_evidence(AxisDirection up) const {
  const std::size_t a = (up.axis + 1) % 3;
  const std::size_t b = (up.axis + 2) % 3;
  const SideLook& base = look_from(up.opposite());
  const SideLook& top = look_from(up);
  const Columns columns = columns_of(fields_.along[up.axis], up.is_positive);
  const Bands one = bands_of(fields_.along[a], up);
  const Bands two = bands_of(fields_.along[b], up);
  const auto width = [&](std::size_t band) { return 0.5 * (one.width[band] + two.width[band]); };
  const auto runs = [&](std::size_t band) { return 0.5 * (one.runs[band] + two.runs[band]); };
  double side_touch = 0.0;
  double side_flat = 0.0;
  double side_detail = 0.0;
  double side_back = 0.0;
  double side_depth = 1.0;
  for (const AxisDirection side : axis_directions()) {
    if (side.axis != up.axis) {
      side_touch = std::max(side_touch, look_from(side).touch);
      side_flat = std::max(side_flat, look_from(side).flat);
      side_detail += 0.25 * look_from(side).detail;
      side_back += 0.25 * look_from(side).back;
      side_depth = std::min(side_depth, look_from(side).relative_depth);
    }
  }
  double narrowest = 1.0;
  double widest = 0.0;
  for (std::size_t band = 0; band < kBands; ++band) {
    narrowest = std::min(narrowest, width(band));
    widest = std::max(widest, width(band));
  }
  double taper = 0.0;
  double runs_taper = 0.0;
  for (std::size_t band = 0; band < kBands; ++band) {
    const double arm = (static_cast<double>(band) + 0.5) / static_cast<double>(kBands) - 0.5;
    taper += arm * width(band);
    runs_taper += arm * runs(band);
  }
  const SideTraits& upward = traits_of(up);
  const SideTraits& downward = traits_of(up.opposite());
  const double height = fields_.extent[up.axis];
  const auto k = static_cast<Eigen::Index>(up.axis);
  double wall_up = 0.0;
  double wall_area = 0.0;
  for (std::size_t s = 0; s < 6; ++s) {
    if (s / 2 != up.axis) {
      wall_up += signed_part(flow_.side[s].up, up);
      wall_area += flow_.side[s].area;
    }
  }
  return {
      {"base_touch", base.touch},
      {"top_touch", top.touch},
      {"base_hull", base.touch_hull},
      {"top_hull", top.touch_hull},
      {"base_margin", base.margin},
      {"top_margin", top.margin},
      {"base_contacts", base.contacts},
      {"top_contacts", top.contacts},
      {"base_depth", base.depth},
      {"top_depth", top.depth},
      {"base_relative", base.relative_depth},
      {"top_relative", top.relative_depth},
      {"base_detail", base.detail},
      {"top_detail", top.detail},
      {"base_flat", base.flat},
      {"top_flat", top.flat},
      {"height_least", log_ratio(height, std::min(fields_.extent[a], fields_.extent[b]))},
      {"height_most", log_ratio(height, std::max(fields_.extent[a], fields_.extent[b]))},
      {"area_height", oriented(fields_.area_mean[up.axis], up)},
      {"vertex_height", oriented(fields_.vertex_mean[up.axis], up)},
      {"mass_height", oriented(columns.mass_along, up)},
      {"outline_height", 0.5 * (one.mean_height + two.mean_height)},
      {"mirror_level", mirror_[up.axis]},
      {"mirror_least", std::min(mirror_[a], mirror_[b])},
      {"mirror_most", std::max(mirror_[a], mirror_[b])},
      {"half_turn", half_turn_[up.axis]},
      {"quarter_turn", quarter_turn_[up.axis]},
      {"parallel", fields_.parallel[up.axis]},
      {"perpendicular", fields_.perpendicular[up.axis]},
      {"parallel_rank",
       fields_.parallel[up.axis] - std::max(fields_.parallel[a], fields_.parallel[b])},
      {"filled", columns.filled},
      {"side_touch_most", side_touch},
      {"side_flat_most", side_flat},
      {"side_detail", side_detail},
      {"band_bottom", width(0)},
      {"band_low", 0.5 * (width(1) + width(2))},
      {"band_high", 0.5 * (width(kBands - 3) + width(kBands - 2))},
      {"band_top", width(kBands - 1)},
      {"runs_bottom", runs(0)},
      {"runs_low", 0.5 * (runs(1) + runs(2))},
      {"runs_high", 0.5 * (runs(kBands - 3) + runs(kBands - 2))},
      {"runs_top", runs(kBands - 1)},
      {"half_turn_side", std::min(half_turn_[a], half_turn_[b])},
      {"foot_spread", log_ratio(width(0), width(kBands / 2))},
      {"head_spread", log_ratio(width(kBands - 1), width(kBands / 2))},
      {"base_back", base.back},
      {"top_back", top.back},
      {"side_back", side_back},
      {"net", up.is_positive ? fields_.net[up.axis] : -fields_.net[up.axis]},
      {"waist_depth", side_depth},
      {"origin_height", knows_origin_ ? oriented(fields_.origin[up.axis], up) : 0.5},
      {"origin_aside", knows_origin_
                           ? std::abs(fields_.origin[a] - 0.5) + std::abs(fields_.origin[b] - 0.5)
                           : 2.0 * kFar},
      {"base_centre", base.centre_depth},
      {"base_rim", base.rim_depth},
      {"top_centre", top.centre_depth},
      {"top_rim", top.rim_depth},
      {"base_vertices",
       up.is_positive ? fields_.vertex_low[up.axis] : fields_.vertex_high[up.axis]},
      {"top_vertices", up.is_positive ? fields_.vertex_high[up.axis] : fields_.vertex_low[up.axis]},
      {"band_spread", widest - narrowest},
      {"water", top.water},
      {"base_water", base.water},
      {"rest", base.rest},
      {"base_patch", base.patch},
      {"facing", upward.facing},
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
      {"edges_along", traits_.axis[up.axis].edges_along},
      {"parts_height", oriented(traits_.axis[up.axis].parts_mean, up)},
      {"area_spread", traits_.axis[up.axis].area_spread},
      {"open_edges", traits_.open},
      {"parts", traits_.parts},
      {"taper", taper},
      {"runs_taper", runs_taper},
      {"dome", top.rim_depth - top.centre_depth},
      {"texture_up", share_of(signed_part(flow_.up, up), flow_.share)},
      {"texture_up_along", share_of(flow_.up_along[k], flow_.share)},
      {"texture_right_along", share_of(flow_.right_along[k], flow_.share)},
      {"wall_texture_up", share_of(wall_up, wall_area)}};
}

Evidence SideLooks::front_evidence(AxisDirection up, AxisDirection front) const {
  const std::size_t side = 3 - up.axis - front.axis;
  const SideLook& ahead = look_from(front);
  const SideLook& behind = look_from(front.opposite());
  const SideTraits& forward = traits_of(front);
  const SideTraits& backward = traits_of(front.opposite());
  const HeightField& plan = fields_.along[up.axis];
  const Columns columns = columns_of(plan, up.is_positive);
  const bool is_u = plan.u_axis == front.axis;
  const Bands profile = bands_of(fields_.along[side], up);  // places along the front's axis
  // Heights seen from the front, and from behind.
  const HeightField& depths = fields_.along[front.axis];
  double ahead_height = 0.0;
  double behind_height = 0.0;
  double near_ahead = 0.0;
  double near_behind = 0.0;
  for (std::size_t cell = 0; cell < depths.low.size(); ++cell) {
    if (!depths.is_filled(cell)) {
      continue;
    }
    const bool row_is_up = depths.v_axis == up.axis;
    const std::size_t row = cell / depths.columns;
    const double place = row_is_up
                             ? (static_cast<double>(row) + 0.5) / static_cast<double>(depths.rows)
                             : (static_cast<double>(cell % depths.columns) + 0.5) /
                                   static_cast<double>(depths.columns);
    const double height = oriented(place, up);
    const double limit = 0.25 * depths.extent;
    if (depths.depth(cell, front.is_positive) <= limit) {
      ahead_height += height;
      near_ahead += 1.0;
    }
    if (depths.depth(cell, !front.is_positive) <= limit) {
      behind_height += height;
      near_behind += 1.0;
    }
  }
  const HeightField& beside = fields_.along[side];
  const EndOfOutline tip = end_of(beside, front, up, 0.0, kTip);
  const EndOfOutline tail = end_of(beside, front.opposite(), up, 0.0, kTip);
  const EndOfOutline neck = end_of(beside, front, up, kTip, kNeck);
  const EndOfOutline rump = end_of(beside, front.opposite(), up, kTip, kNeck);
  const AxisDirection aside{side, true};
  const TextureFlow::Side& front_face = flow_.side[index_of(front)];
  const TextureFlow::Side& back_face = flow_.side[index_of(front.opposite())];
  const TextureFlow::Side& top_face = flow_.side[index_of(up)];
  const Vec3 to_right = unit(up).cross(unit(front));  // of who looks at the front
  const auto right_part = [&](const Vec3& vector) { return vector.dot(to_right); };
  const double extent = fields_.extent[front.axis];
  const auto place = [&](double u, double v) { return oriented(is_u ? u : v, front) - 0.5; };
  const auto middle = [&](std::size_t band) { return oriented(profile.middle[band], front) - 0.5; };
  const double low_middle = (middle(0) + middle(1) + middle(2)) / 3.0;
  const double high_middle = (middle(kBands - 3) + middle(kBands - 2) + middle(kBands - 1)) / 3.0;
  return {{"front_touch", ahead.touch},
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
          {"mirror_side", mirror_[side]},
          {"mirror_front", mirror_[front.axis]},
          {"half_turn", half_turn_[up.axis]},
          {"width_over_depth", log_ratio(fields_.extent[side], extent)},
          {"height_over_depth", log_ratio(fields_.extent[up.axis], extent)},
          {"area_ahead", oriented(fields_.area_mean[front.axis], front) - 0.5},
          {"vertex_ahead", oriented(fields_.vertex_mean[front.axis], front) -
                               oriented(fields_.area_mean[front.axis], front)},
          {"mass_ahead", place(columns.mass_u, columns.mass_v)},
          {"outline_ahead", place(columns.outline_u, columns.outline_v)},
          {"top_ahead", high_middle},
          {"foot_ahead", low_middle},
          {"middle_ahead", middle(kBands / 2)},
          {"parallel_front", fields_.parallel[front.axis]},
          {"parallel_side", fields_.parallel[side]},
          {"perpendicular_front", fields_.perpendicular[front.axis]},
          {"foot_to_top", high_middle - low_middle},
          {"high_ahead", place(columns.high_u, columns.high_v)},
          {"front_height", near_ahead > 0.0 ? ahead_height / near_ahead : 0.5},
          {"back_height", near_behind > 0.0 ? behind_height / near_behind : 0.5},
          {"foot_width_ahead", middle(0)},
          {"top_width_ahead", middle(kBands - 1)},
          {"floor_touch", look_from(up.opposite()).touch},
          {"front_back", ahead.back},
          {"back_back", behind.back},
          {"net_ahead", front.is_positive ? fields_.net[front.axis] : -fields_.net[front.axis]},
          {"front_margin", ahead.margin},
          {"back_margin", behind.margin},
          {"origin_ahead", knows_origin_ ? oriented(fields_.origin[front.axis], front) : 0.5},
          {"origin_aside", knows_origin_ ? std::abs(fields_.origin[side] - 0.5) : kFar},
          {"front_vertices",
           front.is_positive ? fields_.vertex_high[front.axis] : fields_.vertex_low[front.axis]},
          {"back_vertices",
           front.is_positive ? fields_.vertex_low[front.axis] : fields_.vertex_high[front.axis]},
          {"front_centre", ahead.centre_depth},
          {"back_centre", behind.centre_depth},
          {"front_rim", ahead.rim_depth},
          {"back_rim", behind.rim_depth},
          {"front_area", forward.area_end},
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
          {"parts_ahead", oriented(traits_.axis[front.axis].parts_mean, front) - 0.5},
          {"edges_front", traits_.axis[front.axis].edges_along},
          {"edges_side", traits_.axis[side].edges_along},
          {"open_edges", traits_.open},
          {"parts", traits_.parts},
          {"texture_up_ahead", share_of(signed_part(flow_.up, front), flow_.share)},
          {"texture_right", share_of(right_part(flow_.right), flow_.share)},
          {"front_texture", front_face.area},
          {"back_texture", back_face.area},
          {"front_texels", front_face.texels},
          {"back_texels", back_face.texels},
          {"front_texture_up", share_of(signed_part(front_face.up, up), front_face.area)},
          {"back_texture_up", share_of(signed_part(back_face.up, up), back_face.area)},
          {"front_texture_right", share_of(right_part(front_face.right), front_face.area)},
          {"back_texture_right", share_of(right_part(back_face.right), back_face.area)},
          {"top_texture_ahead", share_of(signed_part(top_face.up, front), top_face.area)},
          {"top_texture_right", share_of(right_part(top_face.right), top_face.area)},
          {"texture", flow_.share},
          {"tip_filled", tip.filled},
          {"tail_filled", tail.filled},
          {"tip_height", tip.height},
          {"tail_height", tail.height},
          {"neck_filled", neck.filled},
          {"rump_filled", rump.filled},
          {"neck_height", neck.height},
          {"rump_height", rump.height},
          {"tip_width", end_of(plan, front, aside, 0.0, kTip).filled},
          {"tail_width", end_of(plan, front.opposite(), aside, 0.0, kTip).filled},
          {"neck_width", end_of(plan, front, aside, kTip, kNeck).filled},
          {"rump_width", end_of(plan, front.opposite(), aside, kTip, kNeck).filled}};
}

double SideLooks::difference(AxisDirection up, AxisDirection front, AxisDirection other) const {
  if (front == other) {
    return 0.0;
  }
  return front.axis == other.axis ? std::min(half_turn_[up.axis], mirror_[front.axis])
                                  : quarter_turn_[up.axis];
}

}  // namespace vantage
