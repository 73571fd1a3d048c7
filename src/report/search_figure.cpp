// SPDX-License-Identifier: MIT
#include "report/search_figure.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <span>
#include <string>

#include <Eigen/Geometry>

#include "vantage/render/render.h"

#include "report/panels.h"

namespace vantage {
namespace {

/// Triangulations finer than this are drawn as this: lines would touch. [ours]
constexpr int kFinestDrawn = 4;
/// Panels of the whole sphere; one enlarged part comes after them. [ours]
constexpr std::size_t kMostPanels = 5;
constexpr Rgb8 kTextInk{40, 40, 44};
constexpr Rgb8 kMesh{196, 200, 206};
constexpr Rgb8 kBall{243, 244, 246};
constexpr Rgb8 kPath{20, 20, 20};

/// The next level of the whole triangulation: Loop's rule for new vertices, old ones kept. \pre closed.
DirectionSet loop_refined(const DirectionSet& set) {
  std::map<std::array<std::uint32_t, 2>, std::vector<std::uint32_t>> opposite;
  const auto key = [](std::uint32_t a, std::uint32_t b) {
    return std::array{std::min(a, b), std::max(a, b)};
  };
  for (const Triangle& t : set.triangles) {
    for (std::size_t c = 0; c < 3; ++c) {
      opposite[key(t[c], t[(c + 1) % 3])].push_back(t[(c + 2) % 3]);
    }
  }
  DirectionSet fine{set.directions, {}};
  std::map<std::array<std::uint32_t, 2>, std::uint32_t> middle;
  for (const auto& [edge, apexes] : opposite) {
    middle[edge] = static_cast<std::uint32_t>(fine.directions.size());
    const auto& d = set.directions;
    fine.directions.push_back(
        loop_edge_direction(d[edge[0]], d[edge[1]], d[apexes.front()], d[apexes.back()]));
  }
  for (const auto& [a, b, c] : set.triangles) {
    const std::uint32_t ab = middle[key(a, b)];
    const std::uint32_t bc = middle[key(b, c)];
    const std::uint32_t ca = middle[key(c, a)];
    const std::array<Triangle, 4> parts{{{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}}};
    fine.triangles.insert(fine.triangles.end(), parts.begin(), parts.end());
  }
  return fine;
}

/// Where the search stood after each level, as SearchStep.
std::vector<SearchStep> path_of(const std::vector<SearchStep>& trace, Goal goal) {
  std::vector<SearchStep> path;
  for (const SearchStep& step : trace) {
    const bool new_level = path.empty() || step.level != path.back().level;
    if (new_level) {
      SearchStep here = path.empty() ? step : path.back();
      here.level = step.level;
      path.push_back(here);
    }
    const double gain = step.score - path.back().score;
    if (goal == Goal::Best ? gain > 0.0 : gain < 0.0) {
      path.back() = step;
    }
  }
  return path;
}

/// A sphere seen from afar, drawn into a round of a drawing.
class Ball {
 public:
  /// \param zoom 1: the whole sphere.
  Ball(const Vec3& eye, const PixelPoint& centre, double radius, double zoom)
      : back_(eye.normalized()), centre_(centre), radius_(radius), zoom_(zoom) {
    const Vec3 up = std::abs(back_.y()) < 0.95 ? Vec3::UnitY() : Vec3::UnitZ();
    right_ = up.cross(back_).normalized();
    up_ = back_.cross(right_);
  }

  [[nodiscard]] bool shows(const Vec3& d) const {
    return d.dot(back_) > 0.0 && std::hypot(d.dot(right_), d.dot(up_)) * zoom_ <= 1.0;
  }

  [[nodiscard]] PixelPoint at(const Vec3& d) const {
    return {centre_[0] + radius_ * zoom_ * d.dot(right_),
            centre_[1] - radius_ * zoom_ * d.dot(up_)};
  }

  /// Draws the visible part of the arc from a to b.
  void arc(LineDrawing& drawing, const Vec3& a, const Vec3& b, double width, Rgb8 colour) const {
    constexpr double kPieceRad = 0.12;  // straight pieces of an arc; a fiftieth of a turn
    const int pieces = 1 + static_cast<int>((b - a).norm() / kPieceRad);
    std::vector<PixelPoint> piece;
    for (int i = 0; i <= pieces; ++i) {
      const double share = static_cast<double>(i) / pieces;
      const Vec3 d = ((1.0 - share) * a + share * b).normalized();
      if (shows(d)) {
        piece.push_back(at(d));
      }
      if (piece.size() > 1 && (!shows(d) || i == pieces)) {
        drawing.line(piece, width, colour);
      }
      if (!shows(d)) {
        piece.clear();
      }
    }
  }

  void disc(LineDrawing& drawing) const {
    drawing.dot(centre_, radius_ + 1.0, kMesh);
    drawing.dot(centre_, radius_, kBall);
  }

