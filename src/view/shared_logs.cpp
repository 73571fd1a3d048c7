// SPDX-License-Identifier: MIT
#include "view/shared_logs.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>

#include "core/shannon.h"
#include "core/shannon_lanes.h"
#include "core/wide_registers.h"

namespace vantage {
namespace {

static_assert(sizeof(FaceArea) == 2 * sizeof(float) && offsetof(FaceArea, area) == sizeof(float));

/// The areas of kLogLanes entries.
VANTAGE_INLINE void load_areas(const FaceArea* entries, LogLanes& areas) {
  using Entries = float __attribute__((vector_size(2 * kLogLanes * sizeof(float))));
  Entries both;
  std::memcpy(&both, entries, sizeof both);
  areas = __builtin_convertvector(__builtin_shufflevector(both, both, 1, 3, 5, 7), LogLanes);
}

/// Multiplies areas, which are rounded as they are stored.
VANTAGE_INLINE void multiply(LogLanes& areas, double scale) {
  using Stored = float __attribute__((vector_size(kLogLanes * sizeof(float))));
  areas = __builtin_convertvector(__builtin_convertvector(scale * areas, Stored), LogLanes);
}

/// Calls add(entries, how many of them count) for kLogLanes at a time. What fills up the last has
/// area 1, whose logarithm is 0, and the place of an entry of the list.
template <class Add>
VANTAGE_INLINE void for_lanes(std::span<const FaceArea> list, const Add& add) {
  std::size_t i = 0;
  for (; i + kLogLanes <= list.size(); i += kLogLanes) {
    add(list.data() + i, kLogLanes);
  }
  if (i < list.size()) {
    std::array<FaceArea, kLogLanes> rest{};
    rest.fill({list[i].face, 1.0F});
    std::copy(list.begin() + static_cast<std::ptrdiff_t>(i), list.end(), rest.begin());
    add(rest.data(), list.size() - i);
  }
}

VANTAGE_INLINE double in_order(const LogLanes& lanes) {
  return (lanes[0] + lanes[1]) + (lanes[2] + lanes[3]);
}

VANTAGE_INLINE double sum_of_logs_here(std::span<const FaceArea> list) {
  LogLanes sum{};
  for_lanes(
      list, [&](const FaceArea* entries, std::size_t /*count*/) __attribute__((always_inline)) {
        LogLanes areas;
        LogLanes logs;
        load_areas(entries, areas);
        log_2(areas, logs);
        sum += areas * logs;
      });
  return in_order(sum);
}

template <class Cell>
VANTAGE_INLINE void put_here(std::span<const FaceArea> list, Cell* cells) {
  for_lanes(
      list, [&](const FaceArea* entries, std::size_t count) __attribute__((always_inline)) {
        LogLanes areas;
        LogLanes logs;
        load_areas(entries, areas);
        log_2(areas, logs);
        logs *= areas;
        for (std::size_t k = 0; k < count; ++k) {
          cells[entries[k].face] = {areas[k], logs[k]};
        }
      });
}

template <class Cell>
VANTAGE_INLINE double logs_with_here(std::span<const FaceArea> list, double scale,
                                     const Cell* cells) {
  LogLanes sum{};
  for_lanes(
      list, [&](const FaceArea* entries, std::size_t count) __attribute__((always_inline)) {
        const Cell& p = cells[entries[0].face];
        const Cell& q = cells[entries[1].face];
        const Cell& r = cells[entries[2].face];
        const Cell& s = cells[entries[3].face];
        LogLanes areas;
        load_areas(entries, areas);
        LogLanes both{p.area, q.area, r.area, s.area};
        LogLanes own{p.log, q.log, r.log, s.log};
        multiply(areas, scale);
        both += areas;
        for (std::size_t k = count; k < kLogLanes; ++k) {
          both[k] = 1.0;
          own[k] = 0.0;
        }
        LogLanes logs;
        log_2(both, logs);
        sum += both * logs - own;
      });
  return in_order(sum);
}

#if defined(__x86_64__)
[[gnu::target("avx2")]] double sum_of_logs_wide(std::span<const FaceArea> list) {
  return sum_of_logs_here(list);
}

template <class Cell>
[[gnu::target("avx2")]] void put_wide(std::span<const FaceArea> list, Cell* cells) {
  put_here(list, cells);
}

template <class Cell>
[[gnu::target("avx2")]] double logs_with_wide(std::span<const FaceArea> list, double scale,
                                              const Cell* cells) {
  return logs_with_here(list, scale, cells);
}
#endif

/// (a + b) log (a + b) − a log a − b log b. The same bits for (b, a).
double shared_term(double a, double b) {
  return x_log_x(a + b) - (x_log_x(a) + x_log_x(b));
}

}  // namespace

double sum_of_logs(std::span<const FaceArea> list) {
#if defined(__x86_64__)
  if (has_wide_registers()) {
    return sum_of_logs_wide(list);
  }
#endif
  return sum_of_logs_here(list);
}

void LaidOutAreas::put(std::span<const FaceArea> list) {
  for (const FaceArea& entry : list_) {
    cells_[entry.face] = {};
  }
  list_ = list;
#if defined(__x86_64__)
  if (has_wide_registers()) {
    put_wide(list, cells_.data());
    return;
  }
#endif
  put_here(list, cells_.data());
}

double LaidOutAreas::logs_with(std::span<const FaceArea> other, double scale) const {
#if defined(__x86_64__)
  if (has_wide_registers()) {
    return logs_with_wide(other, scale, cells_.data());
  }
#endif
  return logs_with_here(other, scale, cells_.data());
}

double divergence_of(const SummedAreas& a, const LaidOutAreas& laid_out, const SummedAreas& b) {
  if (!(a.area > 0.0) || !(b.area > 0.0)) {
    return 0.0;
  }
  const double shared = laid_out.logs_with(b.list, b.scale) - b.logs;
  return std::clamp((shared_term(a.area, b.area) - shared) / (a.area + b.area), 0.0, 1.0);
}

}  // namespace vantage
