// SPDX-License-Identifier: MIT
#include "vantage/orientation/orientation.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "vantage/core/camera.h"
#include "vantage/core/error.h"

#include "orientation/candidate_model.h"
#include "orientation/evidence.h"
#include "orientation/orientation_table.h"
#include "orientation/reasons.h"

namespace vantage {
namespace {

// Directions that the shape looks the same from, but for this mean difference of its height fields
// over the largest one that counts, are equally right. [ours]
constexpr double kAlike = 0.1;
// Log odds of a front, for each unit of net area that faces there beyond kOneSided. [ours]
constexpr double kOneSidedWeight = 20.0;
// A shape that makes no side likelier than this is of a kind that the fit of the front knows little of. [ours]
constexpr double kTellsNothing = 0.5;

const CandidateModel& up_model() {
  static const CandidateModel model(kOrientationTable, "up");
  return model;
}

const CandidateModel& front_model() {
  static const CandidateModel model(kOrientationTable, "front");
  return model;
}

/// \throw InvalidInput
AxisDirection axis_of(const Vec3& direction) {
  for (const AxisDirection axis : axis_directions()) {
    if (axis.vector().dot(direction) > 1.0 - 1e-9 && direction.norm() < 1.0 + 1e-9) {
      return axis;
    }
  }
  throw InvalidInput("up and front must be directions of the coordinate axes");
}

/// The four directions at right angles to `up`, opposite ones in pairs.
std::vector<AxisDirection> around(AxisDirection up) {
  std::vector<AxisDirection> ring;
  for (const AxisDirection direction : axis_directions()) {
    if (direction.axis != up.axis) {
      ring.push_back(direction);
    }
  }
  return ring;
}

/// Probabilities of candidates of these log odds.
std::vector<double> odds_of(std::vector<double> scores) {
  const double most = *std::max_element(scores.begin(), scores.end());
  double sum = 0.0;
  for (double& score : scores) {
    score = std::exp(score - most);
    sum += score;
  }
  for (double& score : scores) {
    score /= sum;
  }
  return scores;
}

// No choice is called surer: of ups that the fit calls 98 % sure, 97 % are right on models left out
// of it (docs/orientation.md), and there are shapes unlike all of its.
constexpr double kMostSure = 0.98;

/// What is added to the usual candidate's log odds.
struct Habit {
  std::size_t usual = 0;  ///< Its index; it wins ties.
  double log_odds = 0.0;
  double threshold = 0.0;  ///< Probability from which another one is taken.
};

/// Probabilities that a candidate is right, or looks just like what is right.
struct Confidence {
  std::vector<double> probability{};  ///< Of each candidate.
  std::vector<double> cap{};          ///< What may be stated of it at most: 1 if all look like it.

  /// \param first wins ties.
  [[nodiscard]] std::size_t best(std::size_t first) const {
    for (std::size_t c = 0; c < probability.size(); ++c) {
      first = probability[c] > probability[first] + 1e-9 ? c : first;
    }
    return first;
  }

