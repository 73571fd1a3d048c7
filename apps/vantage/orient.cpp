// SPDX-License-Identifier: MIT
#include <algorithm>
#include <filesystem>

#include <Eigen/Geometry>

#include "vantage/core/error.h"
#include "vantage/io/model.h"
#include "vantage/io/write.h"
#include "vantage/pipeline/find_views.h"
#include "vantage/pipeline/sidecar.h"

#include "batch/json_text.h"
#include "commands.h"
#include "input_text.h"
#include "load_posed.h"
#include "method_flags.h"
#include "notes.h"
#include "output_file.h"
#include "terminal.h"

namespace vantage::cli {
namespace {

using batch::Json;

std::string axis_name(const Vec3& direction) {
  return std::string(up_name(axis_nearest(direction)));
}

Json choice_json(const DirectionChoice& choice) {
  return {{"axis", axis_name(choice.direction)},
          {"source", choice.source},
          {"confidence", choice.confidence},
          {"likeliest", axis_name(choice.likeliest)},
          {"likeliest_confidence", choice.likeliest_confidence},
          {"reasons", choice.reasons},
          {"by_shape", choice.by_shape ? Json(axis_name(*choice.by_shape)) : Json(nullptr)},
          {"by_shape_confidence", choice.by_shape_confidence}};
}

/// A note without what the line of the result says already: how sure a choice is, and by what.
std::string shortened(std::string note) {
  const std::size_t begin = note.find(" (");
  const std::size_t end = note.find("), not ");
  return begin < end && end != std::string::npos ? note.erase(begin, end + 1 - begin) : note;
}

/// "turned from z up, front -y, to y up, front z"
std::string turn_text(const ModelFrame& from, UpAxis up) {
  const auto text = [](const ModelFrame& frame) {
    return std::string(up_name(frame.up)) + " up, front " + std::string(up_name(frame.front));
  };
  return "turned from " + text(from) + ", to " + text({up, default_front(up)});
}

/// Every candidate's features: what scripts/fit_orientation.py reads.
std::string features_json(const ShapeAnalysis& shape) {
  Json json = {{"up_features", Json::array()},
               {"front_features", Json::array()},
               {"ups", Json::array()},
               {"fronts", Json::array()}};
  for (const OrientationFeatures& row : OrientationEvidence(shape.surface, shape.flow).features()) {
    Json names = Json::array();
    Json values = Json::array();
    for (const OrientationFeature& feature : row.values) {
      names.push_back(feature.name);
      values.push_back(feature.value);
    }
    json[row.front ? "front_features" : "up_features"] = std::move(names);
    if (!row.front) {
      json["ups"].push_back({{"up", axis_name(row.up)}, {"values", std::move(values)}});
    } else {
      json["fronts"].push_back({{"up", axis_name(row.up)},
                                {"front", axis_name(*row.front)},
                                {"back_difference", row.back_difference},
                                {"side_difference", row.side_difference},
                                {"values", std::move(values)}});
    }
  }
  return batch::json_text(json) + "\n";
}

struct OrientCommand {
  std::string model{};
  std::string file{};
  bool print = false;
  bool features = false;
  OptionFlags known{};

  void add_flags(CLI::App& app, Session& session) {
    app.add_option("MODEL", model, "file to read, or -")->required();
    app.add_option(
        "-o,--output", file,
        "file to write: the model upright and facing the front of its format; of MODEL's "
        "own format (OBJ, STL, glTF, GLB), or PLY");
    app.add_flag("--print", print, "print the rotation as a quaternion x y z w");
    app.add_flag("--features", features,
                 "print what the shape says of each direction, as JSON, and do nothing else");
    known.add(app, find_option("up"));
    known.add(app, find_option("front"));
    add_force_flag(app, session.flags);
    add_common_flags(app, session.flags);
  }

