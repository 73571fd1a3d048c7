// SPDX-License-Identifier: MIT
#include "view/sketch_scorer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>

#include <Eigen/Geometry>

#include "core/parallel.h"

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
constexpr std::size_t kLanes = 4;
constexpr std::size_t kGrain = 16;  // directions a chunk: some tenths of a millisecond

using Floats = float __attribute__((vector_size(4 * kLanes)));
using Ints = std::int32_t __attribute__((vector_size(4 * kLanes)));

Floats load(const std::vector<float>& from, std::size_t i) {
  Floats values;
  std::memcpy(&values, from.data() + i, sizeof values);
  return values;
}

/// Whether it is true in one of the lanes.
bool any_of(const Ints& truths) {
  std::array<std::uint64_t, kLanes / 2> pairs{};
  std::memcpy(pairs.data(), &truths, sizeof pairs);
  return (pairs[0] | pairs[1]) != 0;
}

/// How far the eye is over the planes of four cones.
Floats height_over(const SketchPoints::Cones& cones, std::size_t i, const Eigen::Vector3f& eye) {
  return load(cones.axis.x, i) * eye.x() + load(cones.axis.y, i) * eye.y() +
         load(cones.axis.z, i) * eye.z() - load(cones.offset, i);
}

template <class Lanes, class Number>
void store(const Lanes& values, Number* to) {
  std::memcpy(to, &values, sizeof values);
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

/// What four points, or one, look like.
template <class Number>
struct Projected {
  Number x, y, nearness;
};

template <class Number>
Projected<Number> project(const Frame& f, const Number& x, const Number& y, const Number& z) {
  const Number rise = x * f.towards.x() + y * f.towards.y() + z * f.towards.z();
  const Number depth = f.slope * (f.distance - rise) + (1.0F - f.slope);
  const Number shrink = 1.0F / (depth > kLeastDepth ? depth : Number{} + kLeastDepth);
  const Number across = x * f.right.x() + y * f.right.y() + z * f.right.z();
  const Number along = x * f.up.x() + y * f.up.y() + z * f.up.z();
  return {across * shrink * f.per_cell + f.middle, along * shrink * f.per_cell + f.middle,
          f.slope * shrink + (1.0F - f.slope) * rise};
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
    turned_.resize(padded + 1);
    planes_.resize(surface.faces.size());
    face_at_.resize(cells * cells + kLanes);
  }

  double score(const Vec3& direction, const Frame& frame) {
    draw_faces(frame);
    project_points(direction, frame);
    return sum_of_seen(frame);
  }

 private:
  void draw_faces(const Frame& frame);
  void draw_face(std::uint32_t face, const Spot& a, const Spot& b, const Spot& c);
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
  std::vector<std::uint32_t> turned_{};
};

void Sketch::draw_faces(const Frame& frame) {
  const SketchCoordinates& from = surface_.corners;
  corners_.resize(from.x.size());
  for (std::size_t i = 0; i < corners_.size(); i += kLanes) {
    const Projected<Floats> spots =
        project(frame, load(from.x, i), load(from.y, i), load(from.z, i));
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      corners_[i + lane] = {spots.x[lane], spots.y[lane], spots.nearness[lane]};
    }
  }
  nearness_.assign(cells_ * cells_ + kLanes, -kInfinity);
  for (std::uint32_t f = 0; f < surface_.faces.size(); ++f) {
    const auto& [i, j, k] = surface_.faces[f];
    const Spot& a = corners_[i];
    const Spot& b = corners_[j];
    const Spot& c = corners_[k];
    const float area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    if (area > 0.0F) {
      draw_face(f, a, b, c);
    } else if (area < 0.0F && surface_.two_sided[f] != 0) {
      draw_face(f, b, a, c);
    }
  }
}

/// Draws a face whose corners turn counter-clockwise.
void Sketch::draw_face(std::uint32_t face, const Spot& a, const Spot& b, const Spot& c) {
  constexpr float kCentre = 0.5F;  // of a cell
  const auto cell_after = [](float at) {
    return static_cast<std::int32_t>(std::clamp(at, -kFarOutside, kFarOutside) + kCentre);
  };
  const auto last = static_cast<std::int32_t>(cells_) - 1;
  // Cells whose middles may lie inside.
  const std::int32_t left = std::max(0, cell_after(std::min({a.x, b.x, c.x})));
  const std::int32_t right = std::min(last, cell_after(std::max({a.x, b.x, c.x}) - 1.0F));
  const std::int32_t bottom = std::max(0, cell_after(std::min({a.y, b.y, c.y})));
  const std::int32_t top = std::min(last, cell_after(std::max({a.y, b.y, c.y}) - 1.0F));
  if (left > right || bottom > top) {
    return;
  }
  const Spot u{b.x - a.x, b.y - a.y, b.nearness - a.nearness};
  const Spot v{c.x - a.x, c.y - a.y, c.nearness - a.nearness};
  const float inverse = 1.0F / (u.x * v.y - u.y * v.x);
  Plane& plane = planes_[face];
  plane.along_x = (u.nearness * v.y - v.nearness * u.y) * inverse;
  plane.along_y = (v.nearness * u.x - u.nearness * v.x) * inverse;
  plane.offset = a.nearness - plane.along_x * a.x - plane.along_y * a.y;
  const auto side = [](const Spot& from, const Spot& to) -> Plane {  // positive inside
    const Plane p{from.y - to.y, to.x - from.x, 0.0F};
    return {p.along_x, p.along_y, -(p.along_x * from.x + p.along_y * from.y)};
  };
  const Plane sides[3] = {side(a, b), side(b, c), side(c, a)};
  const auto at = [](const Plane& p, const Floats& x, float y) -> Floats {
    return p.along_x * x + (p.along_y * y + p.offset);
  };
  const auto id = static_cast<std::int32_t>(face);
  for (std::int32_t row = bottom; row <= top; ++row) {
    const float y = static_cast<float>(row) + 0.5F;
    for (std::int32_t column = left; column <= right; column += kLanes) {
      // Lanes beyond the last column lie outside the face.
      const Floats x = static_cast<float>(column) + Floats{0.5F, 1.5F, 2.5F, 3.5F};
      const auto cell = static_cast<std::size_t>(row) * cells_ + static_cast<std::size_t>(column);
      const Floats near = at(plane, x, y);
      const Floats before = load(nearness_, cell);
      const Ints wins = (at(sides[0], x, y) >= 0.0F) & (at(sides[1], x, y) >= 0.0F) &
                        (at(sides[2], x, y) >= 0.0F) & (near > before);
      store(wins ? near : before, nearness_.data() + cell);
      Ints ids;
      std::memcpy(&ids, face_at_.data() + cell, sizeof ids);
      store(wins ? Ints{id, id, id, id} : ids, face_at_.data() + cell);
    }
  }
}

