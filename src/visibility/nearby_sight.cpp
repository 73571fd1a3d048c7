// SPDX-License-Identifier: MIT
#include "visibility/nearby_sight.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include <Eigen/Geometry>

#include "visibility/segment.h"
#include "visibility/vertex_scene.h"

namespace vantage {
namespace {

constexpr std::uint32_t kNoSlot = ~std::uint32_t{0};
constexpr float kEndless = std::numeric_limits<float>::infinity();
// Eyes half as far again as those it is made for are covered, too. [ours]
constexpr double kBeyond = 1.5;
// Of the displacement in the picture: an eye that moves around the model also moves towards it,
// which a picture across its middle leaves out. [ours]
constexpr float kAllowance = 1.05F;
// Far more than the rounding of what the picture holds.
constexpr float kPictureRounding = 0x1p-15F;
// Sites asked about per cell. [ours]
constexpr double kSitesPerCell = 0.5;
constexpr std::uint32_t kMostCells = 512;  // along a side
// The eye must be outside of the model by this share of its depth, as for a flat grid. [ours]
constexpr double kLeastDepthShare = 1.0 / 64.0;

/// Whether a side that can be seen is turned to the eye, as EyeGrid tells it. \param sight from a
/// corner of the face to the eye.
bool is_turned_to(const Surface& surface, std::uint32_t face, const Vec3& sight) {
  constexpr double kEdgeOn = 0x1p-46;
  const double height = surface.area_vectors[face].dot(sight);
  const bool is_flat = !(std::abs(height) > kEdgeOn * surface.twice_areas[face] * sight.norm());
  return !is_flat && (height > 0.0 || surface.sides[face] == FaceSides::Both);
}

/// Pairs of a slot and a face, gathered by slot.
class Listed {
 public:
  void add(std::uint32_t slot, std::uint32_t face) { pairs_.emplace_back(slot, face); }

  /// The faces of slot s are faces[first[s]] … faces[first[s + 1] − 1], in the order of adding.
  void gather(std::size_t slots, std::vector<std::uint32_t>& first,
              std::vector<std::uint32_t>& faces) const {
    first.assign(slots + 1, 0);
    for (const auto& [slot, face] : pairs_) {
      ++first[slot + 1];
    }
    for (std::size_t s = 0; s < slots; ++s) {
      first[s + 1] += first[s];
    }
    faces.resize(pairs_.size());
    std::vector<std::uint32_t> next(first.begin(), first.end() - 1);
    for (const auto& [slot, face] : pairs_) {
      faces[next[slot]++] = face;
    }
  }

 private:
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs_{};
};

}  // namespace

struct NearbySight::Cells {
  float low_x = 0.0F, low_y = 0.0F, per_unit = 1.0F;
  std::uint32_t columns = 1, rows = 1;
  std::vector<std::uint32_t> first{}, slots{};  // of each cell
  std::vector<float> farthest{};                // the least nearness in each cell
  float farthest_of_all = kEndless;

  [[nodiscard]] std::uint32_t column(float x) const { return at(x - low_x, columns); }

  [[nodiscard]] std::uint32_t row(float y) const { return at(y - low_y, rows); }

