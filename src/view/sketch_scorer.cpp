// SPDX-License-Identifier: MIT
#include "view/sketch_scorer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

#include <Eigen/Geometry>

#include "core/parallel.h"
#include "core/wide_registers.h"

// Functions that take or give wide registers are inlined, all of them: nobody else calls them.
#pragma GCC diagnostic ignored "-Wpsabi"

namespace vantage {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
// A face's plane is followed so many slacks beyond its nearness in the middle of a cell. [ours]
constexpr float kReach = 4.0F;
// The eye is drawn from so many radii at least and, up to so many, in perspective: nearer, what is
// close to it would fill thousands of pictures, and farther, depths would round to one another. The
// range of --distance begins there, too; at the far end an eye is off the parallel by 0.06°. [ours]
constexpr double kNearestEye = 1.001;
constexpr double kFarthestEye = 1000.0;
// Nothing is drawn nearer to the eye: what the sphere encloses is not. [ours]
constexpr float kLeastDepth = 0.0009F;
// Corners farther outside count as so many cells away. [ours]
constexpr float kFarOutside = 1e6F;
// Numbers worked on at a time on every machine, as a row of a face's cells is hardly ever longer.
constexpr unsigned kLanes = 4;
constexpr std::size_t kGrain = 16;  // directions a chunk: some tenths of a millisecond

template <unsigned Lanes>
using FloatsOf = typename Registers<Lanes>::Floats;
template <unsigned Lanes>
using IntsOf = typename Registers<Lanes>::Truths;
using Floats = FloatsOf<kLanes>;
using Ints = IntsOf<kLanes>;

template <class Floats>
VANTAGE_INLINE Floats load(const float* from) {
  Floats values;
  std::memcpy(&values, from, sizeof values);
  return values;
}

template <class Numbers, class Number>
VANTAGE_INLINE void store(const Numbers& values, Number* to) {
  std::memcpy(to, &values, sizeof values);
}

/// Whether it is true in one of the lanes.
template <class Truths>
VANTAGE_INLINE bool any_of(const Truths& truths) {
  std::array<std::uint64_t, sizeof(Truths) / sizeof(std::uint64_t)> pairs{};
  std::memcpy(pairs.data(), &truths, sizeof pairs);
  std::uint64_t any = 0;
  for (const std::uint64_t pair : pairs) {
    any |= pair;
  }
  return any != 0;
}

template <class Floats>
VANTAGE_INLINE Floats smaller(const Floats& a, const Floats& b) {
  return b < a ? b : a;
}

template <class Floats>
VANTAGE_INLINE Floats larger(const Floats& a, const Floats& b) {
  return a < b ? b : a;
}

/// How far the eye is over the planes of some cones.
template <class Floats>
VANTAGE_INLINE Floats height_over(const SketchPoints::Cones& cones, std::size_t i,
                                  const Eigen::Vector3f& eye) {
  return load<Floats>(cones.axis.x.data() + i) * eye.x() +
         load<Floats>(cones.axis.y.data() + i) * eye.y() +
         load<Floats>(cones.axis.z.data() + i) * eye.z() - load<Floats>(cones.offset.data() + i);
}

/// A place in the picture: x, y in cells; larger nearness is nearer to the eye, and it is linear in
/// x and y over a face: one over depth in perspective, else the height towards the eye.
struct Spot {
  float x, y, nearness;
};

/// Nearness over the picture.
struct Plane {
  float along_x, along_y, offset;
};

/// How one eye draws.
struct Frame {
  Eigen::Vector3f right, up, towards;
  float distance = 0.0F;  // of the eye, in radii
  float slope = 0.0F;     // 1 in perspective, else 0
  float per_cell = 1.0F;  // cells to the unit
  float middle = 0.0F;
};

/// A camera like this one that a picture in single precision can be drawn from.
ScoringCamera drawable(ScoringCamera camera) {
  const double factor = camera.distance() / (0.5 * camera.sphere.diameter);
  if (factor > kFarthestEye) {
    camera.projection = Projection::Orthographic;
  }
  if (factor < kNearestEye) {
    camera.distance_factor = kNearestEye;
  }
  return camera;
}

Frame frame_of(const Vec3& direction, const ScoringCamera& camera, std::size_t cells) {
  const Vec3 right = direction.unitOrthogonal();
  Frame frame;
  frame.right = right.cast<float>();
  frame.up = direction.cross(right).cast<float>();
  frame.towards = direction.cast<float>();
  const double distance = camera.distance() / (0.5 * camera.sphere.diameter);
  const bool perspective = camera.projection == Projection::Perspective;
  frame.distance = static_cast<float>(distance);
  frame.slope = perspective ? 1.0F : 0.0F;
  // The sphere fills the picture; in perspective its outline has the tangent 1 / √(d² − 1).
  const double reach = perspective ? 1.0 / std::sqrt(distance * distance - 1.0) : 1.0;
  frame.middle = 0.5F * static_cast<float>(cells);
  frame.per_cell = static_cast<float>(0.5 * static_cast<double>(cells) / reach);
  return frame;
}

/// What points look like.
template <class Numbers>
struct Projected {
  Numbers x, y, nearness;
};

template <class Numbers>
VANTAGE_INLINE Projected<Numbers> project(const Frame& f, const SketchCoordinates& from,
                                          std::size_t i) {
  const Numbers x = load<Numbers>(from.x.data() + i);
  const Numbers y = load<Numbers>(from.y.data() + i);
  const Numbers z = load<Numbers>(from.z.data() + i);
  const Numbers rise = x * f.towards.x() + y * f.towards.y() + z * f.towards.z();
  const Numbers depth = f.slope * (f.distance - rise) + (1.0F - f.slope);
  const Numbers shrink = 1.0F / larger(depth, Numbers{} + kLeastDepth);
  const Numbers across = x * f.right.x() + y * f.right.y() + z * f.right.z();
  const Numbers along = x * f.up.x() + y * f.up.y() + z * f.up.z();
  return {across * shrink * f.per_cell + f.middle, along * shrink * f.per_cell + f.middle,
          f.slope * shrink + (1.0F - f.slope) * rise};
}

/// Some faces made ready to be drawn: of each the cells whose middles may lie inside and, as planes
/// over the picture, its nearness and its sides, which are positive inside.
template <unsigned Lanes>
struct Outlines {
  struct Planes {
    std::array<float, Lanes> along_x, along_y, offset;
  };

