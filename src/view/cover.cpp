// SPDX-License-Identifier: MIT
#include "view/cover.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "vantage/core/error.h"

#include "core/parallel.h"

namespace vantage {
namespace {

// Views a chunk of gains().
constexpr std::size_t kGrain = 16;
// What the sums of bounds may round away, relative: bounds are widened by it.
constexpr double kRounding = 1e-12;

}  // namespace

GreedyCover::GreedyCover(const VisibleSets& sets, std::span<const double> weights,
                         const RunContext& run)
    : sets_(&sets),
      weights_(weights.begin(), weights.end()),
      unseen_((sets.vertex_count() + 63) / 64, ~std::uint64_t{0}) {
  if (weights.size() != sets.vertex_count()) {
    throw InvalidInput("a cover needs one weight a vertex");
  }
  for (const double w : weights) {
    if (!(w >= 0.0) || !std::isfinite(w)) {
      throw InvalidInput("the weights of a cover must be finite and nowhere negative");
    }
  }
  const std::vector<double> first = gains(run);
  for (std::uint32_t i = 0; i < first.size(); ++i) {
    queue_.push({first[i], i});
  }
}

GreedyCover::Pick GreedyCover::next(const std::function<bool(std::uint32_t view)>& allowed) {
  while (!queue_.empty()) {
    const Bound top = queue_.top();
    queue_.pop();
    if (!allowed(top.view)) {
      continue;
    }
    const Bound now{gain(sets_->row(top.view)), top.view};
    const bool is_largest = queue_.empty() || !(now < queue_.top());
    queue_.push(now);  // what is taken may be a view beside it, and leave something to this one
    if (is_largest) {
      return now.gain > 0.0 ? Pick{now.view, now.gain} : Pick{};
    }
  }
  return {};
}

double GreedyCover::gain(std::span<const std::uint64_t> row) const {
  double sum = 0.0;
  for (std::size_t w = 0; w < row.size(); ++w) {
    for (std::uint64_t bits = row[w] & unseen_[w]; bits != 0; bits &= bits - 1) {
      sum += weights_[64 * w + static_cast<std::size_t>(std::countr_zero(bits))];
    }
  }
  return sum;
}

void GreedyCover::mark_seen(std::span<const std::uint64_t> row) {
  for (std::size_t w = 0; w < row.size(); ++w) {
    unseen_[w] &= ~row[w];
  }
}

std::vector<double> GreedyCover::gains(const RunContext& run) const {
  std::vector<double> result(sets_->view_count(), 0.0);
  const RunContext quiet = run.quiet();
  parallel_for(quiet, result.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      result[i] = gain(sets_->row(i));
    }
  });
  return result;
}

void CoverBound::add_state(double seen, std::vector<double> gains) {
  std::sort(gains.begin(), gains.end(), std::greater<>());
  std::vector<double> covered{seen};
  for (const double g : gains) {
    covered.push_back(covered.back() + g);
  }
  for (double& value : covered) {
    value *= 1.0 + kRounding;
  }
  covered_by_.push_back(std::move(covered));
}

double CoverBound::most_covered(std::size_t count) const {
  double most = std::numeric_limits<double>::infinity();
  for (const std::vector<double>& covered : covered_by_) {
    most = std::min(most, covered[std::min(count, covered.size() - 1)]);
  }
  return most;
}

std::size_t CoverBound::least_views(double wanted) const {
  std::size_t least = 0;
  for (const std::vector<double>& covered : covered_by_) {
    const auto enough = std::lower_bound(covered.begin(), covered.end(), wanted);
    least = std::max(least, static_cast<std::size_t>(enough - covered.begin()));
  }
  return least;
}

}  // namespace vantage
