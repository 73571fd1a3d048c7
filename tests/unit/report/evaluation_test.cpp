// SPDX-License-Identifier: MIT
#include "vantage/report/evaluation.h"

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <sys/resource.h>

#include "vantage/core/error.h"
#include "vantage/io/write.h"
#include "vantage/spatial/directions.h"

#include "io/byte_cursor.h"
#include "report/agreement.h"
#include "report/constant_camera.h"
#include "support/shapes.h"
#include "support/temporary_folder.h"
#include "support/worst.h"

namespace vantage {
namespace {

/// A sphere, on whose upper half people look the longer the higher.
struct Gazed {
  Gazed() {
    model.name = "ball";
    model.mesh = test::sphere(3);
    for (const Vec3& p : model.mesh.positions) {
      record.gaze.push_back(std::max(0.0, p.y()));
    }
  }

  Model model{};
  RecordedModel record{.name = "ball"};
};

TEST(Gaze, OnTheUpperHalfAgreesWithHeight) {
  const Gazed ball;
  const GazeAgreement height = evaluate_gaze(ball.record, ball.model, {}).front();
  EXPECT_EQ(height.map, "height");
  // h = y/2 + 1/2 is uniform on [0, 1]: mean 1/2, deviation 1/√12. Weighted by y over the upper half
  // its mean is ∫ y h / ∫ y = (1/6 + 1/4) / (1/2) = 5/6.
  EXPECT_NEAR(height.chance_adjusted, 1.0 / 3.0, 0.01);
  EXPECT_NEAR(height.normalised, 2.0 / 3.0, 0.02);
  EXPECT_NEAR(height.z_score, std::sqrt(12.0) / 3.0, 0.03);
}

TEST(Gaze, NeedsAValueForEachVertex) {
  Gazed ball;
  ball.record.gaze.pop_back();
  EXPECT_THROW(evaluate_gaze(ball.record, ball.model, {}), InvalidInput);
}

TEST(Bootstrap, OfEqualValuesHasNoWidth) {
  const Interval interval = bootstrap_mean(std::vector<double>{2, 2, 2});
  EXPECT_EQ(interval.low, 2.0);
  EXPECT_EQ(interval.high, 2.0);
}

TEST(Bootstrap, HoldsTheMeanAndLeavesOutWhatHasNoValue) {
  const Interval interval = bootstrap_mean(std::vector<double>{1, 2, 3, std::nan("")});
  EXPECT_DOUBLE_EQ(interval.mean, 2.0);
  EXPECT_LT(interval.low, 2.0);
  EXPECT_GT(interval.high, 2.0);
}

TEST(Bootstrap, OfNothingIsNoNumber) {
  EXPECT_TRUE(std::isnan(bootstrap_mean({}).mean));
}

/// Seen by people from the directions given, in the plane of x and z, by degrees from +z.
RecordedModel seen_from(const std::vector<double>& degrees, bool moved = true) {
  RecordedModel record{.name = "thing"};
  for (const double angle : degrees) {
    const double a = angle / 180.0 * std::numbers::pi;
    record.views.push_back({Vec3(std::sin(a), 0.0, std::cos(a)), moved});
  }
  return record;
}

const ViewAgreement* row_of(const std::vector<ViewAgreement>& rows, std::string_view method) {
  for (const ViewAgreement& row : rows) {
    if (row.method == method) {
      return &row;
    }
  }
  return nullptr;
}

TEST(Agreement, IsTheMeanAngleToTheViewsOfThoseWhoMoved) {
  RecordedModel record = seen_from({0.0, 30.0, 60.0, 90.0});
  record.views.push_back({-Vec3::UnitZ(), false});
  const ViewAgreement front = agreement("front", record, Vec3::UnitZ());
  EXPECT_NEAR(front.mean_deg, (0.0 + 30.0 + 60.0 + 90.0) / 4.0, 1e-9);
  EXPECT_EQ(front.mean_folded_deg, front.mean_deg);
  EXPECT_NEAR(front.all_folded_deg, (0.0 + 30.0 + 60.0 + 90.0 + 180.0) / 5.0, 1e-9);
  EXPECT_EQ(front.within_45, 2.0 / 4.0);
}

TEST(Agreement, FoldsViewsAtMirrorPlanes) {
  RecordedModel record = seen_from({-90.0, -60.0, 20.0});
  record.planes.push_back({.normal = Vec3::UnitX()});  // the image of −60° is 60°
  const ViewAgreement right = agreement("right", record, Vec3::UnitX());
  EXPECT_NEAR(right.mean_deg, (180.0 + 150.0 + 70.0) / 3.0, 1e-9);
  EXPECT_NEAR(right.mean_folded_deg, (0.0 + 30.0 + 70.0) / 3.0, 1e-9);
  EXPECT_EQ(right.within_45, 2.0 / 3.0);
}

TEST(Agreement, OfAnotherPersonIsEachAgainstTheOthers) {
  const auto person = another_person(seen_from({0.0, 30.0, 90.0}));
  ASSERT_TRUE(person.has_value());
  // 0° has 30 and 90 from it, 30° has 30 and 60, 90° has 90 and 60.
  EXPECT_NEAR(person->mean_deg, (60.0 + 45.0 + 75.0) / 3.0, 1e-9);
  EXPECT_NEAR(person->within_45, (0.5 + 0.5 + 0.0) / 3.0, 1e-12);
  EXPECT_EQ(person->model, "thing");
}

TEST(Agreement, OfAModelWhoseViewsWereAllKeptHasNoPerfectReferences) {
  const RecordedModel record = seen_from({0.0, 0.0}, false);
  const DirectionSet set = direction_set(ViewSphereBase::Icosahedron, 1);
  const auto rows = reference_rows(record, set, upright_frame(Vec3::UnitY()));
  EXPECT_EQ(row_of(rows, "another person"), nullptr);
  EXPECT_EQ(row_of(rows, "best possible single view"), nullptr);
  for (const ViewAgreement& row : rows) {
    EXPECT_EQ(row.model, "thing") << row.method;
    EXPECT_TRUE(std::isnan(row.mean_deg) && std::isnan(row.mean_folded_deg)) << row.method;
    EXPECT_TRUE(std::isnan(row.within_45)) << row.method;
  }
  // What counts kept starts too has a number.
  EXPECT_NEAR(row_of(rows, "straight front")->all_folded_deg, 0.0, 1e-9);
  EXPECT_NEAR(row_of(rows, "random")->all_folded_deg, 90.0, 1e-9);
}

TEST(Agreement, OfTheOnlyOneWhoMovedWithNobodyElseIsNoNumber) {
  RecordedModel record = seen_from({10.0});
  record.views.push_back({Vec3::UnitZ(), false});
  const auto person = another_person(record);
  ASSERT_TRUE(person.has_value());
  EXPECT_TRUE(std::isnan(person->mean_deg));
  EXPECT_NEAR(person->all_folded_deg, 10.0, 1e-9);
}

TEST(Agreement, OfTheBestViewIsTheLeastOfTheSetAndOfRandomItsMean) {
  const RecordedModel record = seen_from({0.0});
  const DirectionSet set = direction_set(ViewSphereBase::Icosahedron, 2);
  const auto rows = reference_rows(record, set, upright_frame(Vec3::UnitY()));
  double least = 180.0;
  for (const Vec3& d : set.directions) {
    least = test::smaller(least, angle_deg(d, Vec3::UnitZ()));
  }
  EXPECT_EQ(row_of(rows, "best possible single view")->mean_deg, least);
  EXPECT_NEAR(row_of(rows, "random")->mean_deg, 90.0, 1e-9);  // the set has d and −d
  EXPECT_NEAR(row_of(rows, "isometric (1, 1, 1)")->mean_deg,
              std::acos(1.0 / std::sqrt(3.0)) * 180.0 / std::numbers::pi, 1e-9);
}

TEST(Percentile, IsTheShareOfViewsThatAreNoBetter) {
  const std::vector<double> of_set{1.0, 2.0, 2.0, 5.0};
  // More is better: 2 beats one and ties with two, 6 beats all.
  EXPECT_EQ(human_percentile({.better = Better::More}, of_set, std::vector<double>{2.0}), 0.5);
  EXPECT_EQ(human_percentile({.better = Better::More}, of_set, std::vector<double>{2.0, 6.0}),
            0.75);
  // Less is better: 1 beats three and ties with one; a blind view beats none.
  const std::vector<double> blind{1.0, std::numeric_limits<double>::infinity()};
  EXPECT_EQ(human_percentile({.better = Better::Less}, of_set, blind), (3.5 / 4.0 + 0.0) / 2.0);
  EXPECT_TRUE(std::isnan(human_percentile({}, of_set, {})));
}

TEST(UnderThePrior, TheLargestProductWinsWhicheverWayTheMeasureGoes) {
  const DirectionSet set = direction_set(ViewSphereBase::Icosahedron, 1);
  const UprightFrame frame = upright_frame(Vec3::UnitY());
  const ViewPrior prior = upright_prior();
  std::vector<double> rising;
  std::vector<double> falling;
  for (const Vec3& d : set.directions) {
    rising.push_back(2.0 + d.z());
    falling.push_back(3.0 - rising.back());
  }
  falling[0] = std::numeric_limits<double>::infinity();  // a blind view
  rising[0] = 0.0;
  const Vec3 best = best_under_prior({.better = Better::More}, set, rising, frame);
  for (std::size_t i = 0; i < rising.size(); ++i) {
    EXPECT_LE(rising[i] * prior.factor(frame, set.directions[i]),
              (2.0 + best.z()) * prior.factor(frame, best));
  }
  double largest = 0.0;
  for (std::size_t i = 1; i < falling.size(); ++i) {
    largest = std::max(largest, falling[i]);
  }
  const Vec3 least = best_under_prior({.better = Better::Less}, set, falling, frame);
  for (std::size_t i = 1; i < falling.size(); ++i) {
    EXPECT_LE((largest - falling[i]) * prior.factor(frame, set.directions[i]),
              (largest - 1.0 + least.z()) * prior.factor(frame, least) + 1e-12);
  }
}

TEST(RocArea, IsTheChanceThatTheMostLookedAtIsLarger) {
  // Forty vertices, of which the two of most gaze count.
  std::vector<double> gaze(40, 0.0);
  gaze[7] = 3.0;
  gaze[9] = 2.0;
  std::vector<double> map(40, 1.0);
  EXPECT_EQ(roc_area(map, gaze), 0.5);  // ties count half
  map[7] = 2.0;
  EXPECT_EQ(roc_area(map, gaze), 0.75);  // one above all, one ties with all
  map[9] = 0.0;
  EXPECT_EQ(roc_area(map, gaze), 0.5);  // one above all, one below all
  map[0] = 3.0;                         // above both
  EXPECT_NEAR(roc_area(map, gaze), 37.0 / 76.0, 1e-12);
}

/// Rows of two methods and the prior on two models: `near` is 9° and 18° nearer than the prior.
std::vector<ViewAgreement> rows_of_two_models() {
  std::vector<ViewAgreement> rows;
  for (const auto& [model, prior] : {std::pair("a,b.off", 36.0), std::pair("b.off", 54.0)}) {
    rows.push_back({std::string(kPriorAlone), model, 90.0, prior, prior, 0.5, std::nan("")});
    rows.push_back({"near × prior", model, 90.0, prior - prior / 6 - 3, 9.0, 1.0, std::nan("")});
    rows.push_back({"near", model, 45.0, 72.0, 72.0, 0.25, 0.75});
  }
  return rows;
}

TEST(EvidenceTables, CompareMethodsUnderThePriorWithThePriorModelByModel) {
  const std::string text = evidence_tables(rows_of_two_models(), {});
  const std::size_t under = text.find("### Under the prior");
  ASSERT_NE(under, std::string::npos);
  // 9° and 12° less than the prior: 0.050 and 0.067 of a half turn.
  EXPECT_NE(text.find("-0.058 [-0.067, -0.050] | 2 / 0 | 50 % [50, 50]", under), std::string::npos)
      << text;
  EXPECT_EQ(text.find("near × prior"), text.find("near × prior", under));
}

TEST(EvidenceTables, GiveAnIntervalToEachMeanAndDashesWhereThereIsNone) {
  const std::string text = evidence_tables(rows_of_two_models(), {});
  EXPECT_NE(text.find("| near | 0.400 [0.400, 0.400] | – | 0.250 [0.250, 0.250] | 72.0 | 45.0 | "
                      "25 % [25, 25] | 0.400 [0.400, 0.400] | 0.75 [0.75, 0.75] |"),
            std::string::npos)
      << text;
  const GazeAgreement gaze{"height", "a", 0.1, 0.2, 0.3, 0.4, 0.5, 0.6};
  EXPECT_NE(
      evidence_tables({}, {gaze})
          .find("| height | 0.100 [0.100, 0.100] | 0.200 [0.200, 0.200] | 0.300 [0.300, 0.300] | "
                "0.4000 [0.4000, 0.4000] | 0.500 [0.500, 0.500] | 0.600 [0.600, 0.600] |"),
      std::string::npos);
  std::vector<ViewAgreement> kept = rows_of_two_models();
  for (ViewAgreement& row : kept) {
    row.mean_deg = row.mean_folded_deg = row.within_45 = std::nan("");
  }
  EXPECT_NE(evidence_tables(kept, {}).find("| near | – | – | – | – | – | – | 0.400"),
            std::string::npos);
}

TEST(EvidenceTables, CompareEachViewWithTheConstantCameraModelByModel) {
  std::vector<ViewAgreement> rows = rows_of_two_models();
  for (const auto& [model, error] : {std::pair("a,b.off", 81.0), std::pair("b.off", 54.0)}) {
    rows.push_back({std::string(kConstantCamera), model, 90.0, error, error, 0.5, std::nan("")});
  }
  const std::string text = evidence_tables(rows, {});
  // 72° against 81° and 54°: −0.05 and 0.1 of a half turn.
  EXPECT_NE(text.find("| near | 0.400 [0.400, 0.400] | 0.025 [-0.050, 0.100] |"), std::string::npos)
      << text;
  const std::size_t under = text.find("### Under the prior");
  EXPECT_NE(text.find(kConstantCamera, under), std::string::npos);
}

/// What evaluate_records() has of models before the constant camera is added, all with y up.
std::vector<EvaluatedModel> evaluated(std::size_t count) {
  return std::vector<EvaluatedModel>(count);
}

TEST(ConstantCamera, IsTheBestOneOfTheOtherModels) {
  std::vector<RecordedModel> records{seen_from({0.0}), seen_from({0.0}), seen_from({90.0})};
  std::vector<EvaluatedModel> results = evaluated(3);
  add_constant_camera(records, results);
  ASSERT_EQ(results[2].views.size(), 1U);
  EXPECT_EQ(results[2].views[0].method, kConstantCamera);
  // Both others are seen from +z, which is a direction of the set; this one from +x.
  EXPECT_NEAR(results[2].views[0].mean_folded_deg, 90.0, 1e-9);
  // Left out, the first has one other from +z and one from +x: any direction between serves both.
  EXPECT_NEAR(results[0].views[0].mean_folded_deg, results[1].views[0].mean_folded_deg, 1e-9);
  EXPECT_GE(results[0].views[0].mean_folded_deg, 0.0);
  EXPECT_LE(results[0].views[0].mean_folded_deg, 90.0 + 1e-9);
}

TEST(ConstantCamera, StandsUprightToEachModel) {
  // Seen from the front both: +z where y is up, −y where z is.
  std::vector<RecordedModel> records{seen_from({0.0}), seen_from({0.0})};
  records[1].views[0].direction = -Vec3::UnitY();
  std::vector<EvaluatedModel> results = evaluated(2);
  results[1].up = UpAxis::Z;
  add_constant_camera(records, results);
  EXPECT_NEAR(results[0].views[0].mean_folded_deg, 0.0, 1e-9);
  EXPECT_NEAR(results[1].views[0].mean_folded_deg, 0.0, 1e-9);
}

TEST(ConstantCamera, NeedsAnotherModelWhereSomebodyMoved) {
  std::vector<RecordedModel> records{seen_from({0.0}), seen_from({0.0}, false), {.name = "gaze"}};
  std::vector<EvaluatedModel> results = evaluated(3);
  add_constant_camera(records, results);
  EXPECT_TRUE(results[0].views.empty());
  ASSERT_EQ(results[1].views.size(), 1U);  // nobody moved, but there is a camera
  EXPECT_TRUE(std::isnan(results[1].views[0].mean_folded_deg));
  EXPECT_NEAR(results[1].views[0].all_folded_deg, 0.0, 1e-9);
  EXPECT_TRUE(results[2].views.empty());
}

/// A folder of one model, a glTF with its vertices beside it, and a view that somebody chose.
class RecordedFolder {
 public:
  RecordedFolder() {
    std::filesystem::create_directory(folder_.path() / "models");
    write_buffer(1.0F, {0, 1, 2, 1, 3, 2});
    write_views("1");
    write_file(folder_.file("models/a.gltf"),
               R"({"asset":{"version":"2.0"},"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
                   "meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],
                   "accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"},
                                {"bufferView":1,"componentType":5125,"count":6,"type":"SCALAR"}],
                   "bufferViews":[{"buffer":0,"byteLength":48},
                                  {"buffer":0,"byteOffset":48,"byteLength":24}],
                   "buffers":[{"byteLength":72,"uri":"a.bin"}]})");
  }

  void write_buffer(float height, const std::vector<std::uint32_t>& corners) const {
    std::string bytes;
    for (const float x : {0.F, 0.F, 0.F, 1.F, 0.F, 0.F, 0.F, height, 0.F, 1.F, 1.F, 1.F}) {
      append_little_endian(bytes, x);
    }
    for (const std::uint32_t corner : corners) {
      append_little_endian(bytes, corner);
    }
    write_file(folder_.file("models/a.bin"), bytes);
  }

  void write_views(const std::string& z) const {
    write_table("model,subject,status,vx,vy,vz\na.gltf,A,moved,0,0," + z + "\n");
  }

  void write_table(const std::string& rows) const { write_file(folder_.file("views.csv"), rows); }

  [[nodiscard]] std::vector<RecordedModel> records() const {
    return read_records(folder_.path().string());
  }

  /// How many records a run with this journal has from former ones.
  [[nodiscard]] std::size_t known() const {
    EvaluationJournal journal(folder_.file("rows.jsonl"));
    std::size_t known = 0;
    static_cast<void>(
        evaluate_records(records(), {}, {find_measure("principal-axis")}, journal, known));
    return known;
  }

 private:
  test::TemporaryFolder folder_{};
};

