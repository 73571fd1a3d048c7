// SPDX-License-Identifier: MIT
#include "view/global_search.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

#include "vantage/spatial/directions.h"

#include "view/ascent.h"
#include "view/error_model.h"
#include "view/sphere_angles.h"

namespace vantage {
namespace {

// How much is looked at on the way. All ours, chosen on the models that docs/search.md names.
constexpr int kDenseLevel = 5;           // 10 242 directions, 2° apart. First are looked at …
constexpr std::size_t kFirstLook = 162;  // … the first of them, 16° apart, which are level 2, …
constexpr std::size_t kCloserLook = 642;  // … then, of level 3, those next to a promising one, …
constexpr std::size_t kNearerLook = 2562;         // … of level 4, too, …
constexpr double kCloserRad = 11.0 * kRadPerDeg;  // … within reach of the six around it, …
constexpr double kNearerRad = 5.8 * kRadPerDeg;
constexpr double kHillRad = 4.0 * kRadPerDeg;  // … and all as near to the top of a hill as this.
// After a search that taught what estimates are wrong by, half as many count as promising.
constexpr std::size_t kTaughtShare = 2;
constexpr std::size_t kSureMarks = 4;  // landmarks scored whatever their estimates
// Apart are those scored before anything is learnt, those scored at a time from then on, and scouts and
// all that is scored:
constexpr double kFirstApartRad = 8.0 * kRadPerDeg;
constexpr double kApartRad = 1.0 * kRadPerDeg;
constexpr double kScoutsApartRad = 8.0 * kRadPerDeg;
constexpr double kBoldness = 0.5;  // doubts added to an expected score to rank directions
constexpr double kSameHillRad = 1.0 * kRadPerDeg;
constexpr double kTooLow = 2.0;  // a place below the best by so much of the noise does not climb

/// All directions that may take part.
const DirectionSet& dense_directions() {
  static const DirectionSet set = direction_set(ViewSphereBase::Icosahedron, kDenseLevel);
  return set;
}

bool best_first(const Candidate& a, const Candidate& b) {
  return a.score > b.score;
}

/// The first few of those that are not nearer than an angle to one before.
std::vector<Candidate> first_apart(const std::vector<Candidate>& candidates, std::size_t count,
                                   double apart_rad) {
  std::vector<Candidate> chosen;
  const double limit = std::cos(apart_rad);
  for (const Candidate& one : candidates) {
    const bool taken = std::any_of(chosen.begin(), chosen.end(), [&](const Candidate& other) {
      return other.direction.dot(one.direction) > limit;
    });
    if (!taken && chosen.size() < count) {
      chosen.push_back(one);
    }
  }
  return chosen;
}

/// The best few, best first, no two nearer to each other than an angle.
std::vector<Candidate> best_apart(std::vector<Candidate> candidates, std::size_t count,
                                  double apart_rad) {
  std::stable_sort(candidates.begin(), candidates.end(), best_first);
  return first_apart(candidates, count, apart_rad);
}

/// Looks for the largest value of sign · score: estimates choose what is scored, and what the
/// scores teach about them decides what is scored next.
class Hunt {
 public:
  /// \param lessons of estimates by a search before, if there was one.
  Hunt(const Guides& guides, Goal goal, const std::vector<KnownScore>& lessons);

  /// Estimates of the whole sphere, closer where they promise something.
  void look_over(const RunContext& run);

  /// Scores the first landmarks and the best of the others, and directions that no estimate is
  /// trusted with.
  void score_marks(const std::vector<Vec3>& landmarks, const std::vector<Vec3>& brinks);

  /// Scores directions until none is left that could be better, or enough are scored. The first of them
  /// teach what estimates are wrong by, unless a search before did.
  void settle(const RunContext& run);

  /// The best few of what was scored, as they were scored, each hill once, but for those too low.
  [[nodiscard]] std::vector<Candidate> best_known(std::size_t count) const;

  /// How rough scores are, or estimates; 0 where estimates are exact and teach nothing.
  [[nodiscard]] double noise() const { return model_.noise(); }

 private:
  void list(const std::vector<std::uint32_t>& dense, const RunContext& run);
  void look_around(std::size_t places, double reach_rad, std::size_t count);
  void open(std::vector<Candidate> places);
  void score(const std::vector<std::size_t>& chosen);
  [[nodiscard]] std::vector<std::uint32_t> near(const Vec3& centre, double reach_rad,
                                                std::size_t count) const;

  /// What is expected of a candidate, and some doubts.
  [[nodiscard]] double prospect(std::size_t c, double boldness) const {
    return model_.expected(c) + boldness * model_.doubt(c);
  }

  [[nodiscard]] std::vector<std::size_t> ranked(double boldness) const;
  [[nodiscard]] std::vector<std::size_t> pick(std::size_t count, double apart_rad,
                                              double boldness) const;
  void add_scouts(std::vector<std::size_t>& chosen) const;
  [[nodiscard]] std::vector<Candidate> expectations() const;
  [[nodiscard]] bool is_hopeless() const;

