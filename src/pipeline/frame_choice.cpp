// SPDX-License-Identifier: MIT
#include <string>

#include <Eigen/Geometry>

#include "vantage/io/write.h"
#include "vantage/pipeline/find_views.h"

#include "pipeline/percent.h"
#include "pipeline/view_preparation.h"

namespace vantage {
namespace {

// A choice that is less sure than this gets a note. [ours]
constexpr double kUnsure = 0.5;

std::string name_of(const Vec3& direction) {
  return std::string(up_name(axis_nearest(direction)));
}

std::string by(const DirectionChoice& choice) {
  return choice.reasons.empty() ? "" : ", by " + choice.reasons;
}

/// What a user should know of a choice that is no plain case; empty if it is one.
/// \param word "up" or "front". \param usual the convention's direction.
/// \param is_weighed whether the best view weighs what else it may be. \param up flag that the usual
/// direction goes with, where up is not its format's.
std::string note_on(const DirectionChoice& choice, const std::string& word, const Vec3& usual,
                    bool is_weighed, const std::string& up = "") {
  const std::string chosen = name_of(choice.direction);
  if (choice.source == "shape") {
    return word + " is taken to be " + chosen + " (" + percent(choice.confidence) + " sure" +
           by(choice) + "), not " + name_of(usual) + ", the usual one " +
           (up.empty() ? "of its format" : "for this up") + "; " + up + "--" + word + " " +
           name_of(usual) + " overrules this";
  }
  if (choice.source == "format" && choice.confidence < kUnsure) {
    const bool favours_other = choice.likeliest.dot(choice.direction) < 0.5;
    return word + " is unsure: " + chosen + " is taken, the usual one of its format (" +
           percent(choice.confidence) + " sure)" +
           (favours_other ? ", the shape suggests " + name_of(choice.likeliest) + " (" +
                                percent(choice.likeliest_confidence) + ")"
                          : "") +
           (is_weighed ? "; the best view weighs all sides" : "") + "; --" + word + " sets it";
  }
  return {};
}

std::string summary_of(const DirectionChoice& choice, const std::string& word) {
  const std::string text = word + ": " + name_of(choice.direction);
  if (choice.source == "given") {
    return text + ", as given";
  }
  const bool is_likeliest = choice.likeliest.dot(choice.direction) > 0.5;
  const bool is_formats = choice.source == "format";
  return text + ", " + percent(choice.confidence) + " sure" +
         (!is_likeliest || (is_formats && choice.reasons.empty()) ? ", its format's" : by(choice));
}

}  // namespace

Eigen::Matrix3d stand_along_axes(Model& model, const ViewOptions& options) {
  if (options.up != UpAxis::Any) {
    return Eigen::Matrix3d::Identity();
  }
  Eigen::Matrix3d rotation = standing_rotation(model.mesh);
  if (rotation.isIdentity(0.0)) {
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
  FrameChoice choice;
  choice.orientation = evidence_of(shape).find(request);
  const DirectionChoice& up = choice.orientation.up;
  const DirectionChoice& front = choice.orientation.front;
  choice.frame = {axis_nearest(up.direction), axis_nearest(front.direction)};
  for (const std::string& note :
       {note_on(up, "up", usual_up, false),
        note_on(front, "front", up_vector(default_front(choice.frame.up)),
                objective_of(options) == Objective::People,
                up.source == "shape" ? "--up " + name_of(up.direction) + " " : "")}) {
    if (!note.empty()) {
      choice.notes.push_back(note);
    }
  }
  return choice;
}

std::string frame_summary(const FrameChoice& choice) {
  return summary_of(choice.orientation.up, "up") + "; " +
         summary_of(choice.orientation.front, "front");
}

}  // namespace vantage