  void run(Session& session) const {
    session.refuse_idle(features, {"--output", "--print"},
                        "has no effect beside --features, which does nothing else");
    AllOptions given;
    known.apply(given);
    Model loaded = session.load(model);
    const std::optional<UpAxis> front = given.view.front;
    apply_below(known, session.read([&] { return sidecar_of(model); }), given.view);
    refuse_front_along_up(front, loaded, given.view);
    const Eigen::Matrix3d stood =
        session.computing([&] { return stand_along_axes(loaded, given.view); });
    const ShapeAnalysis shape =
        session.computing([&] { return prepare_surface(loaded, session.run()); });
    if (features) {
      write_output("-", features_json(shape));
      return;
    }
    FrameChoice choice = session.computing([&] { return choose_frame(loaded, shape, given.view); });
    if (given.view.up == UpAxis::Any) {
      choice.notes.insert(choice.notes.begin(), loaded.notes.back());  // of stand_along_axes()
    }
    const UpAxis new_up = default_up(loaded);
    const AxisTurn turn(up_vector(choice.frame.up), up_vector(choice.frame.front),
                        up_vector(new_up), up_vector(default_front(new_up)));
    if (!file.empty()) {
      const std::string bytes = turned(session, loaded, turn, stood.isIdentity(0.0));
      if (!is_already(file, bytes)) {  // an OBJ does not say who wrote it
        CommonFlags flags = session.flags;
        flags.inputs.clear();  // a model may be turned where it is: --force says so
        check_output(file, OutputKind::Shape, flags);
        write_output(file, bytes);
      }
      if (is_ply()) {
        note_lost_materials(session, loaded, choice);
      } else {
        note_what_stays_behind(loaded, choice);
      }
    }
    report(session, loaded, choice, turn, stood);
  }

 private:
  [[nodiscard]] bool is_ply() const { return suffix_of(file) == ".ply"; }

  [[nodiscard]] std::string turned(Session& session, const Model& loaded, const AxisTurn& turn,
                                   bool is_quarter_turn) const {
    const std::string own = "." + std::string(format_name(loaded));
    if (is_ply()) {
      TriMesh mesh = loaded.mesh;
      std::transform(mesh.positions.begin(), mesh.positions.end(), mesh.positions.begin(), turn);
      return ply_bytes(mesh, {}, loaded.vertex_colours, loaded.double_precision);
    }
    const bool in_place = loaded.format == ModelFormat::Obj || loaded.format == ModelFormat::Stl ||
                          loaded.format == ModelFormat::Gltf || loaded.format == ModelFormat::Glb;
    if (!is_quarter_turn) {
      throw CLI::ValidationError(
          "-o", "must end in .ply: the model is turned by other than quarter turns");
    }
    if (!in_place || suffix_of(file) != own) {
      throw CLI::ValidationError(
          "-o", in_place ? "must end in " + own + ", as the model is, or in .ply"
                         : "must end in .ply: of a " + own + ", nothing else is written");
    }
    if (model == "-") {
      throw IoError(model, "can be turned to a .ply only; name the file, or write a .ply");
    }
    const std::string bytes = read_text(model);
    if (loaded.format == ModelFormat::Gltf && !is_beside_model() && names_files(bytes)) {
      throw IoError(file, "must be beside the model, whose buffers and pictures it names");
    }
    return session.read([&] { return turned_bytes(bytes, model, loaded.format, turn); });
  }

  [[nodiscard]] bool is_beside_model() const {
    namespace fs = std::filesystem;
    std::error_code error;
    return fs::weakly_canonical(fs::absolute(file), error).parent_path() ==
           fs::weakly_canonical(fs::absolute(model), error).parent_path();
  }

  /// Whether a glTF, which was read before, has buffers or pictures that are not within itself.
  [[nodiscard]] static bool names_files(const std::string& gltf) {
    const batch::Json json = batch::parsed_json(gltf);
    for (const char* kind : {"buffers", "images"}) {
      for (const batch::Json& one : json.value(kind, batch::Json::array())) {
        const std::string uri = one.value("uri", "data:");
        if (!uri.starts_with("data:")) {
          return true;
        }
      }
    }
    return false;
  }