TEST(EvaluationJournal, KnowsNoRowsOfAnotherBuffer) {
  const RecordedFolder folder;
  EXPECT_EQ(folder.known(), 0U);
  EXPECT_EQ(folder.known(), 1U);
  folder.write_buffer(2.0F, {0, 1, 2, 1, 3, 2});
  EXPECT_EQ(folder.known(), 0U);
  folder.write_buffer(2.0F, {0, 1, 2, 0, 1, 3});  // other faces of the same vertices
  EXPECT_EQ(folder.known(), 0U);
}

TEST(ReadRecords, RefuseANumberThatGoesOnAsSomethingElse) {
  const RecordedFolder folder;
  EXPECT_EQ(folder.records().size(), 1U);
  folder.write_views("1.0abc");
  EXPECT_THROW((void)folder.records(), FormatError);
}

TEST(ReadRecords, TakeEmptyCellsAtTheEndAndAByteOrderMark) {
  const RecordedFolder folder;
  folder.write_table("\xEF\xBB\xBFmodel,vx,vy,vz,status\na.gltf,0,0,1,\na.gltf,0,0,1,moved\n\n");
  const std::vector<RecordedModel> records = folder.records();
  ASSERT_EQ(records.size(), 1U);
  ASSERT_EQ(records[0].views.size(), 2U);
  EXPECT_FALSE(records[0].views[0].moved);
  EXPECT_TRUE(records[0].views[1].moved);
}