  [[nodiscard]] double stated(std::size_t c) const { return std::min(probability[c], cap[c]); }
};

/// \param alike whether two candidates cannot be told apart.
template <class Alike>
Confidence confidence_of(const std::vector<AxisDirection>& candidates,
                         const std::vector<double>& odds, Alike&& alike) {
  Confidence confidence{std::vector<double>(odds.size(), 0.0),
                        std::vector<double>(odds.size(), 1.0)};
  for (std::size_t a = 0; a < odds.size(); ++a) {
    for (std::size_t b = 0; b < odds.size(); ++b) {
      const bool is_like = a == b || alike(candidates[a], candidates[b]);
      confidence.probability[a] += is_like ? odds[b] : 0.0;
      confidence.cap[a] = is_like ? confidence.cap[a] : kMostSure;
    }
    confidence.probability[a] = std::min(confidence.probability[a], 1.0);
  }
  return confidence;
}

/// Chooses among candidates.
/// \param scores log odds of each by the shape alone. \param reasons what of the shape speaks for a candidate.
template <class Alike, class Reasons>
DirectionChoice choose(const std::vector<AxisDirection>& candidates, std::vector<double> scores,
                       const Habit& habit, Alike&& alike, Reasons&& reasons) {
  const Confidence by_shape = confidence_of(candidates, odds_of(scores), alike);
  scores[habit.usual] += habit.log_odds;
  const Confidence confidence = confidence_of(candidates, odds_of(std::move(scores)), alike);
  const std::size_t best = confidence.best(habit.usual);
  const std::size_t chosen = confidence.probability[best] >= habit.threshold ? best : habit.usual;
  DirectionChoice choice{.direction = candidates[chosen].vector(),
                         .source = chosen == habit.usual ? "format" : "shape",
                         .confidence = confidence.stated(chosen),
                         .likeliest = candidates[best].vector(),
                         .likeliest_confidence = confidence.stated(best)};
  // Where the convention makes it likely, it is no reason of the shape's.
  if (by_shape.best(best) == best &&
      by_shape.probability[best] >= std::min(kTellsNothing, confidence.probability[best])) {
    choice.reasons = reasons(candidates[best]);
  }
  if (const std::size_t favoured = by_shape.best(chosen); favoured != chosen) {
    choice.by_shape = candidates[favoured].vector();
    choice.by_shape_confidence = by_shape.stated(favoured);
  }
  for (const AxisDirection other : candidates) {
    if (!(other == candidates[chosen]) && alike(candidates[chosen], other)) {
      choice.alike.push_back(other.vector());
    }
  }
  return choice;
}

DirectionChoice known(const Vec3& direction, const char* source) {
  return {.direction = direction, .source = source, .likeliest = direction};
}

std::size_t place_of(AxisDirection direction, const std::vector<AxisDirection>& candidates) {
  const auto found = std::find(candidates.begin(), candidates.end(), direction);
  return static_cast<std::size_t>(found - candidates.begin());
}

/// What open surfaces say that the table's models, most of them closed, do not. \param net share of the
/// area that looks to a side, less what looks to the opposite one.
double one_sided_log_odds(double net) {
  return kOneSidedWeight * (net - std::clamp(net, -kOneSided, kOneSided));
}

/// Log odds of the sides, if `up` is up, by the shape alone.
std::vector<double> front_scores(const MeasuredSides& sides, AxisDirection up) {
  std::vector<Evidence> evidence;
  for (const AxisDirection front : around(up)) {
    evidence.push_back(front_evidence(sides, up, front));
  }
  std::vector<double> scores = front_model().scores(evidence);
  for (std::size_t side = 0; side < scores.size(); ++side) {
    scores[side] += one_sided_log_odds(value_of("net_ahead", evidence[side]));
  }
  return scores;
}

/// What the side that the convention has in front adds to the log odds of its up: of files that are
/// upright by it a share faces as it says, of all others each side is as likely.
double facing_log_odds(const MeasuredSides& sides, const Vec3& usual_up) {
  const AxisDirection up = axis_of(usual_up);
  const std::size_t usual = place_of(axis_of(upright_frame(usual_up).front), around(up));
  const double share = front_model().share;
  return std::log(1.0 - share + share * 4.0 * odds_of(front_scores(sides, up))[usual]);
}

DirectionChoice find_up(const MeasuredSides& sides, const OrientationRequest& request) {
  if (request.up) {
    return known(*request.up, "given");
  }
  const AxisDirection usual = axis_of(request.usual_up);
  if (request.front && axis_of(*request.front).axis == usual.axis) {
    throw InvalidInput(
        "the front is along the up axis, which the format gives: give another front, or the up "
        "axis, too");
  }
  if (request.usual_up_is_certain) {
    return known(request.usual_up, "format");
  }
  std::vector<AxisDirection> candidates;
  std::vector<Evidence> evidence;
  const std::optional<AxisDirection> front =
      request.front ? std::optional(axis_of(*request.front)) : std::nullopt;
  for (const AxisDirection up : axis_directions()) {
    if (!front || front->axis != up.axis) {
      candidates.push_back(up);
      evidence.push_back(upright_evidence(sides, up));
    }
  }
  const Habit habit{.usual = place_of(usual, candidates),
                    .log_odds = up_model().convention_log_odds +
                                (front ? 0.0 : facing_log_odds(sides, request.usual_up)),
                    .threshold = up_model().threshold};
  return choose(
      candidates, up_model().scores(evidence), habit,
      [&](AxisDirection a, AxisDirection b) {
        const AxisDirection about{a.axis == b.axis ? (a.axis + 1) % 3 : 3 - a.axis - b.axis, true};
        return sides.difference(about, a, b) < kAlike;
      },
      [&](AxisDirection up) { return reasons_for_up(upright_evidence(sides, up)); });
}

/// Whether files with this up have a usual front: those with y or z up do, whatever their format.
bool has_usual_front(AxisDirection up) {
  return up.is_positive && up.axis != 0;
}

/// What habit adds to the log odds of the usual front, also where another up than the format's is given or
/// found.
double usual_front_log_odds(AxisDirection up, bool is_formats) {
  if (is_formats) {
    return front_model().convention_log_odds;
  }
  const double share = front_model().share;
  return has_usual_front(up) ? std::log(3.0 * share / (1.0 - share)) : 0.0;
}

/// The odds that views go by where the shape tells nothing: the usual front has the share of the files that
/// face so, the other sides share the rest as before.
std::vector<double> odds_by_convention(std::vector<double> odds, std::size_t usual) {
  const double share = front_model().share;
  const double others = 1.0 - odds[usual];
  for (std::size_t side = 0; side < odds.size(); ++side) {
    odds[side] = side == usual ? share : odds[side] * (1.0 - share) / others;
  }
  return odds;
}

/// The odds of all sides, the front first. Of sides that look alike the first has all: which of them is
/// called the front is all the same.
template <class Alike>
std::array<double, 4> odds_from(const Vec3& front, const Vec3& up,
                                const std::vector<AxisDirection>& candidates,
                                const std::vector<double>& odds, Alike&& alike) {
  std::array<double, 4> result{};
  std::array<AxisDirection, 4> sides;
  Vec3 side = front;
  for (std::size_t k = 0; k < sides.size(); ++k) {
    sides[k] = axis_of(side);
    const auto first = std::find_if(sides.begin(), sides.begin() + static_cast<std::ptrdiff_t>(k),
                                    [&](AxisDirection other) { return alike(other, sides[k]); });
    result[static_cast<std::size_t>(first - sides.begin())] += odds[place_of(sides[k], candidates)];
    side = up.cross(side);
  }
  return result;
}

/// Sets the front and the odds of all sides. \pre result.up
void find_front(const MeasuredSides& sides, const OrientationRequest& request,
                Orientation& result) {
  if (request.front) {
    result.front = known(*request.front, "given");
    return;
  }
  const Vec3& up_vector = result.up.direction;
  const AxisDirection up = axis_of(up_vector);
  const AxisDirection usual = axis_of(upright_frame(up_vector).front);
  const std::vector<AxisDirection> candidates = around(up);
  const std::size_t usual_index = place_of(usual, candidates);
  const bool is_formats = up == axis_of(request.usual_up);
  const Habit habit{.usual = usual_index,
                    .log_odds = usual_front_log_odds(up, is_formats),
                    .threshold = is_formats ? front_model().threshold : 0.0};
  std::vector<double> scores = front_scores(sides, up);
  const auto alike = [&](AxisDirection a, AxisDirection b) {
    return sides.difference(up, a, b) < kAlike;
  };
  result.front = choose(candidates, scores, habit, alike, [&](AxisDirection front) {
    return reasons_for_front(front_evidence(sides, up, front));
  });
  scores[usual_index] += habit.log_odds;
  std::vector<double> odds = odds_of(std::move(scores));
  if (has_usual_front(up) && result.front.likeliest_confidence < kTellsNothing) {
    odds = odds_by_convention(std::move(odds), usual_index);
  }
  result.front_odds = odds_from(result.front.direction, up_vector, candidates, odds, alike);
}

}  // namespace

OrientationEvidence::OrientationEvidence(const TriMesh& surface, const TextureFlow& flow)
    : sides_(std::make_shared<const MeasuredSides>(surface, flow)) {}

Orientation OrientationEvidence::find(const OrientationRequest& request) const {
  if (request.up && request.front && axis_of(*request.up).axis == axis_of(*request.front).axis) {
    throw InvalidInput("up and front are along the same axis");
  }
  Orientation result;
  result.up = find_up(*sides_, request);
  find_front(*sides_, request, result);
  return result;
}

std::vector<OrientationFeatures> OrientationEvidence::features() const {
  std::vector<OrientationFeatures> rows;
  for (const AxisDirection up : axis_directions()) {
    rows.push_back({.up = up.vector(), .values = upright_evidence(*sides_, up)});
  }
  for (const AxisDirection up : axis_directions()) {
    for (const AxisDirection front : around(up)) {
      const AxisDirection side{3 - up.axis - front.axis, true};
      rows.push_back({.up = up.vector(),
                      .front = front.vector(),
                      .values = front_evidence(*sides_, up, front),
                      .back_difference = sides_->difference(up, front, front.opposite()),
                      .side_difference = sides_->difference(up, front, side)});
    }
  }
  return rows;
}

}  // namespace vantage
