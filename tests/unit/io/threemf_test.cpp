// SPDX-License-Identifier: MIT
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "vantage/io/model.h"
#include "vantage/mesh/measures.h"

#include "io/archive_locale.h"
#include "unit/io/error_text.h"
#include "unit/io/zip_archive.h"

namespace vantage::test {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr const char* kRelationships =
    R"(<?xml version="1.0"?><Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships">)"
    R"(<Relationship Target="/3D/3dmodel.model" Id="rel0" )"
    R"(Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/></Relationships>)";

constexpr const char* kTetrahedron =
    R"(<mesh><vertices><vertex x="0" y="0" z="0"/><vertex x="2" y="0" z="0"/>)"
    R"(<vertex x="0" y="2" z="0"/><vertex x="0" y="0" z="2"/></vertices>)"
    R"(<triangles><triangle v1="0" v2="2" v3="1"/><triangle v1="0" v2="1" v3="3"/>)"
    R"(<triangle v1="0" v2="3" v3="2"/><triangle v1="1" v2="2" v3="3"/></triangles></mesh>)";

/// The parts of a file that a test may change.
struct Plate {
  std::string before{};  ///< In front of the root element.
  std::string attributes = R"(unit="millimeter")";
  std::string resources =
      std::string(R"(<object id="1" type="model" name="one">)") + kTetrahedron + "</object>";
  std::string items = R"(<item objectid="1"/>)";
  std::vector<std::pair<std::string, std::string>> more{};

  [[nodiscard]] std::string model() const {
    return before + "<model " + attributes +
           R"( xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02")"
           R"( xmlns:m="http://schemas.microsoft.com/3dmanufacturing/material/2015/02")"
           R"( xmlns:p="http://schemas.microsoft.com/3dmanufacturing/production/2015/06">)"
           "<resources>" +
           resources + "</resources><build>" + items + "</build></model>";
  }

  [[nodiscard]] std::string bytes() const {
    auto files = more;
    files.insert(files.begin(), {{"_rels/.rels", kRelationships}, {"3D/3dmodel.model", model()}});
    return zip_archive(files);
  }

  [[nodiscard]] Model parsed(bool appearance = false) const {
    return parse_model(bytes(), "a.3mf", {}, {.appearance = appearance});
  }

  [[nodiscard]] std::string error() const { return error_text(bytes(), "a.3mf"); }
};

TEST(Threemf, ReadsVerticesAndTrianglesInTheirOrder) {
  const Model model = Plate().parsed();
  EXPECT_EQ(model.format, ModelFormat::Threemf);
  EXPECT_EQ(format_name(model.format), "3mf");
  ASSERT_EQ(model.mesh.positions.size(), 4U);
  EXPECT_EQ(model.mesh.positions[2], Vec3(0.0, 2.0, 0.0));
  EXPECT_THAT(model.mesh.triangles[3], ElementsAre(1, 2, 3));
  EXPECT_DOUBLE_EQ(6.0 * signed_volume(model.mesh), 8.0);
  ASSERT_EQ(model.parts.size(), 1U);
  EXPECT_EQ(model.parts[0].name, "one");
}

TEST(Threemf, TakesVerticesOfSlicesForNone) {
  Plate plate;
  plate.resources =
      R"(<s:slicestack xmlns:s="http://schemas.microsoft.com/3dmanufacturing/slice/2015/07" id="9" zbottom="0">)"
      R"(<s:slice ztop="1"><s:vertices><s:vertex x="0" y="0"/><s:vertex x="1" y="0"/></s:vertices>)"
      R"(<s:polygon startv="0"><s:segment v2="1"/></s:polygon></s:slice></s:slicestack>)" +
      plate.resources;
  const Model model = plate.parsed();
  EXPECT_EQ(model.mesh.positions.size(), 4U);
  EXPECT_EQ(model.mesh.triangles.size(), 4U);
}

