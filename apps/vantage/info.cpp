// SPDX-License-Identifier: MIT
#include <algorithm>

#include "vantage/mesh/measures.h"
#include "vantage/mesh/mesh_check.h"
#include "vantage/pipeline/shape_analysis.h"

#include "batch/json_text.h"
#include "commands.h"
#include "method_flags.h"
#include "notes.h"
#include "output_file.h"
#include "terminal.h"

namespace vantage::cli {
namespace {

using batch::Json;

// Objects listed for people; --json lists more, but a soup has one for each face.
constexpr std::size_t kShownObjects = 12;
constexpr std::size_t kListedObjects = 1000;

Json point(const Vec3& p) {
  return Json::array({p.x(), p.y(), p.z()});
}

struct InfoCommand {
  std::string model{};

  void add_flags(CLI::App& app, Session& session) {
    app.add_option("MODEL", model, "file to read, or -")->required();
    add_common_flags(app, session.flags);
  }

  void run(Session& session) const {
    // Of pictures only whether they can be read.
    const Model loaded = session.load(model, {.appearance = true, .texture_side = 1});
    const RunContext run = session.run();
    const WeldedMesh welded = weld(loaded.mesh, run);
    const MeshReport as_read = check_mesh(loaded.mesh, run);
    const MeshReport check = check_mesh(welded.mesh, run);
    const std::vector<SceneObject> objects = loaded.mesh.triangles.empty()
                                                 ? std::vector<SceneObject>{}
                                                 : list_objects(loaded, welded_surface(welded));
    if (session.flags.json) {
      write_output("-", json(loaded, welded, as_read, check, objects));
    } else {
      print(session, loaded, welded, as_read, check);
      print_objects(session, objects);
      say_notes(session, loaded.notes);
    }
  }

 private:
  static std::string json(const Model& loaded, const WeldedMesh& welded, const MeshReport& as_read,
                          const MeshReport& check, const std::vector<SceneObject>& objects) {
    Json listed = Json::array();
    for (std::size_t i = 0; i < std::min(objects.size(), kListedObjects); ++i) {
      listed.push_back({{"index", i},
                        {"name", objects[i].name.empty() ? Json(nullptr) : Json(objects[i].name)},
                        {"faces", objects[i].faces}});
    }
    const Box box = bounding_box(loaded.mesh.positions);
    Json parts = Json::array();
    for (const ModelPart& part : loaded.parts) {
      parts.push_back({{"name", part.name}, {"faces", part.triangle_count}});
    }
    const Json json = {
        {"name", loaded.name},
        {"format", format_name(loaded)},
        {"vertices", as_read.vertices},
        {"polygons", loaded.polygons},
        {"quads", loaded.quads},
        {"larger_polygons", loaded.larger_polygons},
        {"skipped_faces", loaded.skipped_faces},
        {"faces", as_read.faces},
        {"vertex_colours", !loaded.vertex_colours.empty() && !loaded.colours_are_materials},
        {"materials", loaded.appearance.materials.size()},
        {"textures", loaded.appearance.textures.size()},
        {"double_precision", loaded.double_precision},
        {"parts", parts},
        {"objects", listed},
        {"object_count", objects.size()},
        {"box", {{"low", point(box.low)}, {"high", point(box.high)}}},
        {"diameter", enclosing_sphere(referenced_points(loaded.mesh)).diameter},
        {"area", surface_area(loaded.mesh)},
        {"volume", check.closed && check.oriented ? Json(check.signed_volume) : Json(nullptr)},
        {"duplicate_vertices", as_read.duplicate_vertices},
        {"isolated_vertices", as_read.isolated_vertices},
        {"repeated_index_faces", as_read.repeated_index_faces},
        {"up", up_name(default_up(loaded))},
        {"unit_m", loaded.unit_m > 0.0 ? Json(loaded.unit_m) : Json(nullptr)},
        {"welded",
         {{"vertices", check.vertices},
          {"faces", check.faces},
          {"components", check.components},
          {"closed", check.closed},
          {"oriented", check.oriented},
          {"genus", check.genus ? Json(*check.genus) : Json(nullptr)},
          {"dropped_faces", welded.dropped_faces},
          {"zero_area_faces", check.zero_area_faces},
          {"duplicate_faces", check.duplicate_faces},
          {"boundary_edges", check.boundary_edges},
          {"boundary_loops", check.boundary_loops},
          {"non_manifold_edges", check.non_manifold_edges},
          {"non_manifold_vertices", check.non_manifold_vertices},
          {"inconsistent_edges", check.inconsistent_edges}}},
        {"notes", loaded.notes}};
    return batch::json_text(json, 2) + "\n";
  }

