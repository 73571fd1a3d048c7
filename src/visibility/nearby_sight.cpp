// SPDX-License-Identifier: MIT
#include "visibility/nearby_sight.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <Eigen/Geometry>

#include "visibility/vertex_scene.h"

namespace vantage {
namespace {

constexpr float kEndless = std::numeric_limits<float>::infinity();
// Eyes this much farther than those it is made for are covered, too. [ours]
constexpr double kBeyond = 1.001;
// Of the displacement in the picture: an eye that moves around the model also moves towards it,
// which a picture across its middle leaves out. [ours]
constexpr float kAllowance = 1.05F;
// Far more than the rounding of what the picture holds.
constexpr float kPictureRounding = 0x1p-15F;
// Far more than the rounding of a face's plane.
constexpr float kPlaneRounding = 0x1p-18F;
// Sites asked about per cell. [ours]
constexpr double kSitesPerCell = 0.5;
constexpr std::uint32_t kMostCells = 512;  // along a side
// The eye must be outside of the model by this share of its depth, as for a flat grid. [ours]
constexpr double kLeastDepthShare = 1.0 / 64.0;

/// A picture from the middle eye. What is nearer to the eye than a point of another nearness is
/// displaced, as another eye sees it, by the difference times how far that eye is away.
struct Picture {
  std::vector<float> x{}, y{}, nearness{};  // of each site
};

/// The picture; empty where the middle eye is too near for one across.
Picture picture_from(const Viewpoint& middle, const std::vector<Vec3>& sites) {
  const bool perspective = middle.projection == Projection::Perspective;
  const double distance = middle.position.norm();
  if (!(distance > 0.0)) {
    return {};
  }
  const Vec3 towards = middle.position / distance;
  const Vec3 right = towards.unitOrthogonal();
  const Vec3 up = towards.cross(right);
  Picture picture;
  for (std::vector<float>* field : {&picture.x, &picture.y, &picture.nearness}) {
    field->resize(sites.size());
  }
  for (std::size_t i = 0; i < sites.size(); ++i) {
    const Vec3& p = sites[i];
    const double rise = p.dot(towards);
    const double depth = perspective ? distance - rise : 1.0;
    if (!(depth > kLeastDepthShare * distance)) {
      return {};
    }
    const double shrink = 1.0 / depth;
    picture.x[i] = static_cast<float>(p.dot(right) * shrink);
    picture.y[i] = static_cast<float>(p.dot(up) * shrink);
    picture.nearness[i] = static_cast<float>(perspective ? shrink : rise);
  }
  return picture;
}

/// Chooses the faces that some eyes' sight of some sites depends on.
class FaceChooser {
 public:
  /// \param reach of the eyes around the middle one.
  FaceChooser(const Surface& surface, const Viewpoint& middle, double reach, const Picture& picture,
              const std::vector<std::uint8_t>& is_asked)
      : surface_(surface),
        eye_(middle.position.cast<float>()),
        is_bounded_(middle.projection == Projection::Perspective ? 1.0F : 0.0F),
        reach_(static_cast<float>(reach)),
        picture_(picture),
        is_asked_(is_asked) {
    sort_sites();
  }

  [[nodiscard]] std::vector<std::uint32_t> chosen() const;

 private:
  void sort_sites();
  void fill_cells();
  [[nodiscard]] bool may_hide(std::uint32_t face) const;
  [[nodiscard]] bool is_before_some(const Triangle& face) const;

  [[nodiscard]] std::uint32_t column(float x) const { return cell_at(x - low_x_, columns_); }

  [[nodiscard]] std::uint32_t row(float y) const { return cell_at(y - low_y_, rows_); }

  [[nodiscard]] std::uint32_t cell_at(float offset, std::uint32_t count) const {
    return static_cast<std::uint32_t>(
        std::clamp(offset * per_unit_, 0.0F, static_cast<float>(count - 1)));
  }

