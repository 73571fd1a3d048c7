// SPDX-License-Identifier: MIT
#include "significance/gaussian_means.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>

#include "core/parallel.h"
#include "core/wide_registers.h"

namespace vantage {
namespace {

constexpr std::size_t kLanes = 4;
using Lanes = double __attribute__((vector_size(kLanes * sizeof(double))));
using Bits = std::int64_t __attribute__((vector_size(kLanes * sizeof(std::int64_t))));

constexpr std::size_t kScales = kGaussianScales.size();
constexpr double kReach = kGaussianReach * kGaussianScales.back();
/// How far the largest of the scales reaches that are half of another.
constexpr double kHalfReach = kReach / 2.0;
/// Side of a cell: large enough for some vertices of a fine mesh to share what is near them, small
/// against the reach.
constexpr double kCell = kReach / 4.0;
constexpr std::int64_t kCellsFar = 4;
/// Where no point is near: what lists are filled up with.
constexpr double kNowhere = 1e9;
constexpr std::size_t kPartsPerTask = 8;
/// One far part of a model can leave all the rest of it in one cell, whose points are then shared out.
constexpr std::size_t kPointsPerPart = 256;

/// exp(−t) for t from 0 to 2, what a Gaussian within its reach needs: the eighth power of a Taylor
/// series, of which the first term left out is below 1e-17. Without a table, which lanes would have
/// to wait for. Anything for other t.
VANTAGE_INLINE void falling_exponential(const Lanes& t, Lanes& result) {
  const Lanes u = t * -0.125;
  Lanes sum = u * (1.0 / 479001600.0) + 1.0 / 39916800.0;
  sum = sum * u + 1.0 / 3628800.0;
  sum = sum * u + 1.0 / 362880.0;
  sum = sum * u + 1.0 / 40320.0;
  sum = sum * u + 1.0 / 5040.0;
  sum = sum * u + 1.0 / 720.0;
  sum = sum * u + 1.0 / 120.0;
  sum = sum * u + 1.0 / 24.0;
  sum = sum * u + 1.0 / 6.0;
  sum = sum * u + 0.5;
  sum = sum * u + 1.0;
  sum = sum * u + 1.0;
  sum *= sum;
  sum *= sum;
  result = sum * sum;
}

/// Points near a cell, coordinate by coordinate, filled up to whole lanes.
struct NearPoints {
  std::vector<double> x{}, y{}, z{}, value{}, weight{};

  void clear() {
    for (std::vector<double>* list : {&x, &y, &z, &value, &weight}) {
      list->clear();
    }
  }

  void add(const FieldPoints& points, std::uint32_t i) {
    const Vec3& p = points.position[i];
    x.push_back(p.x());
    y.push_back(p.y());
    z.push_back(p.z());
    value.push_back(points.value[i]);
    weight.push_back(points.weight[i]);
  }

  void fill_up() {
    const std::size_t whole = (x.size() + kLanes - 1) / kLanes * kLanes;
    x.resize(whole, kNowhere);
    for (std::vector<double>* list : {&y, &z, &value, &weight}) {
      list->resize(whole, 0.0);
    }
  }
};

VANTAGE_INLINE void load(const std::vector<double>& list, std::size_t i, Lanes& lanes) {
  __builtin_memcpy(&lanes, list.data() + i, sizeof lanes);
}

VANTAGE_INLINE double total(const Lanes& lanes) {
  return (lanes[0] + lanes[1]) + (lanes[2] + lanes[3]);
}

VANTAGE_INLINE bool any(const Bits& is_true) {
  return (is_true[0] | is_true[1] | is_true[2] | is_true[3]) != 0;
}

/// Sums over the points near one.
struct GaussianSums {
  std::array<Lanes, kScales> of_value{}, of_weight{};

  /// Adds what lies within a scale's reach. \param squared distances. \param g its Gaussian.
  VANTAGE_INLINE void add(std::size_t scale, const Lanes& squared, const Lanes& g,
                          const Lanes& value, const Lanes& weight) {
    const double reach = kGaussianReach * kGaussianScales[scale];
    const Bits is_near = squared <= reach * reach;
    const Lanes share = reinterpret_cast<Lanes>(is_near & reinterpret_cast<Bits>(g)) * weight;
    of_value[scale] += share * value;
    of_weight[scale] += share;
  }

  /// Adds a scale at which the Gaussian is not known yet.
  VANTAGE_INLINE void add_anew(std::size_t scale, const Lanes& squared, const Lanes& value,
                               const Lanes& weight, Lanes& g) {
    const double sigma = kGaussianScales[scale];
    falling_exponential(squared * (0.5 / (sigma * sigma)), g);
    add(scale, squared, g, value, weight);
  }

