// SPDX-License-Identifier: MIT
#include "view/sketch_scorer.h"

#include <algorithm>
#include <utility>

#include "core/parallel.h"
#include "view/sketch_frame.h"
#include "view/sketch_picture.h"

namespace vantage {
namespace {

// A face's plane is followed so many slacks beyond its nearness in the middle of a cell. [ours]
constexpr float kReach = 4.0F;
constexpr std::size_t kGrain = 16;  // directions a chunk: some tenths of a millisecond
using Four = FloatsOf<4>;

/// Sketches one model from one eye after the other.
class Sketch {
 public:
  Sketch(const SketchPoints& points, const SketchSurface& surface, std::size_t cells, float slack)
      : points_(points), picture_(surface, cells), slack_(slack) {
    const std::size_t padded = points.position.x.size();
    for (std::vector<float>* field : {&x_, &y_, &near_}) {
      field->resize(padded);
    }
    cell_.resize(padded);
    turned_.resize(padded + 1);
  }

  double score(const SketchFrame& frame) {
    picture_.draw(frame);
    find_turned(frame);
    return sum_of_seen(frame);
  }

 private:
  void find_turned(const SketchFrame& frame);
#if defined(__x86_64__)
  void find_turned_wide(const SketchFrame& frame);
#endif
  template <unsigned Lanes>
  void find_turned_by(const SketchFrame& frame);
  template <unsigned Lanes>
  void project_points(const SketchFrame& frame, std::size_t first);
  [[nodiscard]] double sum_of_seen(const SketchFrame& frame);
  [[nodiscard]] float hidden_share(std::size_t point, float allowed) const;

  /// By so much a face may be nearer than a point on it. Of nearness as one over depth, a step in depth
  /// is the square.
  [[nodiscard]] float allowed_at(const SketchFrame& frame, std::size_t point) const {
    return frame.slope > 0.0F ? slack_ * near_[point] * near_[point] : slack_;
  }