void Sketch::project_points(const Vec3& direction, const Frame& frame) {
  const Eigen::Vector3f eye =
      (frame.slope > 0.0F ? Vec3(direction * static_cast<double>(frame.distance)) : direction)
          .cast<float>();
  const Floats zero{};
  const Floats last = zero + (static_cast<float>(cells_) - 1.001F);
  // A point between the middles of four cells: half a cell back, and inside the picture.
  const auto inside = [&](Floats at) {
    at -= 0.5F;
    at = at > zero ? at : zero;
    return at < last ? at : last;
  };
  for (std::size_t i = 0; i < points_.weight.size(); i += kLanes) {
    Floats facing = zero - kInfinity;
    if (any_of(height_over(points_.hull, i, eye) > zero)) {
      for (std::size_t k = 0; k < SketchPoints::kCones && any_of(facing <= zero); ++k) {
        const Floats height = height_over(points_.cones[k], i, eye);
        facing = height > facing ? height : facing;
      }
    }
    store(facing, facing_.data() + i);
    if (!any_of(facing > zero)) {
      continue;  // nobody asks where they are
    }
    const Projected<Floats> spot =
        project(frame, load(points_.position.x, i), load(points_.position.y, i),
                load(points_.position.z, i));
    store(inside(spot.x), x_.data() + i);
    store(inside(spot.y), y_.data() + i);
    store(spot.nearness, near_.data() + i);
  }
}

/// Of the four cells around a point, by nearness of their middles, the share that hides it.
float Sketch::hidden_share(std::size_t point, const float* at, float allowed) const {
  const float x = x_[point] + 0.5F;
  const float y = y_[point] + 0.5F;
  const auto hides = [&](std::size_t cell) {
    if (!(at[cell] > near_[point] + 0.5F * allowed)) {
      return 0.0F;
    }
    const auto index = static_cast<std::size_t>(at - nearness_.data()) + cell;
    const Plane& plane = planes_[face_at_[index]];
    const float front =
        std::min(plane.along_x * x + plane.along_y * y + plane.offset, at[cell] + kReach * allowed);
    return front - near_[point] > allowed ? 1.0F : 0.0F;
  };
  const auto past_whole = [](float place) {  // of a number that is not negative
    return place - static_cast<float>(static_cast<std::int32_t>(place));
  };
  const float across = past_whole(x_[point]);
  const float along = past_whole(y_[point]);
  return (1.0F - along) * ((1.0F - across) * hides(0) + across * hides(1)) +
         along * ((1.0F - across) * hides(cells_) + across * hides(cells_ + 1));
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
    const float* at = nearness_.data() + static_cast<std::size_t>(y_[i]) * cells_ +
                      static_cast<std::size_t>(x_[i]);
    // Of nearness as one over depth, a step in depth is the square.
    const float allowed = frame.slope > 0.0F ? slack_ * near_[i] * near_[i] : slack_;
    const float nearest = std::max({at[0], at[1], at[cells_], at[cells_ + 1]});
    const float hidden = nearest > near_[i] + 0.5F * allowed ? hidden_share(i, at, allowed) : 0.0F;
    sum += static_cast<double>(points_.weight[i] * (1.0F - hidden));
  }
  return sum;
}

}  // namespace

SketchScorer::SketchScorer(const TriMesh& surface, const std::vector<FaceSides>& sides,
                           std::span<const double> significance, const ScoringCamera& camera,
                           const SketchOptions& options)
    : camera_(drawable(camera)),
      cells_(options.cells),
      slack_(options.slack),
      points_(sketch_points(surface, sides, significance, camera_, options.points)),
      surface_(sketch_surface(surface, sides, camera_, options.faces)) {}

std::vector<double> SketchScorer::score_all(std::span<const Vec3> directions,
                                            const RunContext& run) const {
  std::vector<double> scores(directions.size(), 0.0);
  parallel_for(run, directions.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    Sketch sketch(points_, surface_, cells_, slack_);
    for (std::size_t i = begin; i < end; ++i) {
      scores[i] = sketch.score(directions[i], frame_of(directions[i], camera_, cells_));
    }
  });
  return scores;
}

}  // namespace vantage