  /// Adds half a scale, whose Gaussian is the fourth power of the whole one's. \param g of the
  /// whole scale; of the half one after.
  VANTAGE_INLINE void add_half(std::size_t scale, const Lanes& squared, const Lanes& value,
                               const Lanes& weight, Lanes& g) {
    g *= g;
    g *= g;
    add(scale, squared, g, value, weight);
  }
};

VANTAGE_INLINE void means_here(const NearPoints& near, const Vec3& place, GaussianMeans& means) {
  GaussianSums sums;
  for (std::size_t i = 0; i < near.x.size(); i += kLanes) {
    Lanes x;
    Lanes y;
    Lanes z;
    load(near.x, i, x);
    load(near.y, i, y);
    load(near.z, i, z);
    x -= place.x();
    y -= place.y();
    z -= place.z();
    const Lanes squared = x * x + y * y + z * z;
    if (!any(squared <= kReach * kReach)) {
      continue;
    }
    Lanes value;
    Lanes weight;
    load(near.value, i, value);
    load(near.weight, i, weight);
    Lanes g12;
    Lanes g10;
    Lanes g8;
    sums.add_anew(7, squared, value, weight, g12);
    sums.add_anew(6, squared, value, weight, g10);
    sums.add_anew(5, squared, value, weight, g8);
    if (any(squared <= kHalfReach * kHalfReach)) {
      sums.add_half(4, squared, value, weight, g12);  // 6
      sums.add_half(3, squared, value, weight, g10);  // 5
      sums.add_half(2, squared, value, weight, g8);   // 4
      sums.add_half(1, squared, value, weight, g12);  // 3
      sums.add_half(0, squared, value, weight, g8);   // 2
    }
  }
  for (std::size_t s = 0; s < kScales; ++s) {
    const double weight = total(sums.of_weight[s]);
    means[s] = weight > 0.0 ? total(sums.of_value[s]) / weight : 0.0;
  }
}

#if defined(__x86_64__)
[[gnu::target("avx2")]] void means_wide(const NearPoints& near, const Vec3& place,
                                        GaussianMeans& means) {
  means_here(near, place, means);
}
#endif

void means_at(const NearPoints& near, const Vec3& place, GaussianMeans& means) {
#if defined(__x86_64__)
  if (has_wide_registers()) {
    means_wide(near, place, means);
    return;
  }
#endif
  means_here(near, place, means);
}

/// The cells of a grid that hold points, along z, y and x.
class Cells {
 public:
  using Key = std::array<std::int64_t, 3>;  // z, y, x

  explicit Cells(const FieldPoints& points) : order_(points.position.size()) {
    std::vector<Key> key_of;
    key_of.reserve(points.position.size());
    for (const Vec3& p : points.position) {
      key_of.push_back({cell(p.z()), cell(p.y()), cell(p.x())});
    }
    std::iota(order_.begin(), order_.end(), std::uint32_t{0});
    std::sort(order_.begin(), order_.end(), [&](std::uint32_t a, std::uint32_t b) {
      return key_of[a] != key_of[b] ? key_of[a] < key_of[b] : a < b;
    });
    for (std::uint32_t i = 0; i < order_.size(); ++i) {
      if (i == 0 || key_of[order_[i]] != keys_.back()) {
        keys_.push_back(key_of[order_[i]]);
        first_.push_back(i);
      }
    }
    first_.push_back(static_cast<std::uint32_t>(order_.size()));
  }

  [[nodiscard]] std::size_t size() const { return keys_.size(); }

  [[nodiscard]] std::span<const std::uint32_t> points_of(std::size_t cell) const {
    return std::span(order_).subspan(first_[cell], first_[cell + 1] - first_[cell]);
  }

  /// Calls each(point) for all points that may be within reach of one in the cell.
  template <class Each>
  void for_near(std::size_t cell, const Each& each) const {
    const Key& here = keys_[cell];
    for (std::int64_t z = here[0] - kCellsFar; z <= here[0] + kCellsFar; ++z) {
      for (std::int64_t y = here[1] - kCellsFar; y <= here[1] + kCellsFar; ++y) {
        const auto begin =
            std::lower_bound(keys_.begin(), keys_.end(), Key{z, y, here[2] - kCellsFar});
        const auto end = std::upper_bound(begin, keys_.end(), Key{z, y, here[2] + kCellsFar});
        const auto from = first_[static_cast<std::size_t>(begin - keys_.begin())];
        const auto to = first_[static_cast<std::size_t>(end - keys_.begin())];
        std::for_each(order_.begin() + from, order_.begin() + to, each);
      }
    }
  }

 private:
  static std::int64_t cell(double place) { return static_cast<std::int64_t>(place / kCell); }

  std::vector<std::uint32_t> order_;    // points, cell by cell
  std::vector<Key> keys_{};             // of each cell, ascending
  std::vector<std::uint32_t> first_{};  // in order_, and one past the last
};

/// Some points of a cell.
struct CellPart {
  std::size_t cell = 0;
  std::span<const std::uint32_t> points{};
};

std::vector<CellPart> parts_of(const Cells& cells) {
  std::vector<CellPart> parts;
  for (std::size_t cell = 0; cell < cells.size(); ++cell) {
    const std::span<const std::uint32_t> all = cells.points_of(cell);
    for (std::size_t begin = 0; begin < all.size(); begin += kPointsPerPart) {
      parts.push_back({cell, all.subspan(begin, std::min(kPointsPerPart, all.size() - begin))});
    }
  }
  return parts;
}

}  // namespace

std::vector<GaussianMeans> gaussian_means(const FieldPoints& points, const RunContext& run) {
  std::vector<GaussianMeans> means(points.position.size());
  const Cells cells(points);
  const std::vector<CellPart> parts = parts_of(cells);
  // Blocks, so that a bar moves.
  const std::size_t block = std::max<std::size_t>(kPartsPerTask, parts.size() / 64);
  for (std::size_t first = 0; first < parts.size(); first += block) {
    run.advance("saliency", static_cast<double>(first) / static_cast<double>(parts.size()));
    const std::size_t count = std::min(block, parts.size() - first);
    parallel_for(run, count, kPartsPerTask, [&](std::size_t begin, std::size_t end) {
      NearPoints near;
      for (const CellPart& part : std::span(parts).subspan(first + begin, end - begin)) {
        near.clear();
        cells.for_near(part.cell, [&](std::uint32_t i) { near.add(points, i); });
        near.fill_up();
        for (const std::uint32_t i : part.points) {
          run.check();
          means_at(near, points.position[i], means[i]);
        }
      }
    });
  }
  return means;
}

}  // namespace vantage
