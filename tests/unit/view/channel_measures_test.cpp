// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <numeric>

#include <gtest/gtest.h>

#include "vantage/core/error.h"
#include "vantage/view/channel.h"

#include "core/random.h"
#include "support/shapes.h"

namespace vantage {
namespace {

// Sums of a few thousand terms in double over areas stored as float, both sides from the same
// areas.
constexpr double kBits = 1e-9;

/// Every view sees about half of the faces, at random areas; face 0 is never seen and the last view
/// sees nothing.
ViewChannel random_channel(std::size_t faces, std::size_t views, std::uint64_t seed = 1) {
  Pcg32 random(seed);
  ViewChannel channel{.face_count = faces, .views = std::vector<std::vector<FaceArea>>(views)};
  for (std::size_t v = 0; v + 1 < views; ++v) {
    for (std::uint32_t f = 1; f < faces; ++f) {
      const double area = random.uniform();
      if (random.uniform() < 0.5) {
        channel.views[v].push_back({f, static_cast<float>(0.01 + area)});
      }
    }
  }
  return channel;
}

struct Case {
  TriMesh mesh = test::sphere(2);
  ViewChannel channel = random_channel(mesh.triangles.size(), 20);
  ChannelTerms terms = channel_terms(channel, mesh);
  double total = std::accumulate(terms.area_of_view.begin(), terms.area_of_view.end(), 0.0);