TEST(Threemf, PassesOverElementsAndAttributesOfForeignNamespaces) {
  Plate plate;
  plate.attributes +=
      R"( xmlns:x="urn:foreign" xmlns:k="http://schemas.microsoft.com/3dmanufacturing/core/2015/02")";
  plate.resources = std::string(R"(<x:object/><k:object x:id="7" x:type="support" id="1">)") +
                    kTetrahedron + "</k:object><x:data><x:vertex/></x:data>";
  plate.items =
      R"(<item x:transform="9 0 0 0 9 0 0 0 9 0 0 0" x:objectid="7" objectid="1"/><x:item/>)";
  const Model model = plate.parsed();
  ASSERT_EQ(model.mesh.positions.size(), 4U);
  EXPECT_EQ(model.mesh.positions[1], Vec3(2.0, 0.0, 0.0));
  EXPECT_THAT(model.notes, IsEmpty());
}

TEST(Threemf, IsFoundByItsContentUnderAnyName) {
  EXPECT_EQ(parse_model(Plate().bytes(), "a.bin").format, ModelFormat::Threemf);
}

TEST(Threemf, MovesEachItemByItsRowOfTwelveNumbers) {
  Plate plate;
  // Rows: x goes to y, y to z, z to x; then a shift.
  plate.items =
      R"(<item objectid="1" transform="0 1 0 0 0 1 1 0 0 10 20 30"/><item objectid="1"/>)";
  const Model model = plate.parsed();
  ASSERT_EQ(model.mesh.positions.size(), 8U);
  EXPECT_EQ(model.mesh.positions[0], Vec3(10.0, 20.0, 30.0));
  EXPECT_EQ(model.mesh.positions[1], Vec3(10.0, 22.0, 30.0));
  EXPECT_EQ(model.mesh.positions[5], Vec3(2.0, 0.0, 0.0));
}

TEST(Threemf, AppliesTheInnerTransformOfAComponentFirst) {
  Plate plate;
  plate.resources += R"(<object id="2"><components>)"
                     R"(<component objectid="1" transform="2 0 0 0 2 0 0 0 2 0 0 0"/>)"
                     R"(<component objectid="1"/></components></object>)";
  plate.items = R"(<item objectid="2" transform="1 0 0 0 1 0 0 0 1 5 0 0"/>)";
  const Model model = plate.parsed();
  ASSERT_EQ(model.mesh.positions.size(), 8U);
  EXPECT_EQ(model.mesh.positions[1], Vec3(9.0, 0.0, 0.0));  // 2 · 2 + 5
  EXPECT_EQ(model.mesh.positions[5], Vec3(7.0, 0.0, 0.0));
}

TEST(Threemf, KeepsAMirroredShellTheRightSideOut) {
  Plate plate;
  plate.items = R"(<item objectid="1" transform="-1 0 0 0 1 0 0 0 1 0 0 0"/>)";
  EXPECT_DOUBLE_EQ(6.0 * signed_volume(plate.parsed().mesh), 8.0);
}

TEST(Threemf, ReadsObjectsOfOtherParts) {
  Plate plate;
  Plate other;
  other.items.clear();
  plate.resources =
      R"(<object id="3"><components>)"
      R"(<component p:path="/3D/Objects/a.model" objectid="1"/></components></object>)";
  plate.items = R"(<item objectid="3"/>)";
  plate.more = {{"3D/Objects/a.model", other.model()}};
  EXPECT_EQ(plate.parsed().mesh.positions.size(), 4U);
}

TEST(Threemf, PartsThatNothingNamesChangeNothing) {
  Plate unused;
  unused.attributes =
      R"(requiredextensions="b" xmlns:b="http://schemas.microsoft.com/3dmanufacturing/beamlattice/2017/02")";
  Plate plate;
  plate.more = {{"__MACOSX/3D/._3dmodel.model", "no XML"}, {"3D/unused.model", unused.model()}};
  EXPECT_EQ(plate.parsed().mesh.positions.size(), 4U);
  EXPECT_THAT(plate.parsed().notes, IsEmpty());
}

TEST(ThreemfError, SaysWhatIsWrongWithAPartThatAnotherNames) {
  Plate plate;
  plate.more = {{"3D/broken.model", "no XML"}, {"3D/between.model", Plate().model()}};
  std::string& between = plate.more[1].second;
  between.replace(
      between.find("<mesh>"), between.find("</object>") - between.find("<mesh>"),
      R"(<components><component p:path="/3D/broken.model" objectid="1"/></components>)");
  plate.items += R"(<item objectid="1" p:path="/3D/between.model"/>)";
  EXPECT_THAT(plate.error(), AllOf(HasSubstr("part '3d/broken.model', line 1"),
                                   HasSubstr("is not well-formed XML")));
}

