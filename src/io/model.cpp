// SPDX-License-Identifier: MIT
#include "vantage/io/model.h"

#include <cerrno>
#include <filesystem>
#include <map>
#include <memory>
#include <new>
#include <system_error>

#include "vantage/core/error.h"

#include "io/files.h"
#include "io/model_format.h"
#include "io/readers.h"
#include "io/side_files.h"

namespace vantage {
namespace {

namespace fs = std::filesystem;

Model parse_with(std::string_view bytes, std::string_view name, const RunContext& run,
                 const Surroundings& surroundings) {
  run.advance("read", 0.0);
  const DetectedFormat detected =
      detect_format(bytes, name, static_cast<bool>(surroundings.options.importer));
  Model model = [&] {
    switch (detected.format) {
      case ModelFormat::Obj:
        return parse_obj(bytes, name, run, surroundings);
      case ModelFormat::Off:
        return parse_off(bytes, name, run, surroundings);
      case ModelFormat::Ply:
        return parse_ply(bytes, name, run, surroundings);
      case ModelFormat::Stl:
        return parse_stl(bytes, name, run, surroundings);
      case ModelFormat::Xyz:
      case ModelFormat::Pts:
      case ModelFormat::Pwn:
        return parse_point_list(bytes, name, detected.format, run);
      case ModelFormat::Pcd:
        return parse_pcd(bytes, name, run, surroundings.options.max_faces);
      case ModelFormat::Threemf:
        return parse_threemf(bytes, name, run, surroundings);
      case ModelFormat::Amf:
        return parse_amf(bytes, name, run, surroundings);
      case ModelFormat::Imported:
        return parse_import_stream(
            surroundings.options.importer({*detected.import_as, bytes, name}, run),
            *detected.import_as, name, run, surroundings);
      case ModelFormat::Gltf:
      case ModelFormat::Glb:
        break;
    }
    return parse_gltf(bytes, name, run, surroundings);
  }();
  const std::size_t most = surroundings.options.max_faces;
  const std::size_t faces = model.mesh.triangles.size();
  const std::size_t points = model.mesh.positions.size();
  if (is_beyond_limit(faces > 0 ? faces : points, points, most)) {
    throw FormatError(name, "", too_many_faces(most, faces <= most));
  }
  model.format = detected.format;
  model.imported_as = detected.import_as == nullptr ? "" : detected.import_as->name;
  model.name = model_name(name);
  if (!detected.note.empty()) {
    model.notes.insert(model.notes.begin(), detected.note);
  }
  if (surroundings.options.appearance && make_visible(model.appearance)) {
    model.notes.emplace_back(kMadeOpaque);
  }
  return model;
}

/// Buffers that were read, by where they are.
using KnownBuffers = std::map<fs::path, SharedBytes>;

/// The buffer `relative` below the folder of `model_path`; a file is read once.
SharedBytes read_beside(const std::string& model_path, const std::string& relative,
                        FolderNames& folders, KnownBuffers& known) {
  std::error_code error;
  const fs::path wanted = place_beside(model_path, relative, folders, error);
  if (error) {
    throw IoError(model_path, "names the buffer " + relative + ", which cannot be opened",
                  error.value());
  }
  if (wanted.empty()) {
    throw FormatError(model_path, "",
                      "names the buffer " + relative + ", which lies outside the model's folder");
  }
  SharedBytes& bytes = known[wanted];
  if (!bytes) {
    bytes = std::make_shared<const std::string>(read_file(wanted.string()));
  }
  return bytes;
}

}  // namespace

Model parse_model(std::string_view bytes, std::string_view name, const RunContext& run,
                  const ReadOptions& options) {
  return parse_with(bytes, name, run, {{}, {}, options});
}

Model load_model(const std::string& path, const RunContext& run, const ReadOptions& options) {
  try {
    const std::string bytes = read_file(path);
    if (path == "-") {
      Model model = parse_with(bytes, "standard input", run, {{}, {}, options});
      model.name = "stdin";
      return model;
    }
    KnownBuffers known;
    FolderNames folders;
    const Surroundings surroundings{
        [&](const std::string& relative) { return read_beside(path, relative, folders, known); },
        [&](const std::string& relative) { return side_file(path, relative, folders); }, options,
        side_file_check(path, folders)};
    Model model = parse_with(bytes, path, run, surroundings);
    model.file_name = fs::path(path).filename().string();
    return model;
  } catch (const std::bad_alloc&) {
    throw IoError(path, "does not fit into memory", ENOMEM);
  }
}

}  // namespace vantage