  [[nodiscard]] bool is_scored(const Vec3& direction) const {
    return std::any_of(known_.begin(), known_.end(),
                       [&](const Candidate& known) { return known.direction == direction; });
  }

  const Guides& guides_;
  const Effort& effort_;
  const Pursuit& pursuit_;
  double sign_;
  const DirectionSet& dense_ = dense_directions();
  std::vector<std::uint8_t> listed_;  // of the dense directions: in the model
  bool is_taught_;                    // what estimates are wrong by, by a search before
  ErrorModel model_{};
  std::vector<Candidate> known_{};  // scored exactly, as sign · score
};

Hunt::Hunt(const Guides& guides, Goal goal, const std::vector<KnownScore>& lessons)
    : guides_(guides),
      effort_(guides.effort),
      pursuit_(guides.effort.to(goal)),
      sign_(goal == Goal::Best ? 1.0 : -1.0),
      listed_(dense_.directions.size(), 0),
      is_taught_(!lessons.empty()) {
  for (const KnownScore& lesson : lessons) {
    model_.learn(model_.add(lesson.direction, sign_ * lesson.estimate), sign_ * lesson.score);
    known_.push_back({lesson.direction, sign_ * lesson.score});
  }
}

/// The dense directions near one, of the first `count`.
std::vector<std::uint32_t> Hunt::near(const Vec3& centre, double reach_rad,
                                      std::size_t count) const {
  std::vector<std::uint32_t> found;
  const double limit = std::cos(reach_rad);
  for (std::uint32_t i = 0; i < count; ++i) {
    if (dense_.directions[i].dot(centre) > limit) {
      found.push_back(i);
    }
  }
  return found;
}

/// Has directions take part, by their estimates.
void Hunt::list(const std::vector<std::uint32_t>& dense, const RunContext& run) {
  std::vector<Vec3> fresh;
  for (const std::uint32_t i : dense) {
    if (listed_[i] == 0) {
      listed_[i] = 1;
      if (!is_scored(dense_.directions[i])) {
        fresh.push_back(dense_.directions[i]);
      }
    }
  }
  const std::vector<double> values = guides_.estimates.scores(fresh, 0, run);
  for (std::size_t i = 0; i < fresh.size(); ++i) {
    model_.add(fresh[i], sign_ * values[i]);
  }
}

/// Has the directions next to the best few take part, of the first `count`.
void Hunt::look_around(std::size_t places, double reach_rad, std::size_t count) {
  const std::vector<std::size_t> best = ranked(0.0);
  std::vector<std::uint32_t> halfway;
  for (std::size_t k = 0; k < std::min(places, best.size()); ++k) {
    const std::vector<std::uint32_t> around = near(model_.direction(best[k]), reach_rad, count);
    halfway.insert(halfway.end(), around.begin(), around.end());
  }
  list(halfway, {});
}

void Hunt::look_over(const RunContext& run) {
  std::vector<std::uint32_t> first(kFirstLook);
  std::iota(first.begin(), first.end(), 0U);
  list(first, run);
  const std::size_t share = is_taught_ ? kTaughtShare : 1;
  look_around(effort_.first_promising / share, kCloserRad, kCloserLook);
  look_around(effort_.promising / share, kNearerRad, kNearerLook);
}

void Hunt::score(const std::vector<std::size_t>& chosen) {
  std::vector<Vec3> directions;
  directions.reserve(chosen.size());
  for (const std::size_t c : chosen) {
    directions.push_back(model_.direction(c));
  }
  const std::vector<double> values = guides_.exact.scores(directions, 0);
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    known_.push_back({directions[i], sign_ * values[i]});
    model_.learn(chosen[i], sign_ * values[i]);
  }
}

void Hunt::score_marks(const std::vector<Vec3>& landmarks, const std::vector<Vec3>& brinks) {
  const auto by_estimate = [&](const std::vector<Vec3>& directions) {
    const std::vector<double> values = guides_.estimates.scores(directions, 0);
    std::vector<Candidate> marks;
    for (std::size_t i = 0; i < directions.size(); ++i) {
      marks.push_back({directions[i], sign_ * values[i]});
    }
    return marks;
  };
  std::vector<Candidate> marks = by_estimate(landmarks);
  const std::size_t sure = std::min(kSureMarks, marks.size());
  std::stable_sort(marks.begin() + static_cast<std::ptrdiff_t>(sure), marks.end(), best_first);
  marks.resize(std::min(marks.size(), sure + effort_.marks));
  std::vector<std::size_t> chosen;
  chosen.reserve(marks.size());
  for (const Candidate& mark : marks) {
    if (!is_scored(mark.direction)) {  // or a search before taught what it teaches
      chosen.push_back(model_.add(mark.direction, mark.score));
    }
  }
  score(chosen);
  open(known_);
  // What estimates are wrong by there says nothing of other directions.
  std::vector<Candidate> edges = by_estimate(brinks);
  std::stable_sort(edges.begin(), edges.end(), best_first);
  std::vector<Vec3> directions;
  for (std::size_t i = 0; i < std::min(edges.size(), effort_.brinks); ++i) {
    directions.push_back(edges[i].direction);
  }
  const std::vector<double> values = guides_.exact.scores(directions, 0);
  for (std::size_t i = 0; i < directions.size(); ++i) {
    known_.push_back({directions[i], sign_ * values[i]});
  }
}

/// All candidates by what is expected of them, and some of the doubt, best first.
std::vector<std::size_t> Hunt::ranked(double boldness) const {
  std::vector<double> prospects;
  prospects.reserve(model_.size());
  for (std::size_t c = 0; c < model_.size(); ++c) {
    prospects.push_back(prospect(c, boldness));
  }
  std::vector<std::size_t> order(model_.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return prospects[a] > prospects[b]; });
  return order;
}