TEST(Threemf, ReadsARootPartWhoseNameIsNotAscii) {
  std::string relationships = kRelationships;
  const std::string root = "3D/модель-é.model";
  relationships.replace(relationships.find("3D/3dmodel.model"), 16, root);
  const ArchiveLocale names_beyond_ascii;  // that the writer marks them as UTF-8
  const std::string bytes = zip_archive({{"_rels/.rels", relationships}, {root, Plate().model()}});
  EXPECT_EQ(parse_model(bytes, "a.3mf").mesh.positions.size(), 4U);
}

TEST(Threemf, LeavesTheLocaleOfTheThreadAsItWas) {
  const locale_t before = uselocale(nullptr);
  static_cast<void>(Plate().parsed());
  EXPECT_EQ(uselocale(nullptr), before);
}

TEST(Threemf, KeepsTheFilesUnitAndNamesIt) {
  Plate plate;
  plate.attributes = R"(unit="inch")";
  const Model model = plate.parsed();
  EXPECT_EQ(model.mesh.positions[1], Vec3(2.0, 0.0, 0.0));
  EXPECT_THAT(model.notes, Contains(HasSubstr("inch")));
}

TEST(Threemf, NotesAPartOfAnotherUnit) {
  Plate other;
  other.attributes = R"(unit="inch")";
  Plate plate;
  plate.items = R"(<item objectid="1"/><item objectid="1" p:path="/3D/b.model"/>)";
  plate.more = {{"3D/b.model", other.model()}};
  EXPECT_THAT(plate.parsed().notes,
              ElementsAre(HasSubstr("part '3d/b.model' has the unit 'inch'")));
}

TEST(Threemf, LeavesSupportsOut) {
  Plate plate;
  plate.resources += std::string(R"(<object id="2" type="support">)") + kTetrahedron + "</object>";
  plate.items += R"(<item objectid="2"/>)";
  const Model model = plate.parsed();
  EXPECT_EQ(model.mesh.positions.size(), 4U);
  EXPECT_THAT(model.notes, Contains(HasSubstr("support")));
}

TEST(Threemf, IgnoresTheTypeOfAnObjectWithComponents) {
  for (const std::string type : {"support", "other"}) {
    Plate plate;
    plate.resources += R"(<object id="2" type=")" + type +
                       R"("><components><component objectid="1"/></components></object>)";
    plate.items += R"(<item objectid="2"/>)";
    EXPECT_EQ(plate.parsed().mesh.triangles.size(), 8U) << type;
  }
}

TEST(ThreemfError, SaysWhyNothingIsShown) {
  Plate plate;
  plate.resources = std::string(R"(<object id="1" type="support">)") + kTetrahedron + "</object>";
  EXPECT_THAT(plate.error(), HasSubstr("neither faces nor points; objects that only support"));
}

TEST(Threemf, ShowsEveryObjectOfAFileThatBuildsNothing) {
  Plate plate;
  plate.items.clear();
  EXPECT_EQ(plate.parsed().mesh.positions.size(), 4U);
}

TEST(Threemf, OfAFileThatBuildsNothingShowsComponentsWithinTheirWholesOnly) {
  Plate plate;
  plate.resources += R"(<object id="2"><components><component objectid="1"/>)"
                     R"(<component objectid="1" transform="1 0 0 0 1 0 0 0 1 5 0 0"/>)"
                     R"(</components></object>)";
  plate.items.clear();
  EXPECT_EQ(plate.parsed().mesh.positions.size(), 8U);  // not 12
}

TEST(ThreemfError, RefusesObjectsThatHoldEachOtherInAFileThatBuildsNothing) {
  Plate plate;
  plate.resources = R"(<object id="2"><components><component objectid="3"/></components></object>)"
                    R"(<object id="3"><components><component objectid="2"/></components></object>)";
  plate.items.clear();
  EXPECT_THAT(plate.error(), HasSubstr("component of itself"));
  plate.resources += Plate().resources;  // though it is whole
  EXPECT_THAT(plate.error(), HasSubstr("component of itself"));
}

