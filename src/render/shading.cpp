// SPDX-License-Identifier: MIT
#include "render/shading.h"

#include <algorithm>
#include <cmath>

namespace vantage {
namespace {

// All strengths and directions below are ours, chosen by eye on scans, CAD parts and low-poly
// models so that every side of a model stays readable. Directions are in the camera's axes.
const Vec3 kKeyDirection = Vec3(-0.50, 0.68, 0.70).normalized();
const Vec3 kFillDirection = Vec3(0.85, -0.20, 0.50).normalized();
const Vec3 kKeyColour(0.99, 0.96, 0.91);
const Vec3 kFillColour(0.13, 0.15, 0.18);
const Vec3 kSkyColour(0.25, 0.265, 0.29);
const Vec3 kGroundColour(0.08, 0.074, 0.068);
constexpr double kKeyWrap = 0.12;  ///< Soft light reaches this far (as a cosine) round a side.
constexpr double kFillWrap = 0.35;
constexpr double kKeyOcclusion = 0.55;  ///< How much of the key light comes from a wide source.
constexpr double kRim = 0.16;
constexpr double kSheen = 0.055;
constexpr int kSheenPower = 28;
constexpr double kCharcoal = 0.03;  ///< Albedo that black is shown with.
constexpr double kMostGain = 3.0;   ///< Dark hues are brought out so much; more shows noise.
constexpr double kShoulder = 0.72;  ///< Brighter channels are compressed into what is left to 1.
constexpr double kFaceOpacity = 0.56;
constexpr double kOutlineOpacity = 0.94;
constexpr double kVeil = 0.45;  ///< Share of its opacity that a surface keeps in front of a tube.
constexpr double kOutlinePower = 2.2;
const Vec3 kDrawingPaper(0.97, 0.975, 0.98);
const Vec3 kDrawingShade(0.30, 0.335, 0.39);
constexpr double kDrawingOcclusion = 0.45;
constexpr double kDarkestTint = 0.05;  ///< Albedos below this stay dark.
constexpr double kTubeOutline = 0.45;  ///< Cosine to the viewer below which tubes darken.

double wrapped(double cosine, double wrap) {
  return std::max(0.0, (cosine + wrap) / (1.0 + wrap));
}

double facing(const SurfacePoint& point) {
  return std::clamp(point.normal.dot(point.to_viewer), 0.0, 1.0);
}

Vec3 compress(const Vec3& colour) {
  const double brightest = colour.maxCoeff();
  if (brightest <= kShoulder) {
    return colour;
  }
  const double room = 1.0 - kShoulder;
  const double compressed = kShoulder + room * (1.0 - std::exp((kShoulder - brightest) / room));
  return colour * (compressed / brightest);
}

Vec3 diffuse_light(const SurfacePoint& point) {
  const Vec3& n = point.normal;
  const double key = wrapped(n.dot(kKeyDirection), kKeyWrap);
  const double fill = wrapped(n.dot(kFillDirection), kFillWrap);
  const double sky = 0.5 + 0.5 * n.y();
  const double key_openness = 1.0 - kKeyOcclusion * (1.0 - point.openness);
  return key * key_openness * kKeyColour +
         point.openness * (fill * kFillColour + sky * kSkyColour + (1.0 - sky) * kGroundColour);
}

/// A whole power > 0, by squares.
double power_of(double base, int power) {
  double result = 1.0;
  for (; power > 0; power /= 2) {
    result *= power % 2 != 0 ? base : 1.0;
    base *= base;
  }
  return result;
}

double sheen(const SurfacePoint& point, int power) {
  const Vec3 half = (kKeyDirection + point.to_viewer).normalized();
  return power_of(std::max(0.0, point.normal.dot(half)), power);
}

}  // namespace

Vec3 lifted_from_black(const Vec3& albedo) {
  const double own = albedo.maxCoeff();
  const double brightest = std::max(own, kCharcoal + 0.5 * own);
  const double gain = std::min(kMostGain, own > 0.0 ? brightest / own : kMostGain);
  return gain * albedo + Vec3::Constant(brightest - gain * own);
}

Vec3 shade_surface(const SurfacePoint& point) {
  const double edge = 1.0 - facing(point);
  const double rim = kRim * edge * edge * edge * (0.5 + 0.5 * point.normal.y()) * point.openness;
  const Vec3 lit = point.albedo.cwiseProduct(diffuse_light(point) + Vec3::Constant(rim));
  const double gloss = (kSheen * sheen(point, kSheenPower) + 0.25 * rim) * point.openness;
  return compress(lit + Vec3::Constant(gloss));
}

Vec3 shade_drawing(const SurfacePoint& point) {
  const double key = 0.5 + 0.5 * point.normal.dot(kKeyDirection);
  const double lit = key * (1.0 - kDrawingOcclusion * (1.0 - point.openness));
  const Vec3 wash = (1.0 - lit) * kDrawingShade + lit * kDrawingPaper;
  // Colours of a map tint the paper; what is not coloured is paper.
  return wash.cwiseProduct(point.albedo / std::max(point.albedo.maxCoeff(), kDarkestTint));
}

Vec3 shade_tube(const SurfacePoint& point) {
  const double outline = std::min(1.0, facing(point) / kTubeOutline);
  const double ink = 0.35 + 0.65 * outline;
  const Vec3 lit = ink * point.albedo.cwiseProduct(diffuse_light(point) + Vec3::Constant(0.35));
  return compress(lit + Vec3::Constant(0.18 * sheen(point, 2 * kSheenPower)));
}

double translucent_opacity(const SurfacePoint& point, bool before_tube) {
  const double edge = std::pow(1.0 - facing(point), kOutlinePower);
  const double opacity = kFaceOpacity + (kOutlineOpacity - kFaceOpacity) * edge;
  return before_tube ? kVeil * opacity : opacity;
}

}  // namespace vantage
