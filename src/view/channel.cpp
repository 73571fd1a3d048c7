// SPDX-License-Identifier: MIT
#include "vantage/view/channel.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "vantage/core/error.h"

#include "core/parallel.h"
#include "core/shannon.h"
#include "view/channel_check.h"
#include "view/entropy_of_new.h"

namespace vantage {
namespace {

// Views a chunk.
constexpr std::size_t kDirectionsPerTask = 4;

/// The area that each view sees in all. \throw InvalidInput
std::vector<double> seen_areas(const ViewChannel& channel) {
  check_channel(channel);
  std::vector<double> areas;
  areas.reserve(channel.views.size());
  for (const auto& view : channel.views) {
    double sum = 0.0;
    for (const FaceArea& seen : view) {
      sum += static_cast<double>(seen.area);
    }
    areas.push_back(sum);
  }
  return areas;
}

/// x log2(x / y), and 0 for x = 0.
double divergence_term(double x, double y) {
  return x > 0.0 ? x * log_2(x / y) : 0.0;
}

/// What Feixas's merge keeps of v̂: Σ a_z, Σ a_t and Σ_z s_z log(s_z / p_z).
class MergedView {
 public:
  MergedView(const ViewChannel& channel, const std::vector<double>& seen)
      : channel_(channel), seen_(seen), p_(channel.face_count, 0.0), s_(channel.face_count, 0.0) {
    double all = 0.0;
    for (const auto& view : channel.views) {
      for (const FaceArea& a : view) {
        p_[a.face] += static_cast<double>(a.area);
      }
    }
    for (const double area : p_) {
      all += area;
    }
    for (double& p : p_) {
      p = all > 0.0 ? p / all : 0.0;
    }
  }

  /// I(v̂;Z) if the view were merged in. Only its own faces change their terms.
  [[nodiscard]] double with(std::size_t view) const {
    const double total = total_ + seen_[view];
    return (sum_ + change(view)) / total - log_2(total);
  }

  void merge(std::size_t view) {
    sum_ += change(view);
    total_ += seen_[view];
    for (const FaceArea& a : channel_.views[view]) {
      s_[a.face] += static_cast<double>(a.area);
    }
  }

 private:
  [[nodiscard]] double change(std::size_t view) const {
    double sum = 0.0;
    for (const FaceArea& a : channel_.views[view]) {
      const double before = s_[a.face];
      sum += divergence_term(before + static_cast<double>(a.area), p_[a.face]) -
             divergence_term(before, p_[a.face]);
    }
    return sum;
  }

  const ViewChannel& channel_;
  const std::vector<double>& seen_;
  std::vector<double> p_;
  std::vector<double> s_;
  double total_ = 0.0;
  double sum_ = 0.0;
};

}  // namespace

std::vector<ChannelPick> greedy_entropy_views(const ViewChannel& channel, std::size_t count,
                                              const RunContext& run) {
  const std::vector<double> seen = seen_areas(channel);
  std::vector<std::uint8_t> dropped(channel.face_count, 0);
  std::vector<ChannelPick> picks;
  std::vector<double> entropy(channel.views.size(), 0.0);
  while (picks.size() < count) {
    parallel_for(run.quiet(), entropy.size(), kDirectionsPerTask,
                 [&](std::size_t begin, std::size_t end) {
                   for (std::size_t v = begin; v < end; ++v) {
                     entropy[v] = entropy_of_new(channel.views[v], seen[v], dropped);
                   }
                 });
    const auto best = std::max_element(entropy.begin(), entropy.end());
    if (best == entropy.end() || !(*best > 0.0)) {
      break;
    }
    const auto view = static_cast<std::uint32_t>(best - entropy.begin());
    picks.push_back({view, *best});
    for (const FaceArea& a : channel.views[view]) {
      dropped[a.face] = 1;
    }
  }
  return picks;
}

namespace {

/// Mean of the views' information by what they see of all.
double mean_information(const std::vector<double>& seen, double all,
                        const std::vector<double>& information) {
  double mean = 0.0;
  for (std::size_t v = 0; v < seen.size(); ++v) {
    mean += seen[v] > 0.0 ? seen[v] / all * information[v] : 0.0;
  }
  return mean;
}

/// The usable view of least information; the first of equals, empty if none is usable.
std::optional<std::size_t> least_informed(const std::vector<double>& information,
                                          const std::vector<std::uint8_t>& usable) {
  std::optional<std::size_t> best;
  for (std::size_t v = 0; v < usable.size(); ++v) {
    if (usable[v] != 0 && (!best || information[v] < information[*best])) {
      best = v;
    }
  }
  return best;
}

}  // namespace

MergedViews merge_views(const ViewChannel& channel, std::size_t count, double ratio,
                        const RunContext& run) {
  if (!(ratio >= 0.0 && ratio <= 1.0)) {
    throw InvalidInput("the ratio of information to stop at must be between 0 and 1");
  }
  const std::vector<double> seen = seen_areas(channel);
  double all = 0.0;
  for (const double area : seen) {
    all += area;
  }
  MergedView merged(channel, seen);
  std::vector<double> information(channel.views.size(), 0.0);
  std::vector<std::uint8_t> usable(channel.views.size(), 0);
  std::transform(seen.begin(), seen.end(), usable.begin(),
                 [](double area) { return area > 0.0 ? std::uint8_t{1} : std::uint8_t{0}; });
  MergedViews result;
  while (result.picks.size() < count) {
    parallel_for(run.quiet(), information.size(), kDirectionsPerTask,
                 [&](std::size_t begin, std::size_t end) {
                   for (std::size_t v = begin; v < end; ++v) {
                     information[v] = seen[v] > 0.0 ? merged.with(v) : 0.0;
                   }
                 });
    if (result.picks.empty()) {
      result.channel_information = mean_information(seen, all, information);
    }
    const std::optional<std::size_t> best = least_informed(information, usable);
    if (!best) {
      break;
    }
    usable[*best] = 0;
    merged.merge(*best);
    // Less than nothing is rounding.
    result.picks.push_back({static_cast<std::uint32_t>(*best), std::max(0.0, information[*best])});
    if (ratio > 0.0 && information[*best] <= ratio * result.channel_information) {
      break;
    }
  }
  return result;
}

ViewChannel channel_table(const FaceVisibility& faces, std::span<const Viewpoint> eyes,
                          const RunContext& run) {
  ViewChannel channel;
  channel.face_count = faces.face_count();
  channel.views.resize(eyes.size());
  const double unit = faces.area_unit();
  parallel_for(run.quiet(), eyes.size(), 1, [&](std::size_t begin, std::size_t end) {
    const RunContext alone = run.alone();
    for (std::size_t i = begin; i < end; ++i) {
      for (const SeenFace& face : faces.seen_faces(eyes[i], alone)) {
        const auto stored = static_cast<float>(face.projected_area / unit);
        if (stored > 0.0F && std::isfinite(stored)) {
          channel.views[i].push_back({face.face, stored});
        }
      }
      channel.views[i].shrink_to_fit();
    }
  });
  return channel;
}

}  // namespace vantage