TEST(Threemf, FindsPartsWhoseNamesArePercentEncodedInOnePlace) {
  for (const auto& [path, entry] : {std::pair("/3D/my%20part.model", "3D/my part.model"),
                                    std::pair("/3D/my part.model", "3D/my%20part.model"),
                                    std::pair("/3D/my%20part.model", "3D/my%20part.model")}) {
    Plate other;
    other.items.clear();
    Plate plate;
    plate.resources =
        std::string(R"(<object id="3"><components><component objectid="1" p:path=")") + path +
        R"("/></components></object>)";
    plate.items = R"(<item objectid="3"/>)";
    plate.more = {{entry, other.model()}};
    EXPECT_EQ(plate.parsed().polygons, 4U) << path << " " << entry;
  }
}

TEST(Threemf, NotesItemsThatAreNotToBePrinted) {
  Plate plate;
  plate.items += R"(<item objectid="1" printable="0"/><item objectid="1" printable="1"/>)";
  const Model model = plate.parsed();
  EXPECT_EQ(model.polygons, 12U);
  EXPECT_THAT(model.notes, ElementsAre("items that are not to be printed are shown too: 1"));
}

TEST(Threemf, NotesExtensionsThatItNeedsAndThatAreNotRead) {
  Plate plate;
  plate.attributes =
      R"(requiredextensions="m  p b" xmlns:b="http://schemas.microsoft.com/3dmanufacturing/beamlattice/2017/02")";
  EXPECT_THAT(plate.parsed().notes,
              ElementsAre(AllOf(HasSubstr("needs the extension"),
                                HasSubstr("'beamlattice/2017/02'"), HasSubstr("is not read"))));
  plate.attributes = R"(requiredextensions="m p")";
  EXPECT_THAT(plate.parsed().notes, IsEmpty());
}

TEST(ThreemfError, SaysWhichExtensionMakesTheShape) {
  Plate plate;
  plate.attributes =
      R"(requiredextensions="b" xmlns:b="http://schemas.microsoft.com/3dmanufacturing/beamlattice/2017/02")";
  plate.resources =
      R"(<object id="1"><mesh><vertices><vertex x="0" y="0" z="0"/><vertex x="2" y="0" z="0"/>)"
      R"(</vertices><triangles/><b:beamlattice radius="1"><b:beams><b:beam v1="0" v2="1"/></b:beams>)"
      R"(</b:beamlattice></mesh></object>)";
  EXPECT_THAT(plate.error(),
              AllOf(HasSubstr("'beamlattice/2017/02'"), HasSubstr("save it as a mesh")));
}

TEST(Threemf, GivesTrianglesTheColoursOfTheirGroups) {
  Plate plate;
  plate.resources =
      R"(<basematerials id="7"><base name="red" displaycolor="#FF0000"/>)"
      R"(<base name="blue" displaycolor="#0000FFFF"/></basematerials>)"
      R"(<m:colorgroup id="8"><m:color color="#00FF0033"/></m:colorgroup>)"
      R"(<object id="1" pid="7" pindex="1"><mesh><vertices><vertex x="0" y="0" z="0"/>)"
      R"(<vertex x="1" y="0" z="0"/><vertex x="0" y="1" z="0"/></vertices><triangles>)"
      R"(<triangle v1="0" v2="1" v3="2"/><triangle v1="0" v2="1" v3="2" p1="0"/>)"
      R"(<triangle v1="0" v2="1" v3="2" pid="8" p1="0"/></triangles></mesh></object>)";
  const Appearance look = plate.parsed(true).appearance;
  ASSERT_EQ(look.material_of_triangle.size(), 3U);
  const auto colour = [&](std::size_t t) {
    return look.materials[look.material_of_triangle[t]].colour;
  };
  EXPECT_THAT(colour(0), ElementsAre(0.0, 0.0, 1.0));
  EXPECT_THAT(colour(1), ElementsAre(1.0, 0.0, 0.0));
  EXPECT_THAT(colour(2), ElementsAre(0.0, 1.0, 0.0));
  EXPECT_EQ(look.materials[0].alpha, AlphaMode::Opaque);
  EXPECT_EQ(look.materials[2].alpha, AlphaMode::Blend);
  EXPECT_DOUBLE_EQ(look.materials[2].opacity, 0.2);
}