  std::array<std::int32_t, Lanes> is_drawn, left, right, bottom, top;
  Planes nearness;
  std::array<Planes, 3> sides;
};

template <class Planes, class Many>
VANTAGE_INLINE void keep(Planes& planes, const Many& along_x, const Many& along_y,
                         const Many& offset) {
  store(along_x, planes.along_x.data());
  store(along_y, planes.along_y.data());
  store(offset, planes.offset.data());
}

/// The first cells whose middles lie at a place or beyond.
template <unsigned Lanes>
VANTAGE_INLINE IntsOf<Lanes> cell_after(const FloatsOf<Lanes>& at) {
  constexpr float kCentre = 0.5F;  // of a cell
  const FloatsOf<Lanes> zero{};
  return __builtin_convertvector(
      smaller(larger(at, zero - kFarOutside), zero + kFarOutside) + kCentre, IntsOf<Lanes>);
}

/// Draws one model from one eye after the other.
class Sketch {
 public:
  Sketch(const SketchPoints& points, const SketchSurface& surface, std::size_t cells, float slack)
      : points_(points), surface_(surface), cells_(cells), slack_(slack) {
    const std::size_t padded = points.position.x.size();
    for (std::vector<float>* field : {&facing_, &x_, &y_, &near_}) {
      field->resize(padded);
    }
    cell_.resize(padded);
    turned_.resize(padded + 1);
    corners_.resize(surface.corners.x.size());
    planes_.resize(surface.faces.size());
    face_at_.resize(cells * cells + kLanes);
  }

  double score(const Vec3& direction, const Frame& frame) {
#if defined(__x86_64__)
    if (has_wide_registers()) {
      draw_wide(direction, frame);
      return sum_of_seen(frame);
    }
#endif
    draw<kLanes>(direction, frame);
    return sum_of_seen(frame);
  }