  static void print(Session& session, const Model& loaded, const WeldedMesh& welded,
                    const MeshReport& as_read, const MeshReport& check) {
    const auto line = [&](const std::string& label, const std::string& text) {
      std::string padded = label;
      padded.resize(14, ' ');
      session.tell("  " + padded + text);
    };
    const Vec3 size = bounding_box(loaded.mesh.positions).size();
    session.tell(printable(loaded.name) + " (" + std::string(format_name(loaded)) + ")");
    line("vertices", grouped(as_read.vertices) +
                         (loaded.vertex_colours.empty()  ? ""
                          : loaded.colours_are_materials ? ", with colours of materials"
                                                         : ", with colours") +
                         (loaded.double_precision ? ", double precision" : ""));
    line("faces", polygons(loaded, as_read));
    if (loaded.parts.size() > 1) {
      line("parts", grouped(loaded.parts.size()));
    }
    if (!loaded.appearance.materials.empty()) {
      line("materials", grouped(loaded.appearance.materials.size()) +
                            (loaded.appearance.textures.empty()
                                 ? ""
                                 : ", " + plural(loaded.appearance.textures.size(), "texture")));
    }
    line("size", rounded(size.x()) + " × " + rounded(size.y()) + " × " + rounded(size.z()));
    if (loaded.unit_m > 0.0) {
      line("unit", rounded(loaded.unit_m) + " m");
    }
    if (as_read.faces > 0) {
      std::string shape = plural(check.components, "component") + ", ";
      shape += check.closed ? "closed" : "open";
      shape += check.genus ? ", genus " + std::to_string(*check.genus) : "";
      line("surface", shape);
      line("area", rounded(surface_area(loaded.mesh)));
      if (check.closed && check.oriented) {
        line("volume", rounded(check.signed_volume) +
                           (check.signed_volume < 0.0 ? " (wound inside out)" : ""));
      }
    }
    const std::vector<std::string> defects = defects_of(welded, as_read, check, loaded);
    line("defects", defects.empty() ? "none" : defects.front());
    for (std::size_t i = 1; i < defects.size(); ++i) {
      line("", defects[i]);
    }
  }

  /// As much of a shape as list_objects() looks at.
  static ShapeAnalysis welded_surface(const WeldedMesh& welded) {
    ShapeAnalysis shape;
    shape.surface = welded.mesh;
    shape.surface_vertex = welded.welded_of_vertex;
    return shape;
  }

  /// What --focus can name, if there is a choice.
  static void print_objects(Session& session, const std::vector<SceneObject>& objects) {
    if (objects.size() < 2) {
      return;
    }
    for (std::size_t i = 0; i < std::min(objects.size(), kShownObjects); ++i) {
      std::string number = std::to_string(i);
      number.insert(0, number.size() < 3 ? 3 - number.size() : 0, ' ');
      const std::string name = objects[i].name.empty() ? "" : "  " + printable(objects[i].name);
      std::string line = i == 0 ? "  objects     " : "              ";
      line.append(number).append("  ").append(plural(objects[i].faces, "face")).append(name);
      session.tell(line);
    }
    if (objects.size() > kShownObjects) {
      session.tell("              … " + grouped(objects.size() - kShownObjects) +
                   " more; --json lists them");
    }
  }

  static std::string polygons(const Model& loaded, const MeshReport& as_read) {
    if (as_read.faces == 0) {
      return "none: points only";
    }
    std::string text = plural(as_read.faces, "triangle");
    if (loaded.quads + loaded.larger_polygons > 0) {
      text += ", from " + plural(loaded.polygons, "polygon") + " (" + plural(loaded.quads, "quad") +
              ", " + grouped(loaded.larger_polygons) + " larger)";
    }
    return text;
  }

  static std::vector<std::string> defects_of(const WeldedMesh& welded, const MeshReport& as_read,
                                             const MeshReport& check, const Model& loaded) {
    struct Defect {
      std::size_t count;
      const char* noun;
      const char* rest;
    };

    const bool is_cloud = as_read.faces == 0;
    const Defect all[] = {
        {as_read.duplicate_vertices, "vertex",
         " at the position of an earlier one (welded for all work)"},
        {is_cloud ? 0 : as_read.isolated_vertices, "vertex", " belonging to no face"},
        {loaded.skipped_faces, "face", " with fewer than three corners, left out"},
        {welded.dropped_faces, "face", " naming one position twice"},
        {check.zero_area_faces, "face", " without area"},
        {check.duplicate_faces, "face", " standing there twice"},
        {check.boundary_loops, "open boundary", ""},
        {check.non_manifold_edges, "edge", " with three or more faces"},
        {check.non_manifold_vertices, "vertex", " where sheets touch"},
        {check.inconsistent_edges, "edge", " whose faces are wound against each other"}};
    std::vector<std::string> defects;
    for (const Defect& defect : all) {
      if (defect.count > 0) {
        defects.push_back(plural(defect.count, defect.noun) + defect.rest);
      }
    }
    if (check.closed && check.oriented && check.signed_volume < 0.0) {
      defects.emplace_back("the surface is wound inside out");
    }
    return defects;
  }
};

}  // namespace

void add_info_command(CLI::App& program, Session& session) {
  add_command<InfoCommand>(program, session, "info", "what a file holds and what is wrong with it",
                           "Examples:\n"
                           "  vantage info scan.ply\n"
                           "  vantage info scan.ply --json");
}

}  // namespace vantage::cli