TEST(Threemf, NotesTexturesThatItDoesNotRead) {
  Plate plate;
  plate.resources =
      R"(<m:texture2dgroup id="8" texid="9"><m:tex2coord u="0" v="0"/></m:texture2dgroup>)"
      R"(<object id="1" pid="8" pindex="0"><mesh><vertices><vertex x="0" y="0" z="0"/>)"
      R"(<vertex x="1" y="0" z="0"/><vertex x="0" y="1" z="0"/></vertices><triangles>)"
      R"(<triangle v1="0" v2="1" v3="2"/></triangles></mesh></object>)";
  EXPECT_THAT(plate.parsed(true).notes, Contains(HasSubstr("textures and mixed materials")));
  EXPECT_THAT(plate.parsed(false).notes, IsEmpty());
  const std::string group =
      R"(<m:colorgroup id="8"><m:color color="#FF0000"/><m:color color="#00FF00"/></m:colorgroup>)";
  plate.resources.replace(0, plate.resources.find("<object"), group);
  plate.resources.insert(plate.resources.find(R"("2"/></triangles)") + 3, R"( p1="0" p2="0")");
  EXPECT_THAT(plate.parsed(true).notes, IsEmpty());
  plate.resources.insert(plate.resources.find(R"(/></triangles)"), R"( p3="1")");
  EXPECT_THAT(plate.parsed(true).notes, Contains(HasSubstr("colours of corners")));
}

TEST(ThreemfError, NamesThePartAndTheLineOfAMissingVertex) {
  Plate plate;
  plate.resources = std::string("\n<object id=\"1\">\n") + kTetrahedron + "</object>";
  plate.resources.replace(plate.resources.find("v3=\"3\""), 6, "v3=\"4\"");
  EXPECT_THAT(plate.error(), HasSubstr("line 3"));
  EXPECT_THAT(plate.error(), HasSubstr("'4' of 4"));
}

TEST(ThreemfError, RefusesADocumentTypeAndWithItEveryEntity) {
  Plate plate;
  plate.before = R"(<!DOCTYPE model [<!ENTITY a "aaaaaaaaaa"><!ENTITY b "&a;&a;">]>)";
  EXPECT_THAT(plate.error(), HasSubstr("document type"));
  plate.before = R"(<!DOCTYPE model SYSTEM "file:///etc/passwd">)";
  EXPECT_THAT(plate.error(), HasSubstr("document type"));
}

TEST(ThreemfError, RefusesAComponentOfItself) {
  Plate plate;
  plate.resources +=
      R"(<object id="2"><components><component objectid="3"/></components></object>)"
      R"(<object id="3"><components><component objectid="2"/></components></object>)";
  plate.items = R"(<item objectid="2"/>)";
  EXPECT_THAT(plate.error(), HasSubstr("component of itself"));
}

TEST(ThreemfError, RefusesObjectsThatDoubleAtEveryLevel) {
  Plate plate;
  for (int id = 2; id < 60; ++id) {
    const std::string use = "<component objectid=\"" + std::to_string(id - 1) + "\"/>";
    plate.resources += "<object id=\"" + std::to_string(id) + "\"><components>" + use + use +
                       "</components></object>";
  }
  plate.items = R"(<item objectid="59"/>)";
  EXPECT_THAT(plate.error(), HasSubstr("out of proportion"));
}

TEST(ThreemfError, RefusesElementsNestedDeeperThanAnyModel) {
  Plate plate;
  std::string open;
  std::string close;
  for (int depth = 0; depth < 60; ++depth) {
    open += "<a>";
    close += "</a>";
  }
  plate.resources += open + close;
  EXPECT_EQ(plate.parsed().mesh.positions.size(), 4U);
  plate.resources += open + open + close + close;
  EXPECT_THAT(plate.error(), HasSubstr("nested deeper"));
}

