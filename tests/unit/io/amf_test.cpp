// SPDX-License-Identifier: MIT
#include "io/amf.h"

#include <cmath>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "vantage/io/model.h"
#include "vantage/mesh/measures.h"
#include "vantage/pipeline/view_options.h"

#include "core/srgb.h"
#include "unit/io/error_text.h"
#include "unit/io/zip_archive.h"

namespace vantage::test {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::string vertex(const std::string& x, const std::string& y, const std::string& z,
                   const std::string& more = "") {
  return "<vertex><coordinates><x>" + x + "</x><y>" + y + "</y><z>" + z + "</z></coordinates>" +
         more + "</vertex>";
}

std::string triangle(int a, int b, int c, const std::string& more = "") {
  return "<triangle>" + more + "<v1>" + std::to_string(a) + "</v1><v2>" + std::to_string(b) +
         "</v2><v3>" + std::to_string(c) + "</v3></triangle>";
}

std::string colour(const std::string& r, const std::string& g, const std::string& b,
                   const std::string& more = "") {
  return "<color><r>" + r + "</r><g>" + g + "</g><b>" + b + "</b>" + more + "</color>";
}

const std::string kAmfCorners =
    vertex("0", "0", "0") + vertex("2", "0", "0") + vertex("0", "2", "0") + vertex("0", "0", "2");
const std::string kAmfSides =
    triangle(0, 2, 1) + triangle(0, 1, 3) + triangle(0, 3, 2) + triangle(1, 2, 3);

std::string mesh(const std::string& vertices, const std::string& volumes) {
  return "<mesh><vertices>" + vertices + "</vertices>" + volumes + "</mesh>";
}

std::string object(const std::string& id, const std::string& content) {
  return "<object id=\"" + id + "\">" + content + "</object>";
}

std::string volume(const std::string& content, const std::string& attributes = "") {
  return "<volume" + attributes + ">" + content + "</volume>";
}

/// A tetrahedron.
std::string solid(const std::string& id) {
  return object(id, mesh(kAmfCorners, volume(kAmfSides)));
}

std::string amf(const std::string& content, const std::string& attributes = "") {
  return R"(<?xml version="1.0"?><amf)" + attributes + ">" + content + "</amf>";
}

Model read_amf(const std::string& content) {
  return parse_model(amf(content), "a.amf", {}, {.appearance = true});
}

std::string amf_error(const std::string& content) {
  return error_text(amf(content), "a.amf");
}

std::uint32_t material_of(const Model& model, std::size_t face) {
  return model.appearance.material_of_triangle[face];
}

TEST(Amf, ReadsVerticesAndTrianglesInTheirOrder) {
  const Model model = read_amf(object(
      "0", R"(<metadata type="name"> one </metadata>)" + mesh(kAmfCorners, volume(kAmfSides))));
  EXPECT_EQ(model.format, ModelFormat::Amf);
  EXPECT_EQ(format_name(model), "amf");
  ASSERT_EQ(model.mesh.positions.size(), 4U);
  EXPECT_EQ(model.mesh.positions[2], Vec3(0.0, 2.0, 0.0));
  EXPECT_THAT(model.mesh.triangles[3], ElementsAre(1, 2, 3));
  EXPECT_DOUBLE_EQ(6.0 * signed_volume(model.mesh), 8.0);
  ASSERT_EQ(model.parts.size(), 1U);
  EXPECT_EQ(model.parts[0].name, "one");
  EXPECT_THAT(model.notes, IsEmpty());
  EXPECT_EQ(default_up(model), UpAxis::Z);
}

TEST(Amf, ReadsEveryVolumeOfAMesh) {
  const Model model = read_amf(object(
      "0", mesh(kAmfCorners, volume(triangle(0, 2, 1)) + volume(triangle(0, 1, 3)) + "<region>" +
                                 triangle(0, 3, 2) + "</region>" + volume(triangle(1, 2, 3)))));
  EXPECT_EQ(model.mesh.triangles.size(), 4U);
  EXPECT_DOUBLE_EQ(6.0 * signed_volume(model.mesh), 8.0);
}

TEST(Amf, WithoutColoursHasNone) {
  const Model model = read_amf(solid("0"));
  EXPECT_THAT(model.vertex_colours, IsEmpty());
  EXPECT_THAT(model.appearance.materials, IsEmpty());
}

TEST(Amf, TakesTheColourThatIsNearestToATriangle) {
  // Of the triangle, its vertices, the volume, the object, the material: which may stand behind what it colours.
  const std::string corners = vertex("0", "0", "0", colour("0", "0", "1")) +
                              vertex("2", "0", "0", colour("0", "0", "1")) +
                              vertex("0", "2", "0", colour("0", "0", "1")) + vertex("0", "0", "2");
  const Model model = read_amf(
      object("0",
             mesh(corners, volume(triangle(0, 2, 1) + triangle(0, 1, 3, colour("1", "0", "0"))) +
                               volume(colour("0", "0.5", "0", "<a>0.25</a>") + triangle(0, 3, 2) +
                                      triangle(0, 1, 2)) +
                               volume(triangle(1, 2, 3))) +
                 colour("0", "1", "1")) +
      object("1", mesh(kAmfCorners, volume(kAmfSides, " materialid=\"m\""))) +
      R"(<material id="m">)" + colour("1", "1", "0") + "</material>");
  EXPECT_EQ(material_of(model, 0), Appearance::kNone);  // of its vertices
  const std::vector<Material>& materials = model.appearance.materials;
  EXPECT_THAT(materials[material_of(model, 1)].colour, ElementsAre(1.0, 0.0, 0.0));
  const Material& of_volume = materials[material_of(model, 2)];
  EXPECT_THAT(of_volume.colour, ElementsAre(0.0, linear_of_encoded(0.5), 0.0));
  EXPECT_EQ(of_volume.opacity, 0.25);
  EXPECT_EQ(of_volume.alpha, AlphaMode::Blend);
  EXPECT_EQ(material_of(model, 3), Appearance::kNone);
  EXPECT_THAT(materials[material_of(model, 4)].colour, ElementsAre(0.0, 1.0, 1.0));
  EXPECT_THAT(materials[material_of(model, 5)].colour, ElementsAre(1.0, 1.0, 0.0));
  ASSERT_EQ(model.vertex_colours.size(), 8U);
  EXPECT_EQ(model.vertex_colours[1], (Rgb8{0, 0, 255}));
  EXPECT_EQ(model.vertex_colours[3], (Rgb8{255, 255, 255}));
  EXPECT_EQ(model.vertex_colours[7], (Rgb8{255, 255, 255}));
}

TEST(Amf, PutsInstancesWhereAConstellationSays) {
  // Turned around x first, then y, then z, and shifted; the object stands behind what shows it.
  const Model model = read_amf(
      R"(<constellation id="c"><instance objectid="1"><deltax>10</deltax><deltay>20</deltay>)"
      R"(<deltaz>30</deltaz><rx>90</rx><rz>90</rz></instance><instance objectid="1"/></constellation>)" +
      solid("1") + solid("2"));
  ASSERT_EQ(model.mesh.positions.size(), 12U);
  EXPECT_LT((model.mesh.positions[1] - Vec3(10.0, 22.0, 30.0)).norm(), 1e-12);
  EXPECT_LT((model.mesh.positions[2] - Vec3(10.0, 20.0, 32.0)).norm(), 1e-12);
  EXPECT_LT((model.mesh.positions[3] - Vec3(12.0, 20.0, 30.0)).norm(), 1e-12);
  EXPECT_EQ(model.mesh.positions[5], Vec3(2.0, 0.0, 0.0));
  EXPECT_DOUBLE_EQ(6.0 * signed_volume(model.mesh), 24.0);
}

TEST(Amf, ShowsConstellationsInEachOther) {
  const Model model = read_amf(
      solid("1") +
      R"(<constellation id="2"><instance objectid="1"><deltax>1</deltax></instance></constellation>)"
      R"(<constellation id="3"><instance objectid="2"><deltax>4</deltax></instance></constellation>)");
  ASSERT_EQ(model.mesh.positions.size(), 4U);
  EXPECT_EQ(model.mesh.positions[0], Vec3(5.0, 0.0, 0.0));
}

TEST(Amf, LeavesOutTexturesOfEitherForm) {
  // The older form has the names of a triangle's corners for places on a picture.
  const std::string old_map =
      R"(<map gtexid="2" btexid="3" rtexid="1"><u1>0</u1><u2>1</u2><u3>1</u3><v1>7</v1><v2>9</v2><v3>8</v3></map>)";
  const std::string map = R"(<texmap rtexid="1"><utex1>0</utex1></texmap>)";
  for (const std::string& places : {old_map, map}) {
    const Model model = read_amf(
        object("0", mesh(kAmfCorners, volume(triangle(0, 2, 1, places) + triangle(0, 1, 3)))) +
        R"(<texture id="1" width="1" height="1" depth="1" type="grayscale">/w==</texture>)");
    EXPECT_THAT(model.mesh.triangles[0], ElementsAre(0, 2, 1));
    EXPECT_THAT(model.notes,
                Contains(HasSubstr("textures, and colours that are formulas, left out")));
  }
  const Model formula =
      read_amf(object("0", colour("x/10", "0", "0") + mesh(kAmfCorners, volume(kAmfSides))));
  EXPECT_THAT(formula.notes,
              Contains(HasSubstr("textures, and colours that are formulas, left out")));
  EXPECT_THAT(formula.appearance.materials, IsEmpty());
}

TEST(Amf, NotesWhatItDoesNotBend) {
  const Model curved = read_amf(object(
      "0", mesh(kAmfCorners + "<edge><v1>0</v1><dx1>1</dx1><v2>1</v2></edge>", volume(kAmfSides))));
  EXPECT_EQ(curved.mesh.positions.size(), 4U);
  EXPECT_THAT(curved.notes, ElementsAre(HasSubstr("edges and normals left out")));
  const std::string instance =
      R"(<constellation id="2"><instance objectid="1"><scale>1</scale><scalex>)";
  const std::string end = "</scalex></instance></constellation>";
  EXPECT_THAT(read_amf(solid("1") + instance + "2" + end).notes,
              ElementsAre(HasSubstr("scales and mirrors of instances left out")));
  EXPECT_THAT(read_amf(solid("1") + instance + "1" + end).notes, IsEmpty());
}

TEST(Amf, NotesTheUnitAndKeepsCoordinates) {
  const Model model = parse_model(amf(solid("1"), " unit=\"inch\""), "a.amf");
  EXPECT_EQ(model.mesh.positions[1], Vec3(2.0, 0.0, 0.0));
  EXPECT_THAT(model.notes, ElementsAre(HasSubstr("the file's unit is the 'inch'")));
}

TEST(Amf, KeepsDigitsThatAFloatDoesNotHold) {
  EXPECT_FALSE(read_amf(solid("1")).double_precision);
  const std::string exact =
      vertex("0.12345678901234", "0", "0") + vertex("1", "0", "0") + vertex("0", "1", "0");
  const Model model = read_amf(object("1", mesh(exact, volume(triangle(0, 1, 2)))));
  EXPECT_TRUE(model.double_precision);
  EXPECT_EQ(model.mesh.positions[0].x(), 0.12345678901234);
}

TEST(Amf, CountsVerticesOfEachMeshAnew) {
  const Model model = read_amf(
      object("1", mesh(kAmfCorners, volume(kAmfSides)) + mesh(kAmfCorners, volume(kAmfSides))));
  EXPECT_THAT(model.mesh.triangles[4], ElementsAre(4, 6, 5));
}

TEST(Amf, PassesOverBlanksAndCommentsAroundNumbers) {
  const std::string spread = vertex("\n  0\r\n", "\t0 ", "<!-- of 0 -->0") +
                             vertex("1<!-- 2 -->.5", "0", "0") + vertex("0", "1", "0");
  const Model model = read_amf(object("1", mesh(spread, volume(triangle(0, 1, 2)))));
  EXPECT_EQ(model.mesh.positions[1].x(), 1.5);
}

TEST(Amf, IsReadAsUtf16) {
  const std::string text = amf(solid("1"));
  std::string wide = "\xFF\xFE";
  for (const char c : text.substr(text.find("<amf"))) {
    wide += {c, '\0'};
  }
  EXPECT_EQ(parse_model(wide, "a.amf").mesh.triangles.size(), 4U);
}

TEST(Amf, IsReadPacked) {
  const std::string packed =
      zip_archive({{"__MACOSX/._a", "x"}, {"Folder/A.AMF", amf(solid("1"))}, {"b.amf", "no XML"}});
  EXPECT_EQ(parse_model(packed, "a.amf").mesh.triangles.size(), 4U);
  EXPECT_THAT(error_text(zip_archive({{"a.txt", "x"}}), "a.amf"),
              HasSubstr("no file that is named .amf"));
}

TEST(Amf, IsFoundByItsFirstElement) {
  EXPECT_TRUE(is_amf("<amf>"));
  EXPECT_TRUE(is_amf("\xEF\xBB\xBF\n<?xml version=\"1.0\"?>\n<!-- <x> --><amf unit=\"inch\">"));
  for (const char* const other : {"", "<amf", "<amfx>", "<?xml", "<!-- <amf> ", "<x><amf>"}) {
    EXPECT_FALSE(is_amf(other)) << other;
  }
  const Model model = parse_model(amf(solid("1")), "a.stl");
  EXPECT_EQ(model.format, ModelFormat::Amf);
  EXPECT_THAT(model.notes, ElementsAre(HasSubstr("the name says .stl, but the bytes are amf")));
}

TEST(AmfError, SaysWhatIsWrongAndWhere) {
  EXPECT_THAT(amf_error(object("1", mesh("<vertex/>", ""))), HasSubstr("line 1: a vertex has not"));
  EXPECT_THAT(amf_error(object("1", mesh(vertex("1,5", "0", "0"), ""))), HasSubstr("line 1"));
  EXPECT_THAT(amf_error(object("1", mesh(vertex("1e99", "0", "0"), ""))), HasSubstr("beyond 1e60"));
  EXPECT_THAT(amf_error(object("1", mesh(kAmfCorners, volume(triangle(0, 1, 4))))),
              HasSubstr("a triangle's v3 names none of the 4 vertices before it"));
  EXPECT_THAT(amf_error(object("1", mesh(kAmfCorners, volume("<triangle><v1>0</v1></triangle>")))),
              HasSubstr("a triangle's v2"));
  EXPECT_THAT(amf_error(solid("1") + solid("1")), HasSubstr("two objects have the id '1'"));
  EXPECT_THAT(amf_error(R"(<constellation id="2"><instance objectid="7"/></constellation>)"),
              HasSubstr("names object '7', which does not exist"));
  EXPECT_THAT(amf_error(R"(<constellation id="2"><instance objectid="2"/></constellation>)"),
              HasSubstr("is a component of itself"));
  EXPECT_THAT(
      amf_error(solid("1") + R"(<constellation id="2"><instance objectid="3"/></constellation>)"
                             R"(<constellation id="3"><instance objectid="2"/></constellation>)"),
      HasSubstr("is a component of itself"));
  EXPECT_THAT(amf_error(""), HasSubstr("holds no triangles"));
  EXPECT_THAT(amf_error(object("1", mesh(kAmfCorners, ""))), HasSubstr("holds no triangles"));
  EXPECT_THAT(amf_error(volume(kAmfSides)), HasSubstr("belongs to no object"));
  EXPECT_THAT(error_text("<amf><object>", "a.amf"), HasSubstr("is not well-formed XML"));
  EXPECT_THAT(error_text("<nothing/>", "a.amf"), HasSubstr("not that of an AMF"));
}

TEST(AmfError, RefusesADocumentType) {
  const std::string laughs =
      R"(<?xml version="1.0"?><!DOCTYPE a [<!ENTITY b "0">]><amf><object><mesh>&b;</mesh></object></amf>)";
  EXPECT_THAT(error_text(laughs, "a.amf"),
              HasSubstr("document type, which no 3D model needs; remove <!DOCTYPE"));
}

TEST(AmfError, RefusesInstancesThatDoubleAtEveryLevel) {
  std::string content = solid("0");
  for (int level = 1; level <= 40; ++level) {
    const std::string below = "<instance objectid=\"" + std::to_string(level - 1) + "\"/>";
    content += "<constellation id=\"" + std::to_string(level) + "\">";
    content.append(below).append(below).append("</constellation>");
  }
  EXPECT_THAT(amf_error(content), HasSubstr("out of proportion"));
}

TEST(Amf, PassesOverElementsAndAttributesOfForeignNamespaces) {
  const std::string foreign = R"( xmlns:x="urn:foreign" x:unit="inch")";
  const std::string parts = "<x:object id=\"1\"/>" + solid("1") + "<x:vertex/>";
  for (const std::string own : {"", " xmlns=\"urn:amf\""}) {
    const Model model = parse_model(amf(parts, foreign + own), "a.amf");
    EXPECT_EQ(model.mesh.triangles.size(), 4U);
    EXPECT_THAT(model.notes, IsEmpty());
  }
}

TEST(Amf, SurvivesElementsInWrongPlaces) {
  const std::string twice = volume(triangle(0, 2, 1) + volume("") + triangle(0, 1, 3));
  EXPECT_EQ(
      read_amf(object("1", mesh(kAmfCorners, volume(kAmfSides) + twice))).mesh.triangles.size(),
      6U);
  EXPECT_EQ(read_amf(object("1", mesh(kAmfCorners, kAmfSides))).mesh.triangles.size(), 4U);
  EXPECT_THAT(amf_error(object("1", volume(object("2", "")))), HasSubstr("belongs to no object"));
  EXPECT_EQ(read_amf(colour("1", "0", "0") + solid("1")).appearance.materials.size(), 0U);
}

}  // namespace
}  // namespace vantage::test