 private:
  Vec3 back_;
  Vec3 right_ = Vec3::UnitX();
  Vec3 up_ = Vec3::UnitY();
  PixelPoint centre_;
  double radius_;
  double zoom_;
};

/// What all panels share.
struct SearchRecord {
  std::span<const SearchStep> trace;
  std::vector<SearchStep> path;
  double low = 0.0;
  double high = 1.0;

  [[nodiscard]] Rgb8 colour(double score) const {
    return cool_warm(high > low ? (score - low) / (high - low) : 0.5);
  }
};

void draw_mesh(LineDrawing& drawing, const Ball& ball, const DirectionSet& set, double width) {
  for (const Triangle& t : set.triangles) {
    for (std::size_t c = 0; c < 3; ++c) {
      if (t[c] < t[(c + 1) % 3]) {  // each edge once
        ball.arc(drawing, set.directions[t[c]], set.directions[t[(c + 1) % 3]], width, kMesh);
      }
    }
  }
}

/// Directions scored up to a level, and the way to where the search stands then.
void draw_search(LineDrawing& drawing, const Ball& ball, const SearchRecord& record, int level,
                 double dot) {
  for (const SearchStep& step : record.trace) {
    if (step.level <= level && ball.shows(step.direction)) {
      drawing.dot(ball.at(step.direction), (step.level == level ? 1.0 : 0.7) * dot,
                  record.colour(step.score));
    }
  }
  const SearchStep* here = &record.path.front();
  for (const SearchStep& stop : record.path) {
    if (stop.level > level) {
      break;
    }
    if ((stop.direction - here->direction).norm() > 0.0) {
      ball.arc(drawing, here->direction, stop.direction, 0.5 * dot, kPath);
    }
    here = &stop;
  }
  if (ball.shows(here->direction)) {
    drawing.dot(ball.at(here->direction), 1.5 * dot, kPath);
    drawing.dot(ball.at(here->direction), 1.05 * dot, record.colour(here->score));
  }
}

std::string label(const SearchRecord& record, int level, double total) {
  const auto scored = std::count_if(record.trace.begin(), record.trace.end(),
                                    [&](const SearchStep& s) { return s.level <= level; });
  const SearchStep* here = &record.path.front();
  for (const SearchStep& stop : record.path) {
    here = stop.level <= level ? &stop : here;
  }
  return "level " + std::to_string(level) + ": " + std::to_string(scored) + " views, " +
         percent_text(total > 0.0 ? here->score / total : 0.0);
}

}  // namespace

LineDrawing search_figure(const std::vector<SearchStep>& trace, ViewSphereBase base, Goal goal,
                          double total, int size) {
  SearchRecord record{trace, path_of(trace, goal), trace.front().score, trace.front().score};
  for (const SearchStep& step : trace) {
    record.low = std::min(record.low, step.score);
    record.high = std::max(record.high, step.score);
  }
  const int last = trace.back().level;
  const std::size_t count = std::min<std::size_t>(kMostPanels, static_cast<std::size_t>(last) + 1);
  const double margin = 0.04 * size;
  const double letters = 0.042 * size;
  const double radius = 0.5 * size - 2.0 * margin;
  const int high = size + static_cast<int>(3.0 * letters);
  LineDrawing drawing(static_cast<int>(count + 1) * size, high);
  // From where the way is seen best: a little beside its end.
  const Vec3 end = record.path.back().direction;
  const Vec3 start = record.path.front().direction;
  const Vec3 eye = end + 0.6 * start + 0.15 * end.unitOrthogonal();
  DirectionSet set = direction_set(base, 0);
  for (std::size_t panel = 0; panel < count; ++panel) {
    const int level = static_cast<int>(panel);
    const PixelPoint centre{(static_cast<double>(panel) + 0.5) * size, 0.5 * size};
    const Ball ball(eye, centre, radius, 1.0);
    ball.disc(drawing);
    draw_mesh(drawing, ball, set, 0.0025 * size);
    draw_search(drawing, ball, record, level, 0.012 * size);
    drawing.text(label(record, level, total), {centre[0] - radius, size + letters}, letters,
                 kTextInk);
    if (level < kFinestDrawn) {
      set = loop_refined(set);
    }
  }
  // The enlarged part: what lies within a ring of the last level that was drawn whole.
  constexpr double kZoom = 12.0;
  const PixelPoint centre{(static_cast<double>(count) + 0.5) * size, 0.5 * size};
  const Ball close(end, centre, radius, kZoom);
  close.disc(drawing);
  draw_mesh(drawing, close, set, 0.0025 * size);
  draw_search(drawing, close, record, last, 0.012 * size);
  drawing.text("12 x " + label(record, last, total), {centre[0] - radius, size + letters}, letters,
               kTextInk);
  return drawing;
}

}  // namespace vantage
