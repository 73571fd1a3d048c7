// SPDX-License-Identifier: MIT
#include "view/error_model.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace vantage {
namespace {

// The unknown constant's variance and the noise's, both over that of what changes with direction;
// and how far that reaches, as a chord of the unit sphere (35°). Searches hardly depend on them.
// [ours, docs/search.md]
constexpr double kConstant = 25.0;
constexpr double kNoise = 0.35;
constexpr double kReach = 0.6;
// From so many lessons on the scale of the process does not fall again: a search that stays on one
// hill learns from ever more of the same, which says nothing of the others. [ours, docs/search.md]
constexpr std::size_t kSettled = 23;

/// Covariance of the errors in two directions: Wendland's function C2, zero from kReach on.
double covariance(const Vec3& a, const Vec3& b) {
  const double t = (a - b).norm() / kReach;
  if (t >= 1.0) {
    return kConstant;
  }
  const double u = (1.0 - t) * (1.0 - t);
  return kConstant + u * u * (4.0 * t + 1.0);
}

}  // namespace

double ErrorModel::weight_of(std::size_t row, std::size_t candidate) const {
  const std::size_t teacher = taught_[row];
  double value = covariance(directions_[candidate], directions_[teacher]);
  for (std::size_t i = 0; i < row; ++i) {
    value -= rows_[i][teacher] * rows_[i][candidate];
  }
  return value / spread_[row];
}

std::size_t ErrorModel::add(const Vec3& direction, double estimate) {
  const std::size_t candidate = directions_.size();
  directions_.push_back(direction);
  estimates_.push_back(estimate);
  known_.push_back(0);
  scores_.push_back(0.0);
  error_.push_back(0.0);
  variance_.push_back(kConstant + 1.0);
  for (std::size_t row = 0; row < rows_.size(); ++row) {
    rows_[row].push_back(weight_of(row, candidate));
    error_[candidate] += rows_[row][candidate] * lessons_[row];
    variance_[candidate] -= rows_[row][candidate] * rows_[row][candidate];
  }
  return candidate;
}

void ErrorModel::learn(std::size_t candidate, double score) {
  if (known_[candidate] != 0) {
    return;
  }
  known_[candidate] = 1;
  scores_[candidate] = score;
  const std::size_t row = rows_.size();
  taught_.push_back(candidate);
  spread_.push_back(std::sqrt(std::max(variance_[candidate], 0.0) + kNoise));
  lessons_.push_back((score - estimates_[candidate] - error_[candidate]) / spread_[row]);
  if (row > 0) {
    surprise_ += lessons_[row] * lessons_[row];
    const double mean = surprise_ / static_cast<double>(row);
    scale_ = row < kSettled ? mean : std::max(scale_, mean);
  }
  // weight_of() of every candidate, row by row: this is where a search by estimates spends its
  // time.
  std::vector<double> weights;
  weights.reserve(directions_.size());
  for (const Vec3& direction : directions_) {
    weights.push_back(covariance(direction, directions_[candidate]));
  }
  for (const std::vector<double>& before : rows_) {
    const double shared = before[candidate];
    for (std::size_t c = 0; c < weights.size(); ++c) {
      weights[c] -= shared * before[c];
    }
  }
  for (std::size_t c = 0; c < weights.size(); ++c) {
    weights[c] /= spread_[row];
    error_[c] += weights[c] * lessons_[row];
    variance_[c] -= weights[c] * weights[c];
  }
  rows_.push_back(std::move(weights));
}

double ErrorModel::expected(std::size_t candidate) const {
  return known_[candidate] != 0 ? scores_[candidate] : estimates_[candidate] + error_[candidate];
}

double ErrorModel::doubt(std::size_t candidate) const {
  if (known_[candidate] != 0 || rows_.size() < 2) {
    return 0.0;
  }
  return std::sqrt(scale_ * (std::max(variance_[candidate], 0.0) + kNoise));
}

double ErrorModel::noise() const {
  return std::sqrt(scale_ * kNoise);
}

}  // namespace vantage