TEST(ReadRecords, LeaveOutAModelThatIsNotThere) {
  const RecordedFolder folder;
  folder.write_table(
      "model,subject,status,vx,vy,vz\na.gltf,A,moved,0,0,1\ngone.ply,A,moved,0,0,1\n");
  ASSERT_EQ(folder.records().size(), 1U);
  EXPECT_EQ(folder.records().front().name, "a.gltf");
}

TEST(EvaluationJournal, RefusesAnUpThatIsNoAxis) {
  const test::TemporaryFolder folder;
  const std::string file = folder.file("rows.jsonl");
  for (const char* const up : {"-1", "7", "4294967296", "0.5"}) {
    write_file(file, std::string(R"({"key":"a","up":)") + up + ",\"views\":[],\"gaze\":[]}\n");
    EXPECT_THROW(EvaluationJournal{file}, FormatError) << up;
  }
  write_file(file, "{\"key\":\"a\",\"up\":6,\"views\":[],\"gaze\":[]}\n");
  EXPECT_EQ(EvaluationJournal(file).find("a")->up, UpAxis::Any);
}

TEST(EvaluationJournal, KeepsNoPartOfARowThatDoesNotFit) {
  const test::TemporaryFolder folder;
  const std::string file = folder.file("rows.jsonl");
  EvaluationJournal journal(file);
  journal.add("first", {});
  const auto size = std::filesystem::file_size(file);

  struct rlimit limit {};

  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &limit), 0);

  const struct rlimit small { size + 10, limit.rlim_max };

  const auto before = std::signal(SIGXFSZ, SIG_IGN);
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
  EXPECT_THROW(journal.add("second", {}), IoError);
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &limit), 0);
  std::signal(SIGXFSZ, before);
  EXPECT_EQ(std::filesystem::file_size(file), size);
  journal.add("third", {});
  const EvaluationJournal again(file);
  EXPECT_NE(again.find("first"), nullptr);
  EXPECT_EQ(again.find("second"), nullptr);
  EXPECT_NE(again.find("third"), nullptr);
}

TEST(AgreementCsv, HoldsNamesWithCommasAndQuotes) {
  const GazeAgreement gaze{"a \"map\"", "x,y.off", 0, 0, 0, 0, 0, 0};
  EXPECT_NE(gaze_agreement_csv({gaze}).find("\n\"a \"\"map\"\"\",\"x,y.off\",0,"),
            std::string::npos);
  EXPECT_NE(view_agreement_csv(rows_of_two_models()).find("\n\"near\",\"a,b.off\",45,"),
            std::string::npos);
}

}  // namespace
}  // namespace vantage