  /// Materials that a .ply has no place for: its vertices have colours alone.
  void note_lost_materials(Session& session, const Model& loaded, FrameChoice& choice) const {
    if (model == "-" || loaded.format == ModelFormat::Ply) {
      return;
    }
    // Of pictures only whether there are any.
    const Appearance lost = session.load(model, {.appearance = true, .texture_side = 1}).appearance;
    if (!lost.textures.empty() || (loaded.vertex_colours.empty() && !lost.materials.empty())) {
      choice.notes.push_back("the materials are not in " + file +
                             ": what vantage writes as .ply has colours of vertices alone");
    }
  }

  /// An OBJ without its materials is sound, but grey.
  void note_what_stays_behind(const Model& loaded, FrameChoice& choice) const {
    namespace fs = std::filesystem;
    if (loaded.format != ModelFormat::Obj || is_beside_model() || file == "-") {
      return;
    }
    FilesBeside beside(model);
    beside.pass(read_text(model));
    std::vector<FileBeside> files = beside.find();
    std::erase_if(files, [&](const FileBeside& f) {
      return f.path.empty() || fs::exists(fs::path(file).parent_path() / f.name);
    });
    if (!files.empty()) {
      choice.notes.push_back(
          "materials are in " + files.front().name +
          (files.size() > 1 ? " and " + plural(files.size() - 1, "more file") : "") +
          " beside the model; copy " + (files.size() > 1 ? "them" : "it") + " beside " + file);
    }
  }

  void report(Session& session, const Model& loaded, const FrameChoice& choice,
              const AxisTurn& turn, const Eigen::Matrix3d& stood) const {
    const std::array<double, 4> quarter = turn.quaternion();
    const Eigen::Quaterniond whole =
        Eigen::Quaterniond(quarter[3], quarter[0], quarter[1], quarter[2]) *
        Eigen::Quaterniond(stood);
    const std::array<double, 4> q{whole.x(), whole.y(), whole.z(), whole.w()};
    const bool is_none = turn.is_none() && stood.isIdentity(0.0);
    if (session.flags.json) {
      const Json json = {{"file", file.empty() ? Json(nullptr) : Json(file)},
                         {"up", choice_json(choice.orientation.up)},
                         {"front", choice_json(choice.orientation.front)},
                         {"rotation", q},
                         {"turned", !is_none},
                         {"warnings", choice.notes}};
      write_output("-", batch::json_text(json, 2) + "\n");
      return;
    }
    if (print) {
      session.tell(number_text(q[0]) + " " + number_text(q[1]) + " " + number_text(q[2]) + " " +
                   number_text(q[3]));
    } else {
      session.tell(printable(loaded.name) + ": " + frame_summary(choice) +
                   (is_none                  ? "; nothing to turn"
                    : file.empty()           ? ""
                    : !stood.isIdentity(0.0) ? "; turned"
                                             : "; " + turn_text(choice.frame, default_up(loaded))) +
                   (file.empty() ? "" : " → " + printable(file)));
    }
    std::vector<std::string> notes(choice.notes.size());
    std::transform(choice.notes.begin(), choice.notes.end(), notes.begin(), shortened);
    say_notes(session, print ? choice.notes : notes);
  }
};

}  // namespace

void add_orient_command(CLI::App& program, Session& session) {
  add_command<OrientCommand>(program, session, "orient",
                             "which way is up, which side is the front; turns a model so",
                             "Examples:\n"
                             "  vantage orient part.stl\n"
                             "  vantage orient scene.obj -o upright.obj\n"
                             "  vantage orient scene.obj -o turned.obj --up y --front=-z\n"
                             "  vantage orient part.stl --print");
}

}  // namespace vantage::cli