/// The unknown candidates of the best prospects, best first, no two nearer than `apart_rad`.
std::vector<std::size_t> Hunt::pick(std::size_t count, double apart_rad, double boldness) const {
  std::vector<std::size_t> chosen;
  const double limit = std::cos(apart_rad);
  for (const std::size_t c : ranked(boldness)) {
    const bool taken =
        model_.knows(c) || std::any_of(chosen.begin(), chosen.end(), [&](std::size_t other) {
          return model_.direction(other).dot(model_.direction(c)) > limit;
        });
    if (!taken && chosen.size() < count) {
      chosen.push_back(c);
    }
  }
  return chosen;
}

/// Adds the unknown candidates that could be best by some doubts, far from all that is scored or
/// chosen: lest the search stays on the hills it knows.
void Hunt::add_scouts(std::vector<std::size_t>& chosen) const {
  std::vector<Vec3> taken;
  taken.reserve(known_.size() + chosen.size() + effort_.scouts);
  for (const Candidate& known : known_) {
    taken.push_back(known.direction);
  }
  for (const std::size_t c : chosen) {
    taken.push_back(model_.direction(c));
  }
  const double best = winner_of(Goal::Best, known_).score;
  const double limit = std::cos(kScoutsApartRad);
  const std::size_t full = chosen.size() + effort_.scouts;
  for (const std::size_t c : ranked(pursuit_.given_up)) {
    if (chosen.size() == full || prospect(c, pursuit_.given_up) <= best) {
      return;
    }
    const bool is_far = std::none_of(taken.begin(), taken.end(), [&](const Vec3& other) {
      return other.dot(model_.direction(c)) > limit;
    });
    if (is_far && !model_.knows(c)) {
      chosen.push_back(c);
      taken.push_back(model_.direction(c));
    }
  }
}

/// Has all dense directions around the best few of some places take part.
void Hunt::open(std::vector<Candidate> places) {
  for (const Candidate& top : best_apart(std::move(places), effort_.hills, kHillRad)) {
    list(near(top.direction, kHillRad, dense_.directions.size()), {});
  }
}

/// All candidates with what is expected of them.
std::vector<Candidate> Hunt::expectations() const {
  std::vector<Candidate> result;
  for (std::size_t c = 0; c < model_.size(); ++c) {
    result.push_back({model_.direction(c), model_.expected(c)});
  }
  return result;
}

std::vector<Candidate> Hunt::best_known(std::size_t count) const {
  std::vector<Candidate> tops = best_apart(known_, count, kSameHillRad);
  if (noise() > 0.0) {
    const double least = tops.front().score - kTooLow * noise();
    tops.erase(std::find_if(tops.begin(), tops.end(),
                            [&](const Candidate& top) { return top.score < least; }),
               tops.end());
  }
  for (Candidate& top : tops) {
    top.score *= sign_;
  }
  return tops;
}

/// Whether what is not known is most unlikely to be better than the best known.
bool Hunt::is_hopeless() const {
  const double best = winner_of(Goal::Best, known_).score;
  for (std::size_t c = 0; c < model_.size(); ++c) {
    if (!model_.knows(c) && prospect(c, pursuit_.given_up) > best) {
      return false;
    }
  }
  return true;
}

void Hunt::settle(const RunContext& run) {
  const std::size_t first = is_taught_ ? 0 : effort_.first;
  score(pick(first, kFirstApartRad, 0.0));
  for (std::size_t scored = first; scored < effort_.places;
       scored += effort_.prospects + effort_.scouts) {
    run.advance("search", static_cast<double>(scored) / static_cast<double>(effort_.places));
    open(expectations());
    if (is_hopeless()) {
      return;
    }
    std::vector<std::size_t> next = pick(effort_.prospects, kApartRad, kBoldness);
    add_scouts(next);
    score(next);
  }
}

}  // namespace

Candidate search_globally(const Guides& guides, Goal goal, const SearchHints& hints,
                          const RunContext& run) {
  Hunt hunt(guides, goal, hints.known);
  hunt.look_over(run.part(0.0, 0.3));
  hunt.score_marks(hints.landmarks, hints.brinks);
  hunt.settle(run.part(0.3, 0.7));
  const std::vector<Candidate> tops = hunt.best_known(guides.effort.to(goal).places.front());
  return climb_hills(guides, goal, tops, hunt.noise(), run.part(0.7, 1.0));
}

}  // namespace vantage
