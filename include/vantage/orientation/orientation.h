// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "vantage/core/vec3.h"
#include "vantage/mesh/appearance.h"
#include "vantage/mesh/tri_mesh.h"

/// \file
/// Which axis of a model is up and which side is its front, from its shape: features after Fu,
/// Cohen-Or, Dror, Sheffer, "Upright orientation of man-made objects", SIGGRAPH 2008 (static
/// stability, symmetry, parallelism), and more, combined by a fitted model. docs/orientation.md.

namespace vantage {

/// What is known before the shape is looked at. All directions are ± coordinate axes.
struct OrientationRequest {
  std::optional<Vec3> up{};          ///< Given: not sought.
  std::optional<Vec3> front{};       ///< Given: not sought; at right angles to `up` if both are.
  Vec3 usual_up = Vec3::UnitY();     ///< What the file's format makes one expect.
  bool usual_up_is_certain = false;  ///< The format's specification says so, as glTF's does.
};

/// One direction of the model's own frame.
struct DirectionChoice {
  Vec3 direction = Vec3::UnitY();  ///< As chosen, ± a coordinate axis.
  /// "given", "format" (its convention), or "shape" (the shape speaks against the convention).
  std::string source = "given";
  /// Calibrated probability that `direction` is right, or looks just like what is right; in [0, 1].
  /// 1 if it was given or is certain, or all candidates look alike; else 0.98 at most, as the fit is
  /// no surer than that on models left out of it.
  double confidence = 1.0;
  Vec3 likeliest = Vec3::UnitY();     ///< What the shape and the convention together favour.
  double likeliest_confidence = 1.0;  ///< Its probability, in [0, 1].
  /// "its flat base and a mirror plane": what of the shape speaks for the likeliest; empty where that
  /// is likeliest by the convention, not by the shape alone.
  std::string reasons{};
  /// What the shape alone favours, if that is another than `direction`.
  std::optional<Vec3> by_shape{};
  double by_shape_confidence = 0.0;  ///< Its probability if there were no convention.
  /// Other candidates that look just like `direction`: their probabilities are in `confidence`.
  std::vector<Vec3> alike{};
};

/// A model's own frame.
struct Orientation {
  DirectionChoice up{};     ///< Against gravity.
  DirectionChoice front{};  ///< Toward a viewer in front; at right angles to up.
  /// What views go by: probabilities that the front is front.direction, up × that, its opposite, or the
  /// last side. Of sides that look alike the first has those of all. Where the shape makes none likelier
  /// than one half, the usual front has the share of the files that face so.
  std::array<double, 4> front_odds{1.0, 0.0, 0.0, 0.0};
};

/// The rotation that takes a surface to the axes of the box that suits it best: faces along its sides,
/// mirror planes across them, little volume. Considered are boxes with an axis across a mirror plane, across
/// a large plane part or along a principal axis, and a side on an edge of the convex hull of the
/// outline seen along that axis: what it can stand on. Of the 24 ways to lay such a box along the
/// axes it is the smallest turn; identity unless another box suits the surface clearly better.
/// \complexity O(100 (|V| + |F|)).
Eigen::Matrix3d standing_rotation(const TriMesh& surface);

/// How the pictures on a surface lie: wood, labels and photographs are upright. All areas are shares
/// of the surface's; all is 0 without coordinates on textures.
struct TextureFlow {
  /// Of faces that look to one side of the box, by the fourth power of the cosine.
  struct Side {
    double area = 0.0;          ///< With a picture.
    double texels = 0.0;        ///< Area in pictures, share of all.
    Vec3 up = Vec3::Zero();     ///< Sum over the area of the way the picture's top lies.
    Vec3 right = Vec3::Zero();  ///< The same of its right side.
  };

  std::array<Side, 6> side{};       ///< +x, −x, +y, −y, +z, −z.
  double share = 0.0;               ///< Area with a picture.
  Vec3 up = Vec3::Zero();           ///< Sum over the area of the way the picture's top lies.
  Vec3 right = Vec3::Zero();        ///< The same of its right side.
  Vec3 up_along = Vec3::Zero();     ///< Sum of that way's absolute parts along the axes.
  Vec3 right_along = Vec3::Zero();  ///< The same of its right side.

  /// Multiplies areas, and the areas in pictures.
  void scale(double by, double texels_by);
};

/// \param appearance its coordinates on textures, whose second one grows towards the picture's top;
/// materials are not looked at. \complexity O(|F|)
TextureFlow texture_flow(const TriMesh& mesh, const Appearance& appearance);

/// A number that speaks for or against a direction.
struct OrientationFeature {
  std::string_view name{};  ///< Lives as long as the program.
  double value = 0.0;
};

/// One direction's features.
struct OrientationFeatures {
  Vec3 up = Vec3::UnitY();      ///< The candidate for up.
  std::optional<Vec3> front{};  ///< If they speak of the front: the candidate, `up` being up.
  std::vector<OrientationFeature> values{};  ///< The same names for all of a kind.
  double back_difference = 0.0;  ///< Of the front: how unlike its back it is, in [0, 1].
  double side_difference = 0.0;  ///< Of the front: how unlike its sides it is, in [0, 1].
};

/// What a shape says about its orientation. Depends on neither its unit nor the order of vertices
/// and faces. Copies share it.
class OrientationEvidence {
 public:
  /// \complexity O(|F| + area over that of a cell), twice the box's longest side in 64 cells.
  /// \param flow how pictures lie on it.
  explicit OrientationEvidence(const TriMesh& surface, const TextureFlow& flow = {});

  /// Finds what is not given. A direction other than the convention's is taken only above the
  /// confidence stated in the table of the fitted model. \throw InvalidInput if the directions are
  /// not ± axes, or not at right angles.
  [[nodiscard]] Orientation find(const OrientationRequest& request) const;

  /// All candidates' features: 6 of up, 24 of the front.
  [[nodiscard]] std::vector<OrientationFeatures> features() const;

 private:
  std::shared_ptr<const struct MeasuredSides> sides_;
};

}  // namespace vantage
