// SPDX-License-Identifier: MIT
#include "view/score_memo.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "vantage/core/error.h"

namespace vantage {
namespace {

// Directions a batch: enough to keep many cores busy, few enough for a bar that moves.
constexpr std::size_t kDirectionsAtOnce = 32;

}  // namespace

ScoreMemo::Key ScoreMemo::key_of(const Vec3& direction) {
  const auto bits = [](double x) { return std::bit_cast<std::uint64_t>(x + 0.0); };  // −0 is 0
  return {bits(direction.x()), bits(direction.y()), bits(direction.z())};
}

std::vector<double> ScoreMemo::scores(const std::vector<Vec3>& directions, int level) {
  std::vector<Vec3> fresh;
  for (const Vec3& d : directions) {
    if (score_of_.try_emplace(key_of(d), 0.0).second) {
      fresh.push_back(d);
    }
  }
  if (!fresh.empty()) {
    const std::vector<double> values = (*score_)(fresh);
    if (values.size() != fresh.size()) {
      throw InvalidInput("the score function returned " + std::to_string(values.size()) +
                         " values for " + std::to_string(fresh.size()) + " directions");
    }
    if (std::any_of(values.begin(), values.end(), [](double x) { return std::isnan(x); })) {
      throw InvalidInput("the score function returned a value that is not a number");
    }
    for (std::size_t i = 0; i < fresh.size(); ++i) {
      score_of_[key_of(fresh[i])] = values[i];
      trace_.push_back({level, fresh[i], values[i]});
    }
  }
  std::vector<double> result;
  result.reserve(directions.size());
  for (const Vec3& d : directions) {
    result.push_back(score_of_.at(key_of(d)));
  }
  return result;
}

std::vector<double> ScoreMemo::scores(const std::vector<Vec3>& directions, int level,
                                      const RunContext& run) {
  std::vector<double> result;
  result.reserve(directions.size());
  for (std::size_t begin = 0; begin < directions.size(); begin += kDirectionsAtOnce) {
    run.advance("search", static_cast<double>(begin) / static_cast<double>(directions.size()));
    const std::size_t end = std::min(directions.size(), begin + kDirectionsAtOnce);
    const std::vector<Vec3> batch(directions.begin() + static_cast<std::ptrdiff_t>(begin),
                                  directions.begin() + static_cast<std::ptrdiff_t>(end));
    const std::vector<double> part = scores(batch, level);
    result.insert(result.end(), part.begin(), part.end());
  }
  run.advance("search", 1.0);
  return result;
}

}  // namespace vantage
