// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

#include "vantage/core/error.h"
#include "vantage/io/camera_files.h"

#include "core/degrees.h"
#include "core/dense_algebra.h"
#include "core/unit_direction.h"
#include "io/camera_axes.h"

namespace vantage {
namespace {

using Matrix3 = Eigen::Matrix3d;

constexpr double kLevel = 1e-9;  // a sine below this is rounding
// Moving the target to the middle of what is seen leaves a picture rolled by a degree or two; the
// element shows it upright. Beyond this, a camera that someone meant so, the model is turned instead.
constexpr double kMostRoll = 10.0 / kDegPerRad;

/// The angle between the camera's right and that of an upright camera; 0 where that has none.
double roll_against(const Matrix3& axes, const Vec3& up) {
  const Vec3 right = up.cross(axes.row(2).transpose());
  return right.norm() > kLevel
             ? std::atan2(right.cross(axes.row(0).transpose()).norm(), right.dot(axes.row(0)))
             : 0.0;
}

/// The turn that makes `up` y: the shortest, and half a turn about x for −y.
Matrix3 turn_to_y(const Vec3& up) {
  if (up.y() < -1.0 + kLevel) {
    return Vec3(1.0, -1.0, -1.0).asDiagonal();
  }
  return shortest_rotation(up, Vec3::UnitY()).toRotationMatrix();
}

/// Decimal places without an exponent, which the element's attributes are easiest to read with.
std::string decimal(double value, int places) {
  std::array<char, 512> text{};
  const auto end =
      std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed, places)
          .ptr;
  std::string result(text.data(), end);
  if (result.find('.') != std::string::npos) {
    result.erase(result.find_last_not_of('0') + 1);
    result.erase(result.find_last_not_of('.') + 1);
  }
  return result == "-0" ? "0" : result;
}

std::string degrees(double value) {
  constexpr int kPlaces = 4;
  return decimal(value, kPlaces) + "deg";
}

/// Roll, pitch and yaw of a rotation Ry(yaw) Rx(pitch) Rz(roll), as the element applies them.
std::string orientation_of(const Matrix3& turn) {
  const double sine = std::clamp(-turn(1, 2), -1.0, 1.0);
  double yaw = 0.0;
  double roll = 0.0;
  if (std::abs(sine) < 1.0 - kLevel) {
    yaw = std::atan2(turn(0, 2), turn(2, 2));
    roll = std::atan2(turn(1, 0), turn(1, 1));
  } else {
    yaw = std::atan2(-turn(2, 0), turn(0, 0));
  }
  return degrees(roll * kDegPerRad) + ' ' + degrees(std::asin(sine) * kDegPerRad) + ' ' +
         degrees(yaw * kDegPerRad);
}

/// A file's name as a relative address (RFC 3986).
std::string url_of(std::string_view name) {
  constexpr std::string_view kPlain = "-._~/!$&'()*+,;=@";
  constexpr std::string_view kDigits = "0123456789ABCDEF";
  std::string url;
  for (const char c : name) {
    const auto byte = static_cast<unsigned char>(c);
    if ((byte < 0x80 && std::isalnum(byte) != 0) || kPlain.find(c) != std::string_view::npos) {
      url += c;
    } else {
      url += {'%', kDigits[byte / 16], kDigits[byte % 16]};
    }
  }
  return url;
}

std::string html_text(std::string_view text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '"':
        result += "&quot;";
        break;
      case '<':
        result += "&lt;";
        break;
      default:
        result += c;
    }
  }
  return result;
}

}  // namespace

std::vector<std::pair<std::string, std::string>> model_viewer_attributes(const Camera& camera,
                                                                         const Vec3& up) {
  if (camera.projection != Projection::Perspective) {
    return {};
  }
  const Vec3 unit_up = unit_direction(up);
  const Matrix3 axes = camera_axes(camera).transpose();  // right, up and back as rows
  const Matrix3 turn = roll_against(axes, unit_up) < kMostRoll ? turn_to_y(unit_up) : axes;
  const Matrix3 turned = axes * turn.transpose();  // the camera's axes in the element's scene
  // Straight above or below, right says it: (cos, 0, −sin).
  double azimuth = turned.row(2).cross(Vec3::UnitY()).norm() > kLevel
                       ? std::atan2(turned(2, 0), turned(2, 2))
                       : std::atan2(-turned(0, 2), turned(0, 0));
  // No sign in front: tables take a text that begins with one for a formula.
  azimuth += azimuth < -kLevel ? 2.0 * std::numbers::pi : 0.0;
  const double polar = std::acos(std::clamp(turned(2, 1), -1.0, 1.0));
  const Vec3 target = turn * camera.target;
  const double distance = (camera.eye - camera.target).norm();
  constexpr double kDigits = 7.0;
  const int places =
      std::clamp(static_cast<int>(kDigits - std::floor(std::log10(distance))), 0, 300);
  const auto metres = [&](double value) { return decimal(value, places) + 'm'; };
  std::vector<std::pair<std::string, std::string>> attributes{
      {"camera-orbit",
       degrees(azimuth * kDegPerRad) + ' ' + degrees(polar * kDegPerRad) + ' ' + metres(distance)},
      {"camera-target", metres(target.x()) + ' ' + metres(target.y()) + ' ' + metres(target.z())},
      {"field-of-view", degrees(camera.fov_y_deg)},
      // The element keeps the eye and the angle between limits of its own: wider ones, so that
      // visitors may still come nearer.
      {"min-camera-orbit", "auto auto " + metres(0.25 * distance)},
      {"max-camera-orbit", "auto auto " + metres(2.0 * distance)},
      {"min-field-of-view", degrees(0.25 * camera.fov_y_deg)},
      {"max-field-of-view", degrees(std::max(30.0, camera.fov_y_deg))}};
  if (!turn.isIdentity(kLevel)) {
    attributes.emplace_back("orientation", orientation_of(turn));
  }
  return attributes;
}

std::string camera_model_viewer(const Camera& camera, const Vec3& up, std::string_view model) {
  std::string line = "<model-viewer src=\"" + html_text(url_of(model)) + '"';
  for (const auto& [name, value] : model_viewer_attributes(camera, up)) {
    for (const std::string_view part :
         {std::string_view(" "), std::string_view(name), std::string_view("=\""),
          std::string_view(value), std::string_view("\"")}) {
      line += part;
    }
  }
  return line + " camera-controls></model-viewer>\n";
}

}  // namespace vantage