 private:
  template <unsigned Lanes>
  VANTAGE_INLINE void draw(const Vec3& direction, const Frame& frame) {
    project_corners<Lanes>(frame);
    draw_faces<Lanes>();
    project_points<Lanes>(direction, frame);
  }
#if defined(__x86_64__)
  void draw_wide(const Vec3& direction, const Frame& frame);
#endif
  template <unsigned Lanes>
  void project_corners(const Frame& frame);
  template <unsigned Lanes>
  void draw_faces();
  template <unsigned Lanes>
  void outline(std::size_t first, Outlines<Lanes>& outlines) const;
  template <unsigned Lanes>
  void draw_face(std::size_t face, const Outlines<Lanes>& outlines, unsigned lane);
  template <unsigned Lanes>
  void project_points(const Vec3& direction, const Frame& frame);
  [[nodiscard]] double sum_of_seen(const Frame& frame);
  [[nodiscard]] float hidden_share(std::size_t point, const float* at, float allowed) const;

  const SketchPoints& points_;
  const SketchSurface& surface_;
  std::size_t cells_;
  float slack_;
  std::vector<Spot> corners_{};
  std::vector<Plane> planes_{};
  std::vector<float> nearness_{};         // of each cell's middle, with lanes to spare
  std::vector<std::uint32_t> face_at_{};  // the face seen there
  std::vector<float> facing_{}, x_{}, y_{}, near_{};
  std::vector<std::int32_t> cell_{};
  std::vector<std::uint32_t> turned_{};
};

template <unsigned Lanes>
VANTAGE_INLINE void Sketch::project_corners(const Frame& frame) {
  for (std::size_t i = 0; i < corners_.size(); i += Lanes) {
    const auto spots = project<FloatsOf<Lanes>>(frame, surface_.corners, i);
    for (unsigned lane = 0; lane < Lanes; ++lane) {
      corners_[i + lane] = {spots.x[lane], spots.y[lane], spots.nearness[lane]};
    }
  }
}

/// Makes faces ready.
template <unsigned Lanes>
VANTAGE_INLINE void Sketch::outline(std::size_t first, Outlines<Lanes>& outlines) const {
  using Many = FloatsOf<Lanes>;

  struct Lined {
    std::array<float, Lanes> x, y, nearness;
  };

  std::array<Lined, 3> lined;
  IntsOf<Lanes> two_sided{};
  for (unsigned lane = 0; lane < Lanes; ++lane) {
    const std::size_t f = std::min(first + lane, surface_.faces.size() - 1);
    two_sided[lane] = surface_.two_sided[f] != 0 ? -1 : 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const Spot& spot = corners_[surface_.faces[f][k]];
      lined[k].x[lane] = spot.x;
      lined[k].y[lane] = spot.y;
      lined[k].nearness[lane] = spot.nearness;
    }
  }
  std::array<Projected<Many>, 3> corner;
  for (std::size_t k = 0; k < 3; ++k) {
    corner[k] = {load<Many>(lined[k].x.data()), load<Many>(lined[k].y.data()),
                 load<Many>(lined[k].nearness.data())};
  }
  const auto& [a, b, c] = corner;
  const Many ux = b.x - a.x;
  const Many uy = b.y - a.y;
  const Many un = b.nearness - a.nearness;
  const Many vx = c.x - a.x;
  const Many vy = c.y - a.y;
  const Many vn = c.nearness - a.nearness;
  const Many area = ux * vy - uy * vx;
  const Many zero{};
  const auto left = cell_after<Lanes>(smaller(smaller(a.x, b.x), c.x));
  const auto right = cell_after<Lanes>(larger(larger(a.x, b.x), c.x) - 1.0F);
  const auto bottom = cell_after<Lanes>(smaller(smaller(a.y, b.y), c.y));
  const auto top = cell_after<Lanes>(larger(larger(a.y, b.y), c.y) - 1.0F);
  store(left, outlines.left.data());
  store(right, outlines.right.data());
  store(bottom, outlines.bottom.data());
  store(top, outlines.top.data());
  const Many inverse = 1.0F / area;
  const Many along_x = (un * vy - vn * uy) * inverse;
  const Many along_y = (vn * ux - un * vx) * inverse;
  keep(outlines.nearness, along_x, along_y, a.nearness - along_x * a.x - along_y * a.y);
  const Many sense = area < zero ? zero - 1.0F : zero + 1.0F;
  for (std::size_t k = 0; k < 3; ++k) {
    const Projected<Many>& from = corner[k];
    const Projected<Many>& to = corner[(k + 1) % 3];
    const Many across = sense * (from.y - to.y);
    const Many along = sense * (to.x - from.x);
    keep(outlines.sides[k], across, along, -(across * from.x + along * from.y));
  }
  const auto last = static_cast<std::int32_t>(cells_) - 1;
  store(((area > zero) | ((area < zero) & two_sided)) & (left <= right) & (bottom <= top) &
            (left <= last) & (bottom <= last) & (right >= 0) & (top >= 0),
        outlines.is_drawn.data());
}