TEST(ThreemfError, RefusesAnElementThatIsLongerThanAnyOfAModel) {
  Plate plate;
  plate.attributes += " a=\"" + std::string(900'000, 'a') + '"';
  EXPECT_EQ(plate.parsed().mesh.positions.size(), 4U);
  plate.attributes += " b=\"" + std::string(900'000, 'b') + '"';
  EXPECT_THAT(plate.error(), HasSubstr("longer than any"));
}

TEST(ThreemfError, RefusesMoreNamesThanAnyModelHas) {
  for (const std::string before : {"<", "<a ", "<a xmlns:"}) {
    const std::string after = before == "<" ? "/>" : "=\"b\"/>";
    Plate plate;
    for (int i = 0; i < 9'000; ++i) {
      plate.resources += before + "n" + std::to_string(i) + after;
    }
    EXPECT_EQ(plate.parsed().mesh.positions.size(), 4U) << before;
    for (int i = 9'000; i < 11'000; ++i) {
      plate.resources += before + "n" + std::to_string(i) + after;
    }
    EXPECT_THAT(plate.error(), HasSubstr("more kinds of elements")) << before;
  }
}

TEST(ThreemfError, RefusesMoreItemsObjectsAndColoursThanBytes) {
  const std::string item = R"(<item objectid="1"/>)";
  const std::string colour = "<base/>";
  for (const bool items : {true, false}) {
    Plate plate;
    std::string many;
    for (int i = 0; i < 110'000; ++i) {
      many += items ? item : colour;
    }
    (items ? plate.items : plate.resources) +=
        items ? many : "<basematerials id=\"9\">" + many + "</basematerials>";
    EXPECT_THAT(plate.error(), HasSubstr("more objects, items and colours"));
  }
}

TEST(ThreemfError, RefusesAnObjectThatHoldsItselfThousandsOfTimesBeforeMemoryEnds) {
  Plate plate;
  std::string uses;
  for (int i = 0; i < 40'000; ++i) {
    uses += R"(<component objectid="2"/>)";
  }
  plate.resources += "<object id=\"2\"><components>" + uses + "</components></object>";
  for (int id = 3; id < 40'000; ++id) {
    plate.resources += "<object id=\"" + std::to_string(id) + "\"/>";
  }
  plate.items = R"(<item objectid="2"/>)";
  EXPECT_THAT(plate.error(), HasSubstr("component of itself"));
}

TEST(ThreemfError, CountsTheNamesOfObjectsThatAreShownManyTimes) {
  Plate plate;
  plate.resources.replace(plate.resources.find("one"), 3, std::string(900'000, 'n'));
  plate.items += plate.items + plate.items;
  EXPECT_THAT(plate.error(), HasSubstr("out of proportion"));
}

TEST(ThreemfError, RefusesNumbersThatAreNone) {
  for (const char* number : {"nan", "inf", "1e200", "", "0x1", "1,5"}) {
    Plate plate;
    plate.resources.replace(plate.resources.find("x=\"2\""), 5,
                            std::string("x=\"") + number + "\"");
    EXPECT_THAT(plate.error(), HasSubstr("line 1")) << number;
  }
}

TEST(ThreemfError, RefusesATransformOfElevenNumbersOrThirteen) {
  Plate plate;
  for (const std::string numbers : {"1 0 0 0 1 0 0 0 1 0 0", "1 0 0 0 1 0 0 0 1 0 0 0 1"}) {
    plate.items = R"(<item objectid="1" transform=")" + numbers + "\"/>";
    EXPECT_THAT(plate.error(), HasSubstr("12 finite numbers")) << numbers;
  }
}

TEST(ThreemfError, IsOneSentenceWhereverTheArchiveIsCutInItsModel) {
  const std::string whole = Plate().bytes();
  const std::size_t directory = whole.find("PK\x01\x02");
  ASSERT_LT(directory, whole.size());
  for (std::size_t size = 2; size + 40 < directory; size += 7) {
    EXPECT_THAT(error_text(whole.substr(0, size), "a.3mf"), HasSubstr("a.3mf")) << size;
  }
}

TEST(ThreemfError, RefusesAnArchiveThatUnpacksToAThousandTimesItsSize) {
  Plate plate;
  plate.before = std::string(80'000'000, ' ');
  EXPECT_THAT(plate.error(), HasSubstr("more than the size of the file allows"));
}

TEST(ThreemfError, RefusesPartsOfAnArchiveThatAreNotDeflated) {
  const Plate plate;
  std::string bytes = plate.bytes();
  // The method, in the local header and in the directory: 14 is LZMA, which may ask for gigabytes.
  for (std::size_t at = 0; (at = bytes.find("PK\x03\x04", at)) != std::string::npos; ++at) {
    bytes[at + 8] = 14;
  }
  for (std::size_t at = 0; (at = bytes.find("PK\x01\x02", at)) != std::string::npos; ++at) {
    bytes[at + 10] = 14;
  }
  EXPECT_THAT(error_text(bytes, "a.3mf"), HasSubstr("deflate"));
}

}  // namespace
}  // namespace vantage::test
