// SPDX-License-Identifier: MIT
#include "pipeline/frame_choice.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <string>

#include <gtest/gtest.h>

#include "vantage/core/error.h"
#include "vantage/pipeline/find_views.h"

#include "support/model_of.h"
#include "support/shapes.h"

namespace vantage::test {
namespace {

/// A table that stands on z = 0.
TriMesh table() {
  TriMesh mesh;
  mesh = together(mesh, box(2.0, 1.0, 0.1, 4), {0.0, 0.0, 0.8});
  for (const double x : {0.0, 1.9}) {
    for (const double y : {0.0, 0.9}) {
      mesh = together(mesh, box(0.1, 0.1, 0.8, 2), {x, y, 0.0});
    }
  }
  return mesh;
}

FrameChoice choice_for(const TriMesh& mesh, ModelFormat format, const ViewOptions& options = {}) {
  Model model = model_of(mesh);
  model.format = format;
  return choose_frame(model, prepare_surface(model), options);
}

/// Hills: a field of heights over x and y, 100 wide.
TriMesh hills(const Vec3& corner) {
  constexpr std::uint32_t kSide = 24;
  TriMesh mesh;
  for (std::uint32_t i = 0; i < kSide; ++i) {
    for (std::uint32_t j = 0; j < kSide; ++j) {
      const double x = 100.0 * i / (kSide - 1);
      const double y = 100.0 * j / (kSide - 1);
      const double height = 8.0 * std::sin(x / 11.0) * std::cos(y / 17.0) + 3.0 * std::sin(y / 5.0);
      mesh.positions.emplace_back(corner + Vec3(x, y, height));
      if (i > 0 && j > 0) {
        const std::uint32_t v = i * kSide + j;
        mesh.triangles.push_back({v - kSide - 1, v - 1, v});
        mesh.triangles.push_back({v - kSide - 1, v, v - kSide});
      }
    }
  }
  return mesh;
}

TriMesh with_y_up(TriMesh mesh) {
  for (Vec3& p : mesh.positions) {
    p = Vec3(p.x(), p.z(), -p.y());
  }
  return mesh;
}

TEST(FrameChoice, HeightIsUpInCoordinatesOfAMap) {
  const Vec3 in_utm(567840.5, 5934517.25, 120.0);
  const FrameChoice terrain = choice_for(hills(in_utm), ModelFormat::Obj);
  EXPECT_EQ(terrain.frame.up, UpAxis::Z);
  EXPECT_EQ(terrain.orientation.up.source, "format");
  EXPECT_EQ(terrain.up_habit, UpHabit::MapCoordinates);
  EXPECT_EQ(choice_for(with_y_up(hills(in_utm)), ModelFormat::Stl).frame.up, UpAxis::Y);
}

TEST(FrameChoice, SaysThatMapCoordinatesAreWhyTheHeightIsUp) {
  TriMesh ball = sphere(2);
  for (Vec3& p : ball.positions) {
    p += Vec3(5e5, 5e6, 0.0);
  }
  EXPECT_EQ(
      frame_summary(choice_for(ball, ModelFormat::Obj)).rfind("up: z, by its map coordinates", 0),
      0U)
      << frame_summary(choice_for(ball, ModelFormat::Obj));
}

TEST(FrameChoice, OtherFarPlacesAreNoMaps) {
  for (const Vec3& corner : {Vec3(567840.5, 120.0, 80.0), Vec3(2e5, 3e5, 4e5),
                             Vec3(900.0, 900.0, 0.0), Vec3(0.0, 5e6, 0.0)}) {
    EXPECT_NE(choice_for(hills(corner), ModelFormat::Obj).up_habit, UpHabit::MapCoordinates)
        << corner.transpose();
  }
  EXPECT_EQ(choice_for(hills({5e5, 5e6, 0.0}), ModelFormat::Gltf).up_habit, UpHabit::Format);
}

TEST(FrameChoice, IsTheFormatsWhereItsHabitHolds) {
  const FrameChoice choice = choice_for(table(), ModelFormat::Stl);
  EXPECT_EQ(choice.frame.up, UpAxis::Z);
  EXPECT_EQ(choice.orientation.up.source, "format");
}

TEST(FrameChoice, OfABoxIsTheFormats) {
  const FrameChoice choice = choice_for(box(1.0, 1.0, 1.0, 4), ModelFormat::Ply);
  EXPECT_EQ(choice.frame.up, UpAxis::Y);
  EXPECT_EQ(choice.frame.front, UpAxis::Z);
  EXPECT_EQ(choice.orientation.up.source, "format");
  EXPECT_TRUE(choice.notes.empty());
}

TEST(FrameChoice, IsTheFormatsUpForGltfWhateverTheShape) {
  EXPECT_EQ(choice_for(table(), ModelFormat::Glb).frame.up, UpAxis::Y);
  EXPECT_EQ(choice_for(table(), ModelFormat::Gltf).frame.up, UpAxis::Y);
}

TEST(FrameChoice, IsTheUsersWhateverTheShape) {
  ViewOptions options;
  options.up = UpAxis::MinusX;
  options.front = UpAxis::Y;
  const FrameChoice choice = choice_for(table(), ModelFormat::Ply, options);
  EXPECT_EQ(choice.frame.up, UpAxis::MinusX);
  EXPECT_EQ(choice.frame.front, UpAxis::Y);
  EXPECT_EQ(choice.orientation.up.source, "given");
  EXPECT_EQ(frame_summary(choice), "up: -x, as given; front: y, as given");
}

TEST(FrameChoice, SaysItsFormatsOnlyOfWhatIsItsFormats) {
  FrameChoice choice;
  choice.orientation.up = {.source = "shape", .confidence = 0.7};
  choice.orientation.front = {.direction = Vec3::UnitZ(),
                              .source = "format",
                              .confidence = 0.6,
                              .likeliest = Vec3::UnitZ()};
  EXPECT_EQ(frame_summary(choice), "up: y, 70 % sure; front: z, 60 % sure, its format's");
}

TEST(FrameChoice, CallsItsFormatsUnsureWhereAnotherIsLikelier) {
  FrameChoice choice;
  choice.orientation.up = {.source = "format", .confidence = 0.4, .likeliest = Vec3::UnitX()};
  choice.orientation.front = {.direction = -Vec3::UnitY(),
                              .source = "format",
                              .confidence = 0.03,
                              .likeliest = Vec3::UnitX(),
                              .likeliest_confidence = 0.6,
                              .by_shape = Vec3(Vec3::UnitX())};
  EXPECT_EQ(frame_summary(choice),
            "up: y by its format, unsure (likelier: x); front: -y by its format, unsure (the shape "
            "alone: x)");
}

TEST(FrameChoice, SaysThatSidesLookTheSameWhereThatMakesItSure) {
  EXPECT_EQ(frame_summary(choice_for(box(1.0, 1.0, 1.0, 4), ModelFormat::Ply)),
            "up: y, its format's: all sides look the same; front: z, its format's: all sides look "
            "the same");
  ViewOptions options;
  options.up = UpAxis::Y;
  const std::string bar =
      frame_summary(choice_for(box(3.0, 1.0, 0.5, 4), ModelFormat::Ply, options));
  EXPECT_TRUE(bar.starts_with("up: y, as given; front: z (-z looks the same), ")) << bar;
}

TEST(FrameChoice, GivesNoReasonsOfTheShapeForWhatHabitCarries) {
  // A tower that stands on z = 0, in a format whose up is y.
  const TriMesh tower = together(box(1.0, 1.0, 1.0, 1), box(0.6, 0.6, 2.0, 1), Vec3(0.2, 0.2, 1.0));
  const FrameChoice choice = choice_for(tower, ModelFormat::Ply);
  const std::string said = frame_summary(choice);
  EXPECT_TRUE(said.starts_with(
      "up: y (x, -x and -y look the same), 83 % sure, its format's (the shape alone: z); front: "))
      << said;
  EXPECT_EQ(choice.orientation.up.reasons, "");
  const std::string upright = frame_summary(choice_for(tower, ModelFormat::Stl));
  EXPECT_TRUE(upright.find("sure, by its flat base and ") != std::string::npos) << upright;
}

TEST(FrameChoice, NotesWhereTheShapeAloneIsSureOfAnother) {
  FrameChoice choice;
  choice.orientation.up.source = "format";
  DirectionChoice& front = choice.orientation.front;
  front = {.direction = Vec3::UnitZ(),
           .source = "format",
           .confidence = 0.6,
           .likeliest = Vec3::UnitZ(),
           .by_shape = Vec3(Vec3::UnitX()),
           .by_shape_confidence = 0.7};
  EXPECT_EQ(note_on_front(choice, {}), "");
  front.by_shape_confidence = 0.9;
  EXPECT_EQ(note_on_front(choice, {}),
            "front: z is taken, the usual one of its format (60 % sure), but the shape alone "
            "suggests x; --front x takes it");
}

TEST(FrameChoice, NotesWhereTheShapeAloneFavoursTheBackOrAnotherUp) {
  FrameChoice choice;
  choice.orientation.up.source = "shape";
  choice.frame.up = UpAxis::Z;
  DirectionChoice& front = choice.orientation.front;
  front = {.direction = -Vec3::UnitY(),
           .source = "format",
           .confidence = 0.76,
           .likeliest = -Vec3::UnitY(),
           .by_shape = Vec3(Vec3::UnitY()),
           .by_shape_confidence = 0.49};
  EXPECT_EQ(note_on_front(choice, {}), "");
  front.by_shape_confidence = 0.52;
  EXPECT_TRUE(note_on_front(choice, {})
                  .ends_with("but the shape alone suggests y; --up y --front y takes it"))
      << note_on_front(choice, {});
  // A seat with a back on a post: the shape alone says z by 0.77, the format y.
  TriMesh seat = together(box(1.0, 0.8, 0.05, 1), box(0.3, 0.3, 0.8, 1), {0.35, 0.25, 0.05});
  seat = together(seat, box(2.0, 1.0, 0.1, 1), {-0.5, -0.1, 0.85});
  seat = together(seat, box(2.0, 0.1, 0.8, 1), {-0.5, 0.8, 0.95});
  const FrameChoice standing = choice_for(seat, ModelFormat::Ply);
  EXPECT_GT(standing.orientation.up.confidence, 0.5);
  EXPECT_LT(standing.orientation.up.by_shape_confidence, 0.8);
  ASSERT_FALSE(standing.notes.empty());
  EXPECT_TRUE(standing.notes[0].ends_with("sure), but the shape alone suggests z; --up z takes it"))
      << standing.notes[0];
}

TEST(FrameChoice, SaysOfTheBestViewOnlyWhatIsTrueOfAFrontThatIsUnsure) {
  const auto said = [](const DirectionChoice& front, const std::array<double, 4>& odds) {
    FrameChoice choice;
    choice.orientation.front = front;
    choice.orientation.front_odds = odds;
    const std::string note = note_on_front(choice, {}, Vec3(0.5, 0.4, -0.7));
    const std::size_t begin = note.find("the best view");
    return begin == std::string::npos ? note : note.substr(begin, note.rfind("; ") - begin);
  };
  DirectionChoice front{.direction = Vec3::UnitZ(),
                        .source = "format",
                        .confidence = 0.1,
                        .likeliest = -Vec3::UnitZ(),
                        .likeliest_confidence = 0.7};
  EXPECT_EQ(said(front, {0.1, 0.1, 0.7, 0.1}),
            "the best view weighs all sides, and is from the side that the shape suggests");
  front.likeliest = -Vec3::UnitX();
  EXPECT_EQ(said(front, {0.1, 0.1, 0.1, 0.7}),
            "the best view weighs all sides, and is from behind if the front is z");
  EXPECT_EQ(said(front, {0.1, 0.1, 0.2, 0.6}), "the best view weighs all sides");
  front.likeliest = front.direction;
  front.confidence = 0.47;
  const char* const behind = "the best view weighs all sides, and is from behind if the front is z";
  EXPECT_EQ(said(front, {0.47, 0.1, 0.3, 0.13}), behind);
  front.source = "shape";
  EXPECT_EQ(said(front, {0.47, 0.1, 0.3, 0.13}), behind);
  front.confidence = 0.9;
  EXPECT_EQ(said(front, {0.9, 0.0, 0.1, 0.0}), "the best view is from behind");
}

TEST(FrameChoice, CallsAFrontOfTheShapeUnsureBelowOneHalf) {
  FrameChoice choice;
  choice.orientation.up.source = "shape";
  choice.orientation.front = {.direction = Vec3::UnitX(),
                              .source = "shape",
                              .confidence = 0.44,
                              .likeliest = Vec3::UnitX(),
                              .reasons = "its mirror plane"};
  EXPECT_EQ(
      note_on_front(choice, {}),
      "front is unsure: x is taken (44 % sure, by its mirror plane), not z, the usual one for "
      "this up; the best view weighs all sides; --up y --front z overrules this");
  choice.orientation.front.confidence = 0.6;
  EXPECT_TRUE(note_on_front(choice, {}).starts_with("front is taken to be x (60 % sure"));
}

TEST(StandAlongAxes, SaysWhereItTurnsNothing) {
  Model model = model_of(sphere(2));
  ViewOptions options;
  options.up = UpAxis::Any;
  EXPECT_TRUE(stand_along_axes(model, options).isIdentity(0.0));
  ASSERT_EQ(model.notes.size(), 1U);
  EXPECT_TRUE(model.notes.front().starts_with("--up any turned nothing"));
}

TEST(FrameChoice, RefusesUpAndFrontOfOneAxis) {
  ViewOptions options;
  options.up = UpAxis::Y;
  options.front = UpAxis::MinusY;
  EXPECT_THROW((void)choice_for(table(), ModelFormat::Ply, options), InvalidInput);
}

TEST(FrameChoice, SaysWhatItIsUnsureOfAndHowToSetIt) {
  for (const ModelFormat format : {ModelFormat::Ply, ModelFormat::Stl}) {
    const FrameChoice choice = choice_for(table(), format);
    const DirectionChoice& up = choice.orientation.up;
    const bool is_plain = up.source == "format" && up.confidence >= 0.5;
    const bool speaks_of_up =
        !choice.notes.empty() && choice.notes.front().find("--up") != std::string::npos;
    EXPECT_EQ(speaks_of_up, !is_plain);
  }
}

}  // namespace
}  // namespace vantage::test