  const SketchPoints& points_;
  SketchPicture picture_;
  float slack_;
  // Of points turned to the eye: between which cells' middles, and how near.
  std::vector<float> x_{}, y_{}, near_{};
  std::vector<std::int32_t> cell_{};     // the lower left one of the four
  std::vector<std::uint32_t> turned_{};  // which these are
  std::size_t turned_count_ = 0;
};

void Sketch::find_turned(const SketchFrame& frame) {
#if defined(__x86_64__)
  if (has_wide_registers()) {
    find_turned_wide(frame);
    return;
  }
#endif
  find_turned_by<4>(frame);
}

#if defined(__x86_64__)
[[gnu::target("avx2")]] void Sketch::find_turned_wide(const SketchFrame& frame) {
  find_turned_by<kWideLanes>(frame);
}
#endif

/// How far an eye is over planes.
template <class Many>
VANTAGE_INLINE Many height_over(const SketchPlanes& planes, std::size_t i,
                                const Eigen::Vector3f& eye) {
  return rise_along<Many>(planes.axis, i, eye) - load<Many>(planes.offset.data() + i);
}

/// Lists the points that have a face turned to the eye, and finds out where these are.
template <unsigned Lanes>
VANTAGE_INLINE void Sketch::find_turned_by(const SketchFrame& frame) {
  using Many = FloatsOf<Lanes>;
  const Many zero{};
  turned_count_ = 0;
  for (std::size_t first = 0; first < points_.weight.size(); first += Lanes) {
    IntsOf<Lanes> turned{};
    if (any_of(height_over<Many>(points_.hull, first, frame.eye) > zero)) {
      for (std::size_t k = 0; k < SketchPoints::kCones && any_of(turned == 0); ++k) {
        turned |= height_over<Many>(points_.cones[k], first, frame.eye) > zero;
      }
    }
    if (!any_of(turned)) {
      continue;  // nobody asks where they are
    }
    for (unsigned lane = 0; lane < Lanes; ++lane) {
      turned_[turned_count_] = static_cast<std::uint32_t>(first) + lane;
      turned_count_ += turned[lane] != 0 ? 1 : 0;
    }
    project_points<Lanes>(frame, first);
  }
}

template <unsigned Lanes>
VANTAGE_INLINE void Sketch::project_points(const SketchFrame& frame, std::size_t first) {
  using Many = FloatsOf<Lanes>;
  const Many zero{};
  const auto cells = static_cast<std::int32_t>(picture_.cells());
  const Many last = zero + (static_cast<float>(cells) - 1.001F);
  const auto spot = project<Many>(frame, points_.position, first);
  // A point between the middles of four cells: half a cell back, and inside the picture, as is what is
  // no number, of a point that single precision does not reach.
  const Many x = smaller(larger(zero, spot.x - 0.5F), last);
  const Many y = smaller(larger(zero, spot.y - 0.5F), last);
  store(x, x_.data() + first);
  store(y, y_.data() + first);
  store(spot.nearness, near_.data() + first);
  store(
      __builtin_convertvector(y, IntsOf<Lanes>) * cells + __builtin_convertvector(x, IntsOf<Lanes>),
      cell_.data() + first);
}

/// Of the four cells around a point, by nearness of their middles, the share that hides it.
float Sketch::hidden_share(std::size_t point, float allowed) const {
  const float near = near_[point];
  const float x = x_[point] + 0.5F;
  const float y = y_[point] + 0.5F;
  const auto cell = static_cast<std::size_t>(cell_[point]);
  const std::size_t above = cell + picture_.cells();
  const float* nearness = picture_.nearness();
  const Four middles{nearness[cell], nearness[cell + 1], nearness[above], nearness[above + 1]};
  const auto& a = picture_.plane_at(cell);
  const auto& b = picture_.plane_at(cell + 1);
  const auto& c = picture_.plane_at(above);
  const auto& d = picture_.plane_at(above + 1);
  const Four along_x{a.along_x, b.along_x, c.along_x, d.along_x};
  const Four along_y{a.along_y, b.along_y, c.along_y, d.along_y};
  const Four offset{a.offset, b.offset, c.offset, d.offset};
  const Four followed = along_x * x + along_y * y + offset;
  const Four limit = middles + kReach * allowed;
  const Four front = followed < limit ? followed : limit;
  const IntsOf<4> hides = (middles > near + 0.5F * allowed) & (front - near > allowed);
  const auto past_whole = [](float place) {  // of a number that is not negative
    return place - static_cast<float>(static_cast<std::int32_t>(place));
  };
  const float across = past_whole(x_[point]);
  const float along = past_whole(y_[point]);
  const Four share = Four{1.0F - across, across, 1.0F - across, across} *
                     Four{1.0F - along, 1.0F - along, along, along};
  const Four hidden = hides ? share : Four{};
  return (hidden[0] + hidden[1]) + (hidden[2] + hidden[3]);
}

/// What is turned to the eye, less what is hidden of it; of most points a look at four depths tells that
/// nothing is. The list of those turned becomes that of the others.
double Sketch::sum_of_seen(const SketchFrame& frame) {
  const float* nearness = picture_.nearness();
  const std::size_t cells = picture_.cells();
  double sum = 0.0;
  std::size_t doubted = 0;
  for (std::size_t k = 0; k < turned_count_; ++k) {
    const std::uint32_t i = turned_[k];
    sum += static_cast<double>(points_.weight[i]);
    const float* at = nearness + cell_[i];
    const float nearest = std::max(std::max(at[0], at[1]), std::max(at[cells], at[cells + 1]));
    turned_[doubted] = i;
    doubted += nearest > near_[i] + 0.5F * allowed_at(frame, i) ? 1 : 0;
  }
  for (std::size_t k = 0; k < doubted; ++k) {
    const std::uint32_t i = turned_[k];
    const float hidden = hidden_share(i, allowed_at(frame, i));
    sum -= static_cast<double>(points_.weight[i] * hidden);
  }
  return std::max(sum, 0.0);  // shares of cells may add up to a little more than one
}

}  // namespace

SketchOptions sketch_options(std::size_t vertices) {
  constexpr SketchOptions kFine{.points = 3000, .faces = 3500, .cells = 112, .slack = 0.016F};
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
      scores[i] = sketch.score(SketchFrame(directions[i], camera_, cells_));
    }
  });
  return scores;
}

}  // namespace vantage
