// SPDX-License-Identifier: MIT
#include "pipeline/frame_choice.h"

#include <algorithm>
#include <optional>
#include <string>

#include <Eigen/Geometry>

#include "vantage/io/write.h"

#include "pipeline/land.h"
#include "pipeline/percent.h"
#include "pipeline/view_preparation.h"

namespace vantage {
namespace {

// A choice that is less sure than this gets a note. [ours]
constexpr double kUnsure = 0.5;
// A choice by habit gets one where the shape alone is surer of another direction. [ours; docs/lab]
constexpr double kSpeaksAgainst = 0.8;
constexpr double kSpeaksAgainstUp = 2.0 / 3.0;
constexpr double kSpeaksForTheBack = 0.5;
// A view whose direction has so large a cosine with a side's shows that side, of less than minus that its
// back. [ours]
constexpr double kBeside = 0.1;
// Only where all candidates look alike a choice is surer than 98 %.
constexpr double kAllAlike = 0.99;

/// How texts speak of who has the convention.
struct HabitWords {
  const char* of = "of its format";
  const char* by = "by its format";
  const char* its = "its format's";
};

HabitWords words_for_up(UpHabit habit) {
  constexpr const char* kByMap = "by its map coordinates";
  constexpr const char* kByHeights = "as it is a height field";
  switch (habit) {
    case UpHabit::MapCoordinates:
      return {"of map coordinates", kByMap, kByMap};
    case UpHabit::HeightField:
      return {"of height fields", kByHeights, kByHeights};
    case UpHabit::Format:
      break;
  }
  return {};
}

std::string name_of(const Vec3& direction) {
  return std::string(up_name(axis_nearest(direction)));
}

std::string by(const DirectionChoice& choice) {
  return choice.reasons.empty() ? "" : ", by " + choice.reasons;
}

std::string sure(double confidence) {
  return percent(confidence) + " sure";
}

/// What the shape alone suggests, if it is so sure of that that it should be told.
std::optional<Vec3> told_by_shape(const DirectionChoice& choice, const std::string& word) {
  if (!choice.by_shape) {
    return {};
  }
  const bool is_opposite = choice.by_shape->dot(choice.direction) < -0.5;
  const double least = word == "up"  ? kSpeaksAgainstUp
                       : is_opposite ? kSpeaksForTheBack
                                     : kSpeaksAgainst;
  return choice.by_shape_confidence > least ? choice.by_shape : std::nullopt;
}

/// What a user should know of a choice that is no plain case; empty if it is one.
/// \param word "up" or "front". \param usual the convention's direction. \param of "of its format".
/// \param best what there is to say of the best view. \param flag that sets it.
std::string note_on(const DirectionChoice& choice, const std::string& word, const Vec3& usual,
                    const std::string& of, const std::string& best, const std::string& flag) {
  const std::string chosen = name_of(choice.direction);
  if (choice.source == "shape") {
    return word +
           (choice.confidence < kUnsure ? " is unsure: " + chosen + " is taken"
                                        : " is taken to be " + chosen) +
           " (" + sure(choice.confidence) + by(choice) + "), not " + name_of(usual) +
           ", the usual one " + of + best + "; " + flag + " " + name_of(usual) + " overrules this";
  }
  if (choice.source != "format") {
    return {};
  }
  const std::string taken =
      chosen + " is taken, the usual one " + of + " (" + sure(choice.confidence) + ")";
  if (choice.confidence < kUnsure) {
    const bool favours_other = choice.likeliest.dot(choice.direction) < 0.5;
    return word + " is unsure: " + taken +
           (favours_other ? ", the shape suggests " + name_of(choice.likeliest) + " (" +
                                percent(choice.likeliest_confidence) + ")"
                          : "") +
           best + "; " + flag + " sets it";
  }
  if (const std::optional<Vec3> told = told_by_shape(choice, word)) {
    return word + ": " + taken + ", but the shape alone suggests " + name_of(*told) + best + "; " +
           flag + " " + name_of(*told) + " takes it";
  }
  return {};
}

/// " (-z looks the same)"
std::string alike_text(const std::vector<Vec3>& alike) {
  std::string names;
  for (const Vec3& direction : alike) {
    names += (names.empty()                 ? ""
              : &direction == &alike.back() ? " and "
                                            : ", ") +
             name_of(direction);
  }
  return alike.empty() ? ""
                       : " (" + names + (alike.size() == 1 ? " looks" : " look") + " the same)";
}

std::string summary_of(const DirectionChoice& choice, const std::string& word,
                       const HabitWords& habit) {
  const std::string text = word + ": " + name_of(choice.direction);
  if (choice.source == "given") {
    return text + ", as given";
  }
  if (choice.confidence > kAllAlike) {
    return text + ", " + habit.its + (choice.alike.empty() ? "" : ": all sides look the same");
  }
  const bool is_likeliest = choice.likeliest.dot(choice.direction) > 0.5;
  if (!is_likeliest && choice.source == "format" && choice.confidence < kUnsure) {
    return text + alike_text(choice.alike) + " " + habit.by + ", unsure (" +
           (choice.by_shape ? "the shape alone: " + name_of(*choice.by_shape)
                            : "likelier: " + name_of(choice.likeliest)) +
           ")";
  }
  const bool is_by_habit = !is_likeliest || (choice.source == "format" && choice.reasons.empty());
  return text + alike_text(choice.alike) + ", " + sure(choice.confidence) +
         (is_by_habit ? std::string(", ") + habit.its : by(choice)) +
         (choice.by_shape ? " (the shape alone: " + name_of(*choice.by_shape) + ")" : "");
}

/// Whether a view shows the back of what has another front. \param eye as note_on_front() has it.
bool is_from_behind(const DirectionChoice& front, const Vec3& eye) {
  const bool looks_alike =
      std::any_of(front.alike.begin(), front.alike.end(),
                  [&](const Vec3& other) { return other.dot(front.direction) < -0.5; });
  return !looks_alike && eye.dot(front.direction) < -kBeside;
}

/// What there is to say of the best view: that it is from behind, or of a front that is unsure, that it weighs
/// all sides, and which one it shows. Of such a front nothing is said as if it were one.
std::string words_on_best_view(const Orientation& orientation, const ViewOptions& options,
                               const Vec3& eye) {
  const DirectionChoice& front = orientation.front;
  const bool is_behind = is_from_behind(front, eye);
  if (front.confidence >= kUnsure || front.source == "given" || options.best_view ||
      objective_of(options) != Objective::People) {
    return is_behind ? "; the best view is from behind" : "";
  }
  std::string weighs = "; the best view weighs all sides";
  if (!is_behind) {
    return weighs;
  }
  if (eye.dot(front.likeliest) > kBeside) {
    return weighs + ", and is from the side that the shape suggests";
  }
  // The odds begin at the front and go about up.
  const bool is_back_likelier = orientation.front_odds[2] > orientation.front_odds[0];
  return is_back_likelier
             ? weighs
             : weighs + ", and is from behind if the front is " + name_of(front.direction);
}

}  // namespace

Eigen::Matrix3d stand_along_axes(Model& model, const ViewOptions& options) {
  if (options.up != UpAxis::Any) {
    return Eigen::Matrix3d::Identity();
  }
  Eigen::Matrix3d rotation = standing_rotation(model.mesh);
  if (rotation.isIdentity(0.0)) {
    model.notes.emplace_back(
        "--up any turned nothing: no box suits the faces and mirror planes clearly better than the "
        "axes do; --up with one of them says which is up");
    return rotation;
  }
  for (Vec3& p : model.mesh.positions) {
    p = rotation * p;
  }
  model.turn = rotation * model.turn;
  const Eigen::Quaterniond q(rotation);
  std::string text;
  for (const double part : {q.x(), q.y(), q.z(), q.w()}) {
    text += " " + number_text(std::round(part * 1e6) / 1e6);
  }
  model.notes.push_back("turned to stand along the axes, by the quaternion" + text +
                        " (x y z w); directions and cameras are of the turned model");
  return rotation;
}

FrameChoice choose_frame(const Model& model, const ShapeAnalysis& shape,
                         const ViewOptions& options) {
  const Vec3 usual_up = up_vector(default_up(model));
  const bool is_stated =
      model.format == ModelFormat::Gltf || model.format == ModelFormat::Glb || model.up_is_stated;
  OrientationRequest request{.usual_up = usual_up,
                             .usual_up_is_certain = is_stated && options.up != UpAxis::Any};
  if (options.up && options.up != UpAxis::Any) {
    request.up = up_vector(*options.up);
  }
  if (options.front) {
    request.front = up_vector(*options.front);
  }
  const std::optional<LandUp> land = up_of_land(model);
  FrameChoice choice{.up_habit = land ? land->habit : UpHabit::Format};
  choice.orientation = evidence_of(shape).find(request);
  const DirectionChoice& up = choice.orientation.up;
  choice.frame = {axis_nearest(up.direction), axis_nearest(choice.orientation.front.direction)};
  const HabitWords habit = words_for_up(choice.up_habit);
  for (const std::string& note :
       {note_on(up, "up", usual_up, habit.of, "", "--up"), note_on_front(choice, options)}) {
    if (!note.empty()) {
      choice.notes.push_back(note);
    }
  }
  return choice;
}

std::string note_on_front(const FrameChoice& choice, const ViewOptions& options, const Vec3& eye) {
  const DirectionChoice& up = choice.orientation.up;
  const DirectionChoice& front = choice.orientation.front;
  const std::string name = name_of(front.direction);
  const bool is_behind = is_from_behind(front, eye);
  std::string note = note_on(
      front, "front", up_vector(default_front(choice.frame.up)),
      up.source == "format" && choice.up_habit == UpHabit::Format ? HabitWords{}.of : "for this up",
      words_on_best_view(choice.orientation, options, eye),
      up.source == "shape" ? "--up " + name_of(up.direction) + " --front" : "--front");
  if (!note.empty() || !is_behind) {
    return note;
  }
  return front.source == "given"
             ? "the best view is from behind the front given: more is to be seen there"
             : "the best view is from behind, if the front is " + name + " (" +
                   sure(front.confidence) + "); --front " + name + " shows that side";
}

std::string frame_summary(const FrameChoice& choice) {
  return summary_of(choice.orientation.up, "up", words_for_up(choice.up_habit)) + "; " +
         summary_of(choice.orientation.front, "front", {});
}

}  // namespace vantage