 private:
  [[nodiscard]] std::uint32_t at(float offset, std::uint32_t count) const {
    return static_cast<std::uint32_t>(
        std::clamp(offset * per_unit, 0.0F, static_cast<float>(count - 1)));
  }
};

NearbySight::NearbySight(const VertexVisibility& visibility,
                         std::span<const std::uint32_t> vertices, std::span<const Viewpoint> eyes)
    : surface_(visibility.scene_->sight.surface()),
      middle_(eye_in_frame(eyes.front(), surface_.frame)) {
  for (const Viewpoint& eye : eyes.subspan(1)) {
    const Vec3 at = eye_in_frame(eye, surface_.frame).position;
    reach_ = std::max(reach_, kBeyond * (at - middle_.position).norm());
  }
  list_sites(vertices);
  if (!take_picture()) {
    reach_ = -1.0;  // covers nothing
    return;
  }
  list_faces(sort_sites());
}

void NearbySight::list_sites(std::span<const std::uint32_t> vertices) {
  slot_of_site_.assign(surface_.sites.size(), kNoSlot);
  for (const std::uint32_t v : vertices) {
    const std::uint32_t site = surface_.site_of_vertex[v];
    if (site != Surface::kNoSite && slot_of_site_[site] == kNoSlot) {
      slot_of_site_[site] = static_cast<std::uint32_t>(sites_.size());
      sites_.push_back(site);
    }
    slot_of_vertex_.push_back(site != Surface::kNoSite ? slot_of_site_[site] : kNoSlot);
  }
}

/// \return false where the middle eye is too near for a picture across.
bool NearbySight::take_picture() {
  const bool perspective = middle_.projection == Projection::Perspective;
  const double distance = middle_.position.norm();
  if (!(distance > 0.0)) {
    return false;
  }
  const Vec3 towards = middle_.position / distance;
  const Vec3 right = towards.unitOrthogonal();
  const Vec3 up = towards.cross(right);
  for (std::vector<float>* field : {&picture_.x, &picture_.y, &picture_.nearness}) {
    field->resize(surface_.sites.size());
  }
  for (std::size_t i = 0; i < surface_.sites.size(); ++i) {
    const Vec3& p = surface_.sites[i];
    const double rise = p.dot(towards);
    const double depth = perspective ? distance - rise : 1.0;
    if (!(depth > kLeastDepthShare * distance)) {
      return false;
    }
    picture_.x[i] = static_cast<float>(p.dot(right) / depth);
    picture_.y[i] = static_cast<float>(p.dot(up) / depth);
    picture_.nearness[i] = static_cast<float>(perspective ? 1.0 / depth : rise);
  }
  return true;
}

NearbySight::Cells NearbySight::sort_sites() const {
  Cells cells;
  if (sites_.empty()) {
    return cells;
  }
  float high_x = -kEndless;
  float high_y = -kEndless;
  cells.low_x = cells.low_y = kEndless;
  for (const std::uint32_t site : sites_) {
    cells.low_x = std::min(cells.low_x, picture_.x[site]);
    cells.low_y = std::min(cells.low_y, picture_.y[site]);
    high_x = std::max(high_x, picture_.x[site]);
    high_y = std::max(high_y, picture_.y[site]);
    cells.farthest_of_all = std::min(cells.farthest_of_all, picture_.nearness[site]);
  }
  const float side = std::max({high_x - cells.low_x, high_y - cells.low_y, kPictureRounding});
  const double wanted = std::sqrt(static_cast<double>(sites_.size()) / kSitesPerCell);
  cells.per_unit = static_cast<float>(std::min<double>(kMostCells - 1, wanted)) / side;
  cells.columns = static_cast<std::uint32_t>((high_x - cells.low_x) * cells.per_unit) + 1;
  cells.rows = static_cast<std::uint32_t>((high_y - cells.low_y) * cells.per_unit) + 1;
  cells.farthest.assign(std::size_t{cells.columns} * cells.rows, kEndless);
  Listed listed;
  for (std::uint32_t slot = 0; slot < sites_.size(); ++slot) {
    const std::uint32_t site = sites_[slot];
    const std::uint32_t cell =
        cells.row(picture_.y[site]) * cells.columns + cells.column(picture_.x[site]);
    listed.add(cell, slot);
    cells.farthest[cell] = std::min(cells.farthest[cell], picture_.nearness[site]);
  }
  listed.gather(cells.farthest.size(), cells.first, cells.slots);
  return cells;
}

/// Whether the face may be turned to one of the eyes, or its back can hide, too.
bool NearbySight::may_hide(std::uint32_t face) const {
  if (surface_.sides[face] == FaceSides::Both) {
    return true;
  }
  const Vec3& corner = surface_.sites[surface_.faces[face][0]];
  const Vec3 sight = middle_.projection == Projection::Perspective ? Vec3(middle_.position - corner)
                                                                   : middle_.position;
  return surface_.area_vectors[face].dot(sight) >= -reach_ * surface_.twice_areas[face];
}

/// Calls visit(slot) for each site asked about that the face may hide from one of the eyes.
template <class Visit>
void NearbySight::visit_behind(std::uint32_t face, const Cells& cells, const Visit& visit) const {
  const auto reach = kAllowance * static_cast<float>(reach_);
  const Triangle& t = surface_.faces[face];
  const auto [a, b, c] = t;
  const auto across = std::minmax({picture_.x[a], picture_.x[b], picture_.x[c]});
  const auto along = std::minmax({picture_.y[a], picture_.y[b], picture_.y[c]});
  const float nearest =
      std::max({picture_.nearness[a], picture_.nearness[b], picture_.nearness[c]}) +
      kPictureRounding;
  const float most = reach * (nearest - cells.farthest_of_all) + kPictureRounding;
  if (most < 0.0F) {
    return;
  }
  const auto is_behind = [&](std::uint32_t site, float x, float y) {
    const float aside = reach * (nearest - picture_.nearness[site]) + kPictureRounding;
    return aside > 0.0F && x > across.first - aside && x < across.second + aside &&
           y > along.first - aside && y < along.second + aside &&
           std::find(t.begin(), t.end(), site) == t.end();
  };
  const std::uint32_t last_column = cells.column(across.second + most);
  const std::uint32_t last_row = cells.row(along.second + most);
  for (std::uint32_t row = cells.row(along.first - most); row <= last_row; ++row) {
    for (std::uint32_t column = cells.column(across.first - most); column <= last_column;
         ++column) {
      const std::size_t cell = std::size_t{row} * cells.columns + column;
      if (!(cells.farthest[cell] < nearest)) {
        continue;
      }
      for (std::uint32_t k = cells.first[cell]; k < cells.first[cell + 1]; ++k) {
        const std::uint32_t site = sites_[cells.slots[k]];
        if (is_behind(site, picture_.x[site], picture_.y[site])) {
          visit(cells.slots[k]);
        }
      }
    }
  }
}

void NearbySight::list_faces(const Cells& cells) {
  Listed holding;
  Listed before;
  for (std::uint32_t f = 0; f < surface_.faces.size() && !sites_.empty(); ++f) {
    for (const std::uint32_t site : surface_.faces[f]) {
      if (slot_of_site_[site] != kNoSlot) {
        holding.add(slot_of_site_[site], f);
      }
    }
    if (may_hide(f)) {
      visit_behind(f, cells, [&](std::uint32_t slot) { before.add(slot, f); });
    }
  }
  holding.gather(sites_.size(), first_holding_, holding_);
  before.gather(sites_.size(), first_before_, before_);
}

bool NearbySight::covers(const Viewpoint& eye) const {
  return (eye_in_frame(eye, surface_.frame).position - middle_.position).norm() <= reach_;
}

bool NearbySight::is_seen(std::size_t slot, const Viewpoint& eye) const {
  const Vec3& point = surface_.sites[sites_[slot]];
  const Vec3 sight =
      eye.projection == Projection::Perspective ? Vec3(eye.position - point) : eye.position;
  const auto holding = std::span(holding_).subspan(first_holding_[slot],
                                                   first_holding_[slot + 1] - first_holding_[slot]);
  const bool is_turned = std::any_of(holding.begin(), holding.end(), [&](std::uint32_t f) {
    return is_turned_to(surface_, f, sight);
  });
  if (!is_turned) {
    return false;
  }
  const Segment segment = segment_to(point, eye);
  const auto before = std::span(before_).subspan(first_before_[slot],
                                                 first_before_[slot + 1] - first_before_[slot]);
  return std::none_of(before.begin(), before.end(), [&](std::uint32_t f) {
    const Triangle& t = surface_.faces[f];
    return segment.crosses(surface_.sites[t[0]], surface_.sites[t[1]], surface_.sites[t[2]],
                           surface_.twice_areas[f]);
  });
}

std::vector<std::uint8_t> NearbySight::seen(const Viewpoint& eye) const {
  const Viewpoint at = eye_in_frame(eye, surface_.frame);
  std::vector<std::uint8_t> of_slot(sites_.size(), 0);
  for (std::size_t slot = 0; slot < of_slot.size(); ++slot) {
    of_slot[slot] = is_seen(slot, at) ? 1 : 0;
  }
  std::vector<std::uint8_t> of_vertex;
  of_vertex.reserve(slot_of_vertex_.size());
  for (const std::uint32_t slot : slot_of_vertex_) {
    of_vertex.push_back(slot != kNoSlot ? of_slot[slot] : 0);
  }
  return of_vertex;
}

}  // namespace vantage