template <unsigned Lanes>
VANTAGE_INLINE void Sketch::draw_faces() {
  nearness_.assign(cells_ * cells_ + kLanes, -kInfinity);
  Outlines<Lanes> outlines;
  for (std::size_t first = 0; first < surface_.faces.size(); first += Lanes) {
    outline<Lanes>(first, outlines);
    const std::size_t count = std::min<std::size_t>(Lanes, surface_.faces.size() - first);
    for (unsigned lane = 0; lane < count; ++lane) {
      if (outlines.is_drawn[lane] != 0) {
        draw_face<Lanes>(first + lane, outlines, lane);
      }
    }
  }
}

template <unsigned Lanes>
VANTAGE_INLINE void Sketch::draw_face(std::size_t face, const Outlines<Lanes>& outlines,
                                      unsigned lane) {
  const auto last = static_cast<std::int32_t>(cells_) - 1;
  const std::int32_t right = std::min(last, outlines.right[lane]);
  const std::int32_t top = std::min(last, outlines.top[lane]);
  const std::int32_t bottom = std::max(0, outlines.bottom[lane]);
  const auto& [near_x, near_y, near_0] = outlines.nearness;
  planes_[face] = {near_x[lane], near_y[lane], near_0[lane]};
  const auto id = static_cast<std::int32_t>(face);
  for (std::int32_t column = std::max(0, outlines.left[lane]); column <= right; column += kLanes) {
    // Lanes beyond the last column lie outside the face.
    const Floats x = static_cast<float>(column) + Floats{0.5F, 1.5F, 2.5F, 3.5F};
    std::array<Floats, 3> across;
    for (std::size_t k = 0; k < across.size(); ++k) {
      across[k] = outlines.sides[k].along_x[lane] * x + outlines.sides[k].offset[lane];
    }
    const Floats near_across = near_x[lane] * x + near_0[lane];
    for (std::int32_t row = bottom; row <= top; ++row) {
      const float y = static_cast<float>(row) + 0.5F;
      const auto cell = static_cast<std::size_t>(row) * cells_ + static_cast<std::size_t>(column);
      const Floats near = near_across + near_y[lane] * y;
      const Floats before = load<Floats>(nearness_.data() + cell);
      Ints wins = near > before;
      for (std::size_t k = 0; k < across.size(); ++k) {
        wins &= across[k] + outlines.sides[k].along_y[lane] * y >= 0.0F;
      }
      store(wins ? near : before, nearness_.data() + cell);
      Ints ids;
      std::memcpy(&ids, face_at_.data() + cell, sizeof ids);
      store(wins ? Ints{id, id, id, id} : ids, face_at_.data() + cell);
    }
  }
}

template <unsigned Lanes>
VANTAGE_INLINE void Sketch::project_points(const Vec3& direction, const Frame& frame) {
  using Many = FloatsOf<Lanes>;
  const Eigen::Vector3f eye =
      (frame.slope > 0.0F ? Vec3(direction * static_cast<double>(frame.distance)) : direction)
          .cast<float>();
  const Many zero{};
  const Many last = zero + (static_cast<float>(cells_) - 1.001F);
  const auto columns = static_cast<std::int32_t>(cells_);
  for (std::size_t i = 0; i < points_.weight.size(); i += Lanes) {
    Many facing = zero - kInfinity;
    if (any_of(height_over<Many>(points_.hull, i, eye) > zero)) {
      for (std::size_t k = 0; k < SketchPoints::kCones && any_of(facing <= zero); ++k) {
        facing = larger(facing, height_over<Many>(points_.cones[k], i, eye));
      }
    }
    store(facing, facing_.data() + i);
    if (!any_of(facing > zero)) {
      continue;  // nobody asks where they are
    }
    const auto spot = project<Many>(frame, points_.position, i);
    // A point between the middles of four cells: half a cell back, and inside the picture.
    const Many x = smaller(larger(spot.x - 0.5F, zero), last);
    const Many y = smaller(larger(spot.y - 0.5F, zero), last);
    store(x, x_.data() + i);
    store(y, y_.data() + i);
    store(spot.nearness, near_.data() + i);
    store(__builtin_convertvector(y, IntsOf<Lanes>) * columns +
              __builtin_convertvector(x, IntsOf<Lanes>),
          cell_.data() + i);
  }
}

