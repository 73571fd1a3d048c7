// SPDX-License-Identifier: MIT
// The searches of the view sphere take any score. Here: how much of a house's front, its front wall
// and its lit side, faces the viewer; 642 directions and a refinement against the formula's maximum.
#include <algorithm>
#include <cstdio>
#include <stop_token>

#include "vantage/core/error.h"
#include "vantage/view/search.h"

int main() {
  using namespace vantage;
  const Vec3 front = Vec3::UnitZ();
  const Vec3 side = Vec3::UnitX();
  const auto score = [&](const std::vector<Vec3>& directions) {
    std::vector<double> scores;
    for (const Vec3& d : directions) {
      scores.push_back(2.0 * std::max(0.0, d.dot(front)) + std::max(0.0, d.dot(side)));
    }
    return scores;
  };
  const SearchOptions options{.strategy = SearchStrategy::Rapid};
  const FoundView best = search_view({score, 3.0}, Goal::Best, options);
  const Vec3 right = (2.0 * front + side).normalized();  // where the gradient vanishes
  std::printf("best %.4f of %.4f at %.3f %.3f %.3f after %zu scores\n", best.score,
              (2.0 * front + side).norm(), best.direction.x(), best.direction.y(),
              best.direction.z(), best.evaluations);

  // A stop that another thread asks for ends a search by an exception, within a second.
  std::stop_source stop;
  stop.request_stop();
  try {
    static_cast<void>(search_view({score, 3.0}, Goal::Best, options, {.stop = stop.get_token()}));
    return 1;
  } catch (const Cancelled&) {
    return best.direction.dot(right) > 0.999 ? 0 : 1;
  }
}
