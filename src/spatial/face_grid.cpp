// SPDX-License-Identifier: MIT
#include "spatial/face_grid.h"

#include <cmath>
#include <limits>

namespace vantage {
namespace {

/// Faces a cell of the grid, on average, if all were the same size.
constexpr double kFacesPerCell = 2.0;
constexpr std::size_t kMostCellsAlong = 2048;  // along one side
/// Entries of the grid for each face, beyond which its cells are made larger: large faces that lie
/// over one another touch every cell, and thousands of them fill gigabytes [ours].
constexpr std::size_t kMostEntries = 64;
/// Rows of cells are taken this much wider, in cells, so that rounding loses no face.
constexpr double kSlack = 0.01;
constexpr double kBeyond = std::numeric_limits<double>::infinity();

}  // namespace

FaceGrid::FaceGrid(const TriMesh& mesh, std::span<const std::uint32_t> faces, const Box& box,
                   int up)
    : mesh_(&mesh), up_(up), low_(box.low) {
  const double width = box.size()[(up_ + 1) % 3];
  const double height = box.size()[(up_ + 2) % 3];
  const double rise = box.size()[up_];
  levels_ = rise > 0.0 ? kTopLevel / rise : 0.0;
  const double wanted = std::max(1.0, static_cast<double>(faces.size()) / kFacesPerCell);
  // A grid has few more cells than faces, however long and thin: there may be thousands of grids.
  const auto most_along =
      static_cast<double>(std::clamp<std::size_t>(faces.size(), 1, kMostCellsAlong));
  double cell_size =
      std::max(std::sqrt(width * height / wanted), std::max(width, height) / most_along);
  if (!(cell_size > 0.0)) {
    cell_size = 1.0;
  }
  while (!fill_cells(faces, width, height, cell_size)) {
    cell_size *= 2.0;
  }
}

double FaceGrid::faces_met() const {
  double squares = 0.0;
  for (std::size_t cell = 1; cell < offsets_.size(); ++cell) {
    const double faces = offsets_[cell] - offsets_[cell - 1];
    squares += faces * faces;
  }
  return entries_.empty() ? 0.0 : squares / static_cast<double>(entries_.size());
}

/// The cells that a face touches, and some beside it.
template <class Visit>
void FaceGrid::for_each_cell(const Triangle& t, const Visit& visit) const {
  // Cells grow with coordinates, so those of a face's box are between those of its corners.
  const auto a = cell_of(mesh_->positions[t[0]]);
  const auto b = cell_of(mesh_->positions[t[1]]);
  const auto c = cell_of(mesh_->positions[t[2]]);
  const auto [left, right] = std::minmax({a[0], b[0], c[0]});
  const auto [bottom, top] = std::minmax({a[1], b[1], c[1]});
  const bool slanted = right - left > 2 && top - bottom > 2;
  for (int y = bottom; y <= top; ++y) {
    const auto [first, last] = slanted ? cells_in_row(t, y) : std::array{left, right};
    for (int x = first; x <= last; ++x) {
      visit(static_cast<std::size_t>(y) * static_cast<std::size_t>(cells_[0]) +
            static_cast<std::size_t>(x));
    }
  }
}

/// Sorts the faces into cells of this size; false if they had more than kMostEntries for each face.
bool FaceGrid::fill_cells(std::span<const std::uint32_t> faces, double width, double height,
                          double cell_size) {
  cell_size_ = cell_size;
  cells_ = {static_cast<int>(width / cell_size_) + 1, static_cast<int>(height / cell_size_) + 1};
  offsets_.assign(static_cast<std::size_t>(cells_[0]) * static_cast<std::size_t>(cells_[1]) + 1, 0);
  const std::size_t most = kMostEntries * faces.size();
  std::size_t entries = 0;
  for (const std::uint32_t f : faces) {
    for_each_cell(mesh_->triangles[f], [&](std::size_t cell) {
      ++offsets_[cell + 1];
      ++entries;
    });
    if (entries > most) {
      return false;
    }
  }
  for (std::size_t cell = 1; cell < offsets_.size(); ++cell) {
    offsets_[cell] += offsets_[cell - 1];
  }
  entries_.resize(offsets_.back());
  std::vector<std::uint32_t> cursor(offsets_.begin(), offsets_.end() - 1);
  for (const std::uint32_t f : faces) {
    const Entry entry = entry_of(f);
    for_each_cell(mesh_->triangles[f], [&](std::size_t cell) { entries_[cursor[cell]++] = entry; });
  }
  return true;
}

FaceGrid::Entry FaceGrid::entry_of(std::uint32_t face) const {
  const Triangle& t = mesh_->triangles[face];
  const auto [low, high] =
      std::minmax({level_of(mesh_->positions[t[0]]), level_of(mesh_->positions[t[1]]),
                   level_of(mesh_->positions[t[2]])});
  return {face, low, high};
}

/// The first and the last cell of a row that the face's projection touches; a needle that lies askew
/// fills few of the cells of its box.
std::array<int, 2> FaceGrid::cells_in_row(const Triangle& t, int row) const {
  const int across = (up_ + 1) % 3;
  const int along = (up_ + 2) % 3;
  // Points beyond the grid count to its outermost cells.
  const double bottom = row == 0 ? -kBeyond : low_[along] + (row - kSlack) * cell_size_;
  const double top = row + 1 == cells_[1] ? kBeyond : low_[along] + (row + 1 + kSlack) * cell_size_;
  Vec3 left = Vec3::Constant(kBeyond);
  Vec3 right = Vec3::Constant(-kBeyond);
  const auto touch = [&](double x) {
    left[across] = std::min(left[across], x);
    right[across] = std::max(right[across], x);
  };
  for (std::size_t c = 0; c < 3; ++c) {
    const Vec3& p = mesh_->positions[t.at(c)];
    const Vec3& q = mesh_->positions[t.at((c + 1) % 3)];
    if (p[along] >= bottom && p[along] <= top) {
      touch(p[across]);
    }
    for (const double border : {bottom, top}) {
      if ((p[along] < border) != (q[along] < border)) {
        touch(p[across] + (border - p[along]) / (q[along] - p[along]) * (q[across] - p[across]));
      }
    }
  }
  const Vec3 margin = Vec3::Constant(kSlack * cell_size_);
  return {cell_of(left - margin)[0], cell_of(right + margin)[0]};
}

std::array<int, 2> FaceGrid::cell_of(const Vec3& p) const {
  std::array<int, 2> cell{};
  for (int a = 0; a < 2; ++a) {
    const int axis = (up_ + 1 + a) % 3;
    const double place = std::floor((p[axis] - low_[axis]) / cell_size_);
    const auto last = static_cast<double>(cells_.at(static_cast<std::size_t>(a)) - 1);
    // A place that is not a number counts to the first cell.
    cell.at(static_cast<std::size_t>(a)) =
        place > 0.0 ? static_cast<int>(std::min(place, last)) : 0;
  }
  return cell;
}

/// What of the segment lies in a slab of cells across one of the grid's two axes.
FaceGrid::Stretch FaceGrid::stretch_in(int slab, std::size_t axis, const Vec3& a,
                                       const Vec3& b) const {
  const int across = (up_ + 1 + static_cast<int>(axis)) % 3;
  const Vec3 way = b - a;
  const Vec3 margin = Vec3::Constant(kSlack * cell_size_);
  double enter = 0.0;
  double leave = 1.0;
  if (cell_of(a).at(axis) != cell_of(b).at(axis)) {
    const double border = low_[across] + slab * cell_size_ - a[across];
    const double s = (border - margin[across]) / way[across];
    const double t = (border + cell_size_ + margin[across]) / way[across];
    enter = slab == cell_of(a).at(axis) ? 0.0 : std::clamp(std::min(s, t), 0.0, 1.0);
    leave = slab == cell_of(b).at(axis) ? 1.0 : std::clamp(std::max(s, t), 0.0, 1.0);
  }
  const Vec3 in = a + enter * way;
  const Vec3 out = a + leave * way;
  return {.leave = leave, .low = in.cwiseMin(out) - margin, .high = in.cwiseMax(out) + margin};
}

}  // namespace vantage