#if defined(__x86_64__)
[[gnu::target("avx2")]] void Sketch::draw_wide(const Vec3& direction, const Frame& frame) {
  draw<kWideLanes>(direction, frame);
}
#endif

/// Of the four cells around a point, by nearness of their middles, the share that hides it.
float Sketch::hidden_share(std::size_t point, const float* at, float allowed) const {
  const float near = near_[point];
  const float x = x_[point] + 0.5F;
  const float y = y_[point] + 0.5F;
  const Floats middles{at[0], at[1], at[cells_], at[cells_ + 1]};
  const std::uint32_t* face = face_at_.data() + (at - nearness_.data());
  const Plane& a = planes_[face[0]];
  const Plane& b = planes_[face[1]];
  const Plane& c = planes_[face[cells_]];
  const Plane& d = planes_[face[cells_ + 1]];
  const Floats along_x{a.along_x, b.along_x, c.along_x, d.along_x};
  const Floats along_y{a.along_y, b.along_y, c.along_y, d.along_y};
  const Floats offset{a.offset, b.offset, c.offset, d.offset};
  const Floats followed = along_x * x + along_y * y + offset;
  const Floats limit = middles + kReach * allowed;
  const Floats front = followed < limit ? followed : limit;
  const Ints hides = (middles > near + 0.5F * allowed) & (front - near > allowed);
  const auto past_whole = [](float place) {  // of a number that is not negative
    return place - static_cast<float>(static_cast<std::int32_t>(place));
  };
  const float across = past_whole(x_[point]);
  const float along = past_whole(y_[point]);
  const Floats share = Floats{1.0F - across, across, 1.0F - across, across} *
                       Floats{1.0F - along, 1.0F - along, along, along};
  const Floats hidden = hides ? share : Floats{};
  return (hidden[0] + hidden[1]) + (hidden[2] + hidden[3]);
}

double Sketch::sum_of_seen(const Frame& frame) {
  std::size_t turned = 0;
  for (std::uint32_t i = 0; i < points_.weight.size(); ++i) {
    turned_[turned] = i;
    turned += facing_[i] > 0.0F ? 1 : 0;
  }
  double sum = 0.0;
  for (std::size_t k = 0; k < turned; ++k) {
    const std::uint32_t i = turned_[k];
    const float* at = nearness_.data() + cell_[i];
    // Of nearness as one over depth, a step in depth is the square.
    const float allowed = frame.slope > 0.0F ? slack_ * near_[i] * near_[i] : slack_;
    const float nearest = std::max({at[0], at[1], at[cells_], at[cells_ + 1]});
    const float hidden = nearest > near_[i] + 0.5F * allowed ? hidden_share(i, at, allowed) : 0.0F;
    sum += static_cast<double>(points_.weight[i] * (1.0F - hidden));
  }
  return sum;
}

}  // namespace

SketchOptions sketch_options(std::size_t vertices) {
  constexpr SketchOptions kFine{.points = 5000, .faces = 5000, .cells = 112};
  return vertices < kCheapBelow ? kFine : SketchOptions{};
}

SketchScorer::SketchScorer(const TriMesh& surface, const std::vector<FaceSides>& sides,
                           std::span<const double> significance, const ScoringCamera& camera,
                           const SketchOptions& options,
                           std::shared_ptr<const SketchSurface> coarse)
    : camera_(drawable(camera)),
      cells_(options.cells),
      slack_(options.slack),
      surface_(coarse ? std::move(coarse)
                      : std::make_shared<SketchSurface>(
                            sketch_surface(surface, sides, camera_.sphere, options.faces))),
      points_(
          sketch_points(surface, surface_->order, sides, significance, camera_, options.points)) {}

std::vector<double> SketchScorer::score_all(std::span<const Vec3> directions,
                                            const RunContext& run) const {
  std::vector<double> scores(directions.size(), 0.0);
  parallel_for(run, directions.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    Sketch sketch(points_, *surface_, cells_, slack_);
    for (std::size_t i = begin; i < end; ++i) {
      scores[i] = sketch.score(directions[i], frame_of(directions[i], camera_, cells_));
    }
  });
  return scores;
}

}  // namespace vantage