  [[nodiscard]] ChannelMeasures of(std::size_t view) const {
    return channel_measures(channel.views[view], terms);
  }
};

TEST(ChannelMeasures, TheMeansOfVmiAndI3AreTheMutualInformation) {
  const Case c;
  double vmi = 0.0;
  double i3 = 0.0;
  for (std::size_t v = 0; v + 1 < c.channel.views.size(); ++v) {
    const double p = c.terms.area_of_view[v] / c.total;
    vmi += p * c.of(v).vmi;
    i3 += p * c.of(v).i3;
  }
  EXPECT_NEAR(vmi, c.terms.mutual_information, kBits);
  EXPECT_NEAR(i3, c.terms.mutual_information, kBits);
  EXPECT_GT(c.terms.mutual_information, 0.1);
}

TEST(ChannelMeasures, StayInTheirRanges) {
  const Case c;
  for (std::size_t v = 0; v + 1 < c.channel.views.size(); ++v) {
    const ChannelMeasures m = c.of(v);
    EXPECT_GT(m.vmi, 0.0);
    EXPECT_GT(m.evmi, 0.0);
    EXPECT_GT(m.pmi_saliency, 0.0);
    const auto& i2 = c.terms.i2_of_face;
    EXPECT_GE(m.i3, *std::min_element(i2.begin() + 1, i2.end()));  // face 0 is never seen
    EXPECT_LE(m.i3, *std::max_element(i2.begin(), i2.end()));
  }
}

TEST(ChannelMeasures, OfAViewThatSeesNothingAreTheWorst) {
  const Case c;
  const ChannelMeasures m = c.of(c.channel.views.size() - 1);
  EXPECT_EQ(m.i3, 0.0);
  EXPECT_EQ(m.pmi_saliency, 0.0);
  for (const double bad : {m.vmi, m.evmi}) {
    EXPECT_TRUE(std::isinf(bad) && bad > 0.0);
  }
}

TEST(ChannelMeasures, DoNotDependOnTheUnitOfArea) {
  const Case c;
  ViewChannel scaled = c.channel;
  for (auto& view : scaled.views) {
    for (FaceArea& a : view) {
      a.area *= 1024.0F;  // exact
    }
  }
  const ChannelTerms terms = channel_terms(scaled, c.mesh);
  const ChannelMeasures a = c.of(3);
  const ChannelMeasures b = channel_measures(scaled.views[3], terms);
  EXPECT_NEAR(a.i3, b.i3, kBits);
  EXPECT_NEAR(a.vmi, b.vmi, kBits);
  EXPECT_NEAR(a.evmi, b.evmi, kBits);
  EXPECT_NEAR(a.pmi_saliency, b.pmi_saliency, kBits);
  EXPECT_NEAR(terms.mutual_information, c.terms.mutual_information, kBits);
}

TEST(ChannelTerms, SplittingAFaceNeverLowersTheMutualInformation) {
  const TriMesh mesh = test::sphere(1);
  const std::size_t faces = mesh.triangles.size();
  const ViewChannel whole = random_channel(faces, 12, 5);
  // Face 7 becomes itself and a new last face, in shares that differ from view to view.
  TriMesh split_mesh = mesh;
  split_mesh.triangles.push_back(mesh.triangles[7]);
  ViewChannel split = whole;
  split.face_count = faces + 1;
  Pcg32 random(9);
  for (auto& view : split.views) {
    const auto at =
        std::find_if(view.begin(), view.end(), [](const FaceArea& a) { return a.face == 7; });
    if (at != view.end()) {
      const auto part = static_cast<float>(random.uniform()) * at->area;
      at->area -= part;
      view.push_back({static_cast<std::uint32_t>(faces), part});
    }
  }
  EXPECT_GT(channel_terms(split, split_mesh).mutual_information,
            channel_terms(whole, mesh).mutual_information);
}

/// JS(w p + w' p') by its definition, H(mixture) − mixture of the H.
double direct_divergence(const std::vector<double>& a, const std::vector<double>& b) {
  const double a_sum = std::accumulate(a.begin(), a.end(), 0.0);
  const double b_sum = std::accumulate(b.begin(), b.end(), 0.0);
  const auto entropy = [](const std::vector<double>& p) {
    double h = 0.0;
    for (const double x : p) {
      h -= x > 0.0 ? x * std::log2(x) : 0.0;
    }
    return h;
  };
  std::vector<double> pa;
  std::vector<double> pb;
  std::vector<double> mixed;
  for (std::size_t i = 0; i < a.size(); ++i) {
    pa.push_back(a[i] / a_sum);
    pb.push_back(b[i] / b_sum);
    mixed.push_back((a[i] + b[i]) / (a_sum + b_sum));
  }
  return entropy(mixed) - (a_sum * entropy(pa) + b_sum * entropy(pb)) / (a_sum + b_sum);
}

TEST(ChannelTerms, SaliencyIsTheMeanDivergenceFromTheFacesAround) {
  const Case c;
  const std::size_t views = c.channel.views.size();
  std::vector<std::vector<double>> by_face(c.mesh.triangles.size(),
                                           std::vector<double>(views, 0.0));
  for (std::size_t v = 0; v < views; ++v) {
    for (const FaceArea& a : c.channel.views[v]) {
      by_face[a.face][v] = a.area;
    }
  }
  for (const std::size_t z : {std::size_t{5}, std::size_t{100}, std::size_t{319}}) {
    double sum = 0.0;
    int around = 0;
    for (std::size_t other = 0; other < by_face.size(); ++other) {
      const auto& a = c.mesh.triangles[z];
      const auto& b = c.mesh.triangles[other];
      const bool touches = std::any_of(a.begin(), a.end(), [&](std::uint32_t v) {
        return std::find(b.begin(), b.end(), v) != b.end();
      });
      if (touches && other != z) {
        // Face 0 is never seen: it weighs nothing.
        sum += other == 0 ? 0.0 : direct_divergence(by_face[z], by_face[other]);
        ++around;
      }
    }
    EXPECT_NEAR(c.terms.saliency_of_face[z], sum / around, kBits);
  }
  EXPECT_EQ(c.terms.saliency_of_face[0], 0.0);
}

TEST(ChannelTerms, RefuseAnotherMesh) {
  EXPECT_THROW(channel_terms(random_channel(7, 3), test::sphere(1)), InvalidInput);
}

TEST(ChannelTerms, RefuseAMalformedChannel) {
  const TriMesh mesh = test::sphere(0);
  const auto last = static_cast<std::uint32_t>(mesh.triangles.size());
  EXPECT_THROW(channel_terms({last, {{{last, 1.0F}}}}, mesh), InvalidInput);  // no such face
  EXPECT_THROW(channel_terms({last, {{{1, 1.0F}, {0, 1.0F}}}}, mesh), InvalidInput);
  EXPECT_THROW(channel_terms({last, {{{0, 0.0F}}}}, mesh), InvalidInput);  // no area
}

TEST(Instability, IsZeroAmongEqualViewsAndOneWhereNothingIsShared) {
  const std::vector<FaceArea> a{{0, 1.0F}, {1, 2.0F}};
  const std::vector<FaceArea> b{{2, 1.5F}, {3, 1.5F}};
  const std::span<const FaceArea> same[] = {a, a};
  const std::span<const FaceArea> other[] = {b};
  EXPECT_NEAR(instability(a, same), 0.0, kBits);
  EXPECT_NEAR(instability(a, other), 1.0, kBits);
  EXPECT_TRUE(std::isinf(instability({}, other)));
}

TEST(Instability, IsTheDivergenceByItsDefinition) {
  const std::vector<FaceArea> a{{0, 1.0F}, {1, 2.0F}, {4, 0.5F}};
  const std::vector<FaceArea> b{{1, 1.5F}, {3, 1.5F}, {4, 3.0F}};
  EXPECT_NEAR(view_divergence(a, b),
              direct_divergence({1.0, 2.0, 0.0, 0.0, 0.5}, {0.0, 1.5, 0.0, 1.5, 3.0}), kBits);
}

TEST(SaliencyOnVertices, IsTheAreaWeightedMeanOfTheFacesThere) {
  const TriMesh mesh{
      .positions = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, -3, 0), Vec3(9, 9, 9)},
      .triangles = {{0, 1, 2}, {1, 0, 3}}};
  const std::vector<double> on_vertices = saliency_on_vertices(mesh, std::vector<double>{1.0, 0.2});
  // Areas 1/2 and 3/2.
  EXPECT_NEAR(on_vertices[0], (0.5 * 1.0 + 1.5 * 0.2) / 2.0, 1e-15);
  EXPECT_NEAR(on_vertices[2], 1.0, 1e-15);
  EXPECT_NEAR(on_vertices[3], 0.2, 1e-15);
  EXPECT_EQ(on_vertices[4], 0.0);
}

}  // namespace
}  // namespace vantage