  const Surface& surface_;
  Eigen::Vector3f eye_;
  float is_bounded_;
  float reach_;
  const Picture& picture_;
  const std::vector<std::uint8_t>& is_asked_;
  std::vector<std::uint32_t> sites_{};  // asked about
  // The sites by the picture's cells.
  float low_x_ = kEndless, low_y_ = kEndless, per_unit_ = 1.0F;
  std::uint32_t columns_ = 1, rows_ = 1;
  std::vector<std::uint32_t> first_{}, sorted_{};  // of each cell
  std::vector<float> farthest_{};                  // the least nearness in each cell
  float farthest_of_all_ = kEndless;
};

void FaceChooser::sort_sites() {
  float high_x = -kEndless;
  float high_y = -kEndless;
  for (std::uint32_t site = 0; site < is_asked_.size(); ++site) {
    if (is_asked_[site] != 0) {
      sites_.push_back(site);
      low_x_ = std::min(low_x_, picture_.x[site]);
      low_y_ = std::min(low_y_, picture_.y[site]);
      high_x = std::max(high_x, picture_.x[site]);
      high_y = std::max(high_y, picture_.y[site]);
      farthest_of_all_ = std::min(farthest_of_all_, picture_.nearness[site]);
    }
  }
  if (sites_.empty()) {
    return;
  }
  const float side = std::max({high_x - low_x_, high_y - low_y_, kPictureRounding});
  const double wanted = std::sqrt(static_cast<double>(sites_.size()) / kSitesPerCell);
  per_unit_ = static_cast<float>(std::min<double>(kMostCells - 1, wanted)) / side;
  columns_ = static_cast<std::uint32_t>((high_x - low_x_) * per_unit_) + 1;
  rows_ = static_cast<std::uint32_t>((high_y - low_y_) * per_unit_) + 1;
  fill_cells();
}

void FaceChooser::fill_cells() {
  const std::size_t count = std::size_t{columns_} * rows_;
  const auto cell_of = [&](std::uint32_t site) {
    return std::size_t{row(picture_.y[site])} * columns_ + column(picture_.x[site]);
  };
  first_.assign(count + 1, 0);
  farthest_.assign(count, kEndless);
  for (const std::uint32_t site : sites_) {
    const std::size_t cell = cell_of(site);
    ++first_[cell + 1];
    farthest_[cell] = std::min(farthest_[cell], picture_.nearness[site]);
  }
  for (std::size_t cell = 0; cell < count; ++cell) {
    first_[cell + 1] += first_[cell];
  }
  sorted_.resize(sites_.size());
  std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
  for (const std::uint32_t site : sites_) {
    sorted_[next[cell_of(site)]++] = site;
  }
}

/// Whether the face may be turned to one of the eyes, or its back can hide, too.
bool FaceChooser::may_hide(std::uint32_t face) const {
  const FacePlanes& planes = surface_.planes;
  const float height = planes.x[face] * eye_.x() + planes.y[face] * eye_.y() +
                       planes.z[face] * eye_.z() - is_bounded_ * planes.offset[face];
  return height >= -reach_ - kPlaneRounding * (2.0F + eye_.norm()) ||
         surface_.sides[face] == FaceSides::Both;
}

/// Whether the face may hide one of the sites asked about from one of the eyes.
bool FaceChooser::is_before_some(const Triangle& face) const {
  const auto [a, b, c] = face;
  const float nearest =
      std::max({picture_.nearness[a], picture_.nearness[b], picture_.nearness[c]}) +
      kPictureRounding;
  const float reach = kAllowance * reach_;
  const float most = reach * (nearest - farthest_of_all_) + kPictureRounding;
  if (most < 0.0F) {
    return false;
  }
  const auto across = std::minmax({picture_.x[a], picture_.x[b], picture_.x[c]});
  const auto along = std::minmax({picture_.y[a], picture_.y[b], picture_.y[c]});
  const auto is_behind = [&](std::uint32_t site) {
    const float x = picture_.x[site];
    const float y = picture_.y[site];
    const float aside = reach * (nearest - picture_.nearness[site]) + kPictureRounding;
    return aside > 0.0F && x > across.first - aside && x < across.second + aside &&
           y > along.first - aside && y < along.second + aside &&
           std::find(face.begin(), face.end(), site) == face.end();
  };
  const std::uint32_t left = column(across.first - most);
  const std::uint32_t right = column(across.second + most);
  const std::uint32_t last_row = row(along.second + most);
  for (std::uint32_t r = row(along.first - most); r <= last_row; ++r) {
    for (std::size_t cell = std::size_t{r} * columns_ + left;
         cell <= std::size_t{r} * columns_ + right; ++cell) {
      if (farthest_[cell] < nearest && std::any_of(sorted_.begin() + first_[cell],
                                                   sorted_.begin() + first_[cell + 1], is_behind)) {
        return true;
      }
    }
  }
  return false;
}

std::vector<std::uint32_t> FaceChooser::chosen() const {
  std::vector<std::uint32_t> faces;
  for (std::uint32_t f = 0; f < surface_.faces.size() && !sites_.empty(); ++f) {
    const Triangle& face = surface_.faces[f];
    const bool holds = (is_asked_[face[0]] | is_asked_[face[1]] | is_asked_[face[2]]) != 0;
    if (holds || (may_hide(f) && is_before_some(face))) {
      faces.push_back(f);
    }
  }
  return faces;
}

}  // namespace

NearbySight::NearbySight(const VertexVisibility& visibility,
                         std::span<const std::uint32_t> vertices, std::span<const Viewpoint> eyes) {
  const Surface& surface = visibility.scene_->sight.surface();
  for (const std::uint32_t v : vertices) {
    site_of_vertex_.push_back(surface.site_of_vertex[v]);
  }
  make_part(surface, eyes);
}

NearbySight::NearbySight(const NearbySight& wider, std::span<const std::uint32_t> chosen,
                         std::span<const Viewpoint> eyes) {
  if (!wider.part_) {
    reach_ = -1.0;  // covers nothing, as the wider one
    return;
  }
  for (const std::uint32_t k : chosen) {
    site_of_vertex_.push_back(wider.site_of_vertex_[k]);
  }
  make_part(wider.part_->surface(), eyes);
}

/// Sites are those of the surface before, and those of its part after.
void NearbySight::make_part(const Surface& surface, std::span<const Viewpoint> eyes) {
  middle_ = eye_in_frame(eyes.front(), surface.frame);
  for (const Viewpoint& eye : eyes.subspan(1)) {
    const Vec3 at = eye_in_frame(eye, surface.frame).position;
    reach_ = std::max(reach_, kBeyond * (at - middle_.position).norm());
  }
  const Picture picture = picture_from(middle_, surface.sites);
  if (picture.x.empty()) {
    reach_ = -1.0;  // covers nothing
    return;
  }
  std::vector<std::uint8_t> is_asked(surface.sites.size(), 0);
  for (const std::uint32_t site : site_of_vertex_) {
    if (site != Surface::kNoSite) {
      is_asked[site] = 1;
    }
  }
  SurfacePart part =
      part_of(surface, FaceChooser(surface, middle_, reach_, picture, is_asked).chosen());
  for (const std::uint32_t site : part.site_of) {
    is_asked_.push_back(is_asked[site] != 0 ? Look::kTurned : 0);
  }
  for (std::uint32_t& site : site_of_vertex_) {
    site = site == Surface::kNoSite ? site : part.site_in_part[site];
  }
  part_ = std::make_unique<Sight>(std::move(part.surface));
}

bool NearbySight::covers(const Viewpoint& eye) const {
  return reach_ >= 0.0 &&
         (eye_in_frame(eye, part_->surface().frame).position - middle_.position).norm() <= reach_;
}

std::vector<std::uint8_t> NearbySight::seen(const Viewpoint& eye) const {
  Look look(*part_, eye_in_frame(eye, part_->surface().frame), {.max_threads = 1});
  std::vector<std::uint8_t> asked = look.faces_at_sites();
  for (std::size_t site = 0; site < asked.size(); ++site) {
    asked[site] &= is_asked_[site];
  }
  const std::vector<std::uint8_t> of_site = look.not_hidden(std::move(asked));
  std::vector<std::uint8_t> of_vertex;
  of_vertex.reserve(site_of_vertex_.size());
  for (const std::uint32_t site : site_of_vertex_) {
    of_vertex.push_back(site != Surface::kNoSite ? of_site[site] : 0);
  }
  return of_vertex;
}

}  // namespace vantage
