// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "vantage/core/error.h"
#include "vantage/view/measure.h"

#include "core/shannon.h"
#include "view/view_likelihood.h"

namespace vantage {
namespace {

using Value = double (*)(const MeasuredModel&, const SightTable&);

// Bins of Gaussian curvature over [−2π, 2π]. [Page 2003]
constexpr std::size_t kCurvatureBins = 256;
// Flat is on the border of two bins, and rounding must not choose between them: far more than
// rounding of angles and far less than a bin, radians. [ours]
constexpr double kFlat = 1e-9;
/// The square around the disc over the disc: the picture that `plemenos` divides by.
constexpr double kSquareOverDisc = 4.0 / std::numbers::pi;

double kssm(const MeasuredModel& model, const SightTable& sight) {
  return model.given.weight == Weight::Vertex ? visible_sum(model.given.kssm, sight.vertices)
                                              : sight.kssm_sum;
}

double mesh_saliency(const MeasuredModel& model, const SightTable& sight) {
  return model.given.weight == Weight::Vertex ? visible_sum(model.saliency, sight.vertices)
                                              : sight.saliency_sum;
}

double visible_triangles(const MeasuredModel& /*model*/, const SightTable& sight) {
  return static_cast<double>(sight.faces.size());
}

double projected_area(const MeasuredModel& /*model*/, const SightTable& sight) {
  return sight.projected_area / sight.disc_area;
}

double plemenos(const MeasuredModel& model, const SightTable& sight) {
  return visible_triangles(model, sight) / static_cast<double>(model.face_count) +
         projected_area(model, sight) / kSquareOverDisc;
}

double visibility_ratio(const MeasuredModel& model, const SightTable& sight) {
  double seen = 0.0;
  for (const FaceArea& a : sight.faces) {
    seen += model.face_areas[a.face];
  }
  return std::min(1.0, seen / model.surface_area);
}

double viewpoint_entropy(const MeasuredModel& /*model*/, const SightTable& sight) {
  return std::max(0.0, log_2(sight.projected_area) - sight.area_logs / sight.projected_area);
}

/// The background is one more face: −Σ p log p = log A − Σ a log a / A over both.
double viewpoint_entropy_2001(const MeasuredModel& /*model*/, const SightTable& sight) {
  const double square = kSquareOverDisc * sight.disc_area;
  const double picture = std::max(square, sight.projected_area);
  const double logs = sight.area_logs + x_log_x(picture - sight.projected_area);
  return std::max(0.0, log_2(picture) - logs / picture);
}

double kullback_leibler(const MeasuredModel& model, const SightTable& sight) {
  // Σ p log (p A_t / A_z), with Σ p log p = −H.
  double logs = 0.0;
  for (const FaceArea& a : sight.faces) {
    logs += a.area * model.log_face_areas[a.face];
  }
  return std::max(0.0, log_2(model.surface_area) - viewpoint_entropy(model, sight) -
                           logs / sight.projected_area);
}

double instability_of(const MeasuredModel& model, const SightTable& sight) {
  if (sight.set_index != SightTable::kOffSet) {
    const std::uint32_t first = model.next_views.offsets[sight.set_index];
    const std::size_t count = model.next_views[sight.set_index].size();
    return mean_divergence(std::span(model.divergences).subspan(first, count));
  }
  std::vector<std::span<const FaceArea>> around;
  around.reserve(sight.neighbours.size());
  for (const std::uint32_t view : sight.neighbours) {
    around.emplace_back(model.set_views[view]);
  }
  return instability(sight.faces, around);
}

/// Trace of the second moment across the line of sight, in squared radii of the sphere.
double principal_axis(const MeasuredModel& model, const SightTable& sight) {
  const double radius = 0.5 * model.given.camera.sphere.diameter;
  const double along = sight.towards.dot(model.spread * sight.towards);
  return std::max(0.0, model.spread.trace() - along) / (radius * radius);
}

double curvature_entropy(const MeasuredModel& model, const SightTable& sight) {
  std::array<double, kCurvatureBins> bins{};
  for (std::size_t v = 0; v < sight.vertices.size(); ++v) {
    if (sight.vertices[v] != 0) {
      const double place = 0.5 + (model.angle_deficits[v] + kFlat) / (4.0 * std::numbers::pi);
      const double bin = std::clamp(place, 0.0, 1.0) * kCurvatureBins;
      bins[std::min(kCurvatureBins - 1, static_cast<std::size_t>(bin))] += 1.0;
    }
  }
  return histogram_entropy(bins);
}

double depth_distribution(const MeasuredModel& /*model*/, const SightTable& sight) {
  double squares = 0.0;
  double total = 0.0;
  for (const double bin : sight.depths) {
    squares += bin * bin;
    total += bin;
  }
  return total > 0.0 ? std::max(0.0, 1.0 - squares / (total * total)) : 0.0;
}

constexpr MeasureNeeds kVertices{.vertices = true};
constexpr MeasureNeeds kFaces{.faces = true};
constexpr MeasureNeeds kOutline{.outline = true};
constexpr MeasureNeeds kChannel{.faces = true, .channel = true};
constexpr MeasureNeeds kSkeleton{.vertices = true, .skeleton = true};

/// \param needs what the measure looks at.
Measure more(const char* name, const char* meaning, const char* source, const MeasureNeeds& needs,
             Value value) {
  return {name, "", meaning, source, Better::More, needs, value};
}

Measure less(const char* name, const char* meaning, const char* source, const MeasureNeeds& needs,
             Value value) {
  return {name, "", meaning, source, Better::Less, needs, value};
}

void add_surface_measures(std::vector<Measure>& all) {
  all.push_back(more("kssm", "sum of the kinematic significance of what is seen",
                     "the method of this program", {.vertices = true, .kssm = true}, kssm));
  all.push_back(more("mesh-saliency", "sum of the mesh saliency of what is seen",
                     "Lee, Varshney, Jacobs 2005", {.vertices = true, .saliency = true},
                     mesh_saliency));
  all.push_back(more("visible-triangles", "number of faces seen", "Plemenos, Benayada 1996", kFaces,
                     visible_triangles));
  all.back().is_count = true;
  all.push_back(more("projected-area", "area of the picture over that of the enclosing sphere's",
                     "Plemenos, Benayada 1996", kFaces, projected_area));
  all.push_back(
      more("skeleton-visibility", "share of the skeleton's length that is shown", "ours", kSkeleton,
           [](const MeasuredModel&, const SightTable& sight) { return sight.skeleton.share; }));
  all.push_back(
      more("skeleton-limbs", "branches of the skeleton that are shown", "ours", kSkeleton,
           [](const MeasuredModel&, const SightTable& sight) { return sight.skeleton.limbs; }));
  all.back().is_count = true;
  all.push_back(more("principal-axis", "spread of the surface across the line of sight",
                     "after Weinshall, Werman 1997", kVertices, principal_axis));
  all.push_back(more("plemenos", "share of faces seen plus share of the picture covered",
                     "Plemenos, Benayada 1996", kFaces, plemenos));
  all.push_back(more("visibility-ratio", "surface of the faces seen over the whole surface",
                     "Plemenos, Benayada 1996; Secord et al. 2011", kFaces, visibility_ratio));
}

void add_channel_measures(std::vector<Measure>& all) {
  all.push_back(more("viewpoint-entropy", "entropy of the faces' projected areas, bits",
                     "Vázquez et al. 2001, without background", kFaces, viewpoint_entropy));
  all.back().alias = "surface-area-entropy";
  all.push_back(more("viewpoint-entropy-2001", "the same with the background as one more face",
                     "Vázquez et al. 2001", kFaces, viewpoint_entropy_2001));
  all.push_back(less("kullback-leibler", "divergence of projected from true areas, bits",
                     "Sbert et al. 2005", kFaces, kullback_leibler));
  all.push_back(less("vmi", "viewpoint mutual information, bits", "Feixas, Sbert, González 2009",
                     kChannel, [](const MeasuredModel&, const SightTable& sight) {
                       return std::max(0.0, sight.channel.vmi);
                     }));
  all.back().alias = "i1";
  all.push_back(less("i2",
                     "specific information: entropy of all faces less that of the view's, bits",
                     "DeWeese, Meister 1999; Bonaventura et al. 2011", kChannel,
                     [](const MeasuredModel& model, const SightTable& sight) {
                       return model.terms.entropy_of_faces - viewpoint_entropy(model, sight);
                     }));
  all.push_back(
      more("i3", "stimulus-specific information: mean of what its faces tell of views, bits",
           "Butts 2003; Bonaventura et al. 2011", kChannel,
           [](const MeasuredModel&, const SightTable& sight) { return sight.channel.i3; }));
  const MeasureNeeds next{.faces = true, .neighbours = true};
  all.push_back(less("instability", "how much the picture changes to the neighbouring views, bits",
                     "Feixas, Sbert, González 2009", next, instability_of));
  all.push_back(more("view-likelihood", "share of the view sphere around it that looks alike",
                     "after Weinshall, Werman 1997", next, view_likelihood));
  all.back().estimate = estimated_view_likelihood;
  all.push_back(more(
      "pmi-saliency", "saliency of faces by how their visibility differs from theirs around",
      "Feixas, Sbert, González 2009", kChannel,
      [](const MeasuredModel&, const SightTable& sight) { return sight.channel.pmi_saliency; }));
  all.push_back(less("evmi", "mutual information with salient faces weighted, bits",
                     "Feixas, Sbert, González 2009", kChannel,
                     [](const MeasuredModel&, const SightTable& sight) {
                       return std::max(0.0, sight.channel.evmi);
                     }));
}

void add_picture_measures(std::vector<Measure>& all) {
  all.push_back(more("silhouette-length", "length of the outline over the sphere's diameter",
                     "Polonsky et al. 2005", kOutline,
                     [](const MeasuredModel&, const SightTable& s) { return s.outline.length; }));
  all.push_back(more("silhouette-entropy", "entropy of the outline's turning angles, bits",
                     "Page et al. 2003", kOutline, [](const MeasuredModel&, const SightTable& s) {
                       return s.outline.turning_entropy;
                     }));
  all.push_back(
      more("silhouette-curvature", "mean turning of the outline a step, radians",
           "Vieira et al. 2009; Secord et al. 2011", kOutline,
           [](const MeasuredModel&, const SightTable& s) { return s.outline.curvature; }));
  all.push_back(more("silhouette-curvature-extrema", "mean of the turning's square",
                     "Secord et al. 2011", kOutline, [](const MeasuredModel&, const SightTable& s) {
                       return s.outline.curvature_extrema;
                     }));
  all.push_back(more("curvature-entropy",
                     "entropy of the Gaussian curvature of the vertices seen, bits",
                     "Page et al. 2003; Polonsky et al. 2005", kVertices, curvature_entropy));
  all.push_back(more("max-depth", "greatest depth seen over the sphere's diameter",
                     "Stoev, Straßer 2002", {.vertices = true, .faces = true},
                     [](const MeasuredModel&, const SightTable& s) { return s.deepest; }));
  all.push_back(more("depth-distribution", "evenness of the depths seen", "Secord et al. 2011",
                     kFaces, depth_distribution));
}

}  // namespace

double Measure::worst() const {
  return better == Better::More ? 0.0 : std::numeric_limits<double>::infinity();
}

std::string_view Measure::cost() const {
  const std::pair<bool, std::string_view> dearest_first[] = {
      {is_of_set(), "set of views"},    {needs.kssm, "kssm map"},   {needs.skeleton, "skeleton"},
      {needs.saliency, "saliency map"}, {needs.outline, "outline"}, {needs.faces, "faces"},
      {needs.vertices, "vertices"},
  };
  for (const auto& [is_needed, thing] : dearest_first) {
    if (is_needed) {
      return thing;
    }
  }
  return "surface";
}

const std::vector<Measure>& builtin_measures() {
  static const std::vector<Measure> kAll = [] {
    std::vector<Measure> all;
    add_surface_measures(all);
    add_channel_measures(all);
    add_picture_measures(all);
    return all;
  }();
  return kAll;
}

const Measure& find_measure(std::string_view name) {
  std::string names;
  for (const Measure& measure : builtin_measures()) {
    if (measure.name == name || (!measure.alias.empty() && measure.alias == name)) {
      return measure;
    }
    names += (names.empty() ? "" : ", ") + measure.name;
  }
  throw InvalidInput("there is no method '" + std::string(name) + "'; there are " + names);
}

}  // namespace vantage
