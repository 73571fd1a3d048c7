// SPDX-License-Identifier: MIT
#include "report/evaluation_manifest.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <string_view>
#include <utility>

#include "vantage/core/error.h"

#include "core/json_reader.h"
#include "io/files.h"

namespace vantage {
namespace {

namespace fs = std::filesystem;

class Manifest : private JsonReader {
 public:
  Manifest(const std::string& bytes, const fs::path& file)
      : JsonReader(bytes, file.string()), folder_(file.parent_path()) {}

  std::vector<RecordedModel> read() {
    allow_only(root(), {"models"}, "the manifest");
    if (!has(root(), "models") || !root()["models"].is_array() || root()["models"].empty()) {
      fail("has no list \"models\"");
    }
    std::vector<RecordedModel> records;
    for (const Json& entry : root()["models"]) {
      const std::string where = "models[" + std::to_string(records.size()) + "]";
      RecordedModel record = record_of(entry, where);
      for (const RecordedModel& other : records) {
        if (other.name == record.name) {
          fail(where + " is \"" + record.name + "\" again; put all about a model into one entry");
        }
      }
      records.push_back(std::move(record));
    }
    return records;
  }

 private:
  void allow_only(const Json& object, const std::vector<std::string_view>& names,
                  const std::string& where) const {
    if (!object.is_object()) {
      fail(where + " is not an object");
    }
    for (const auto& [name, value] : object.items()) {
      if (std::find(names.begin(), names.end(), name) == names.end()) {
        std::string problem = where;
        problem.append(" has an unknown member \"").append(name).append("\"");
        fail(problem);
      }
    }
  }

  [[nodiscard]] std::string text(const Json& value, const std::string& what) const {
    if (!value.is_string()) {
      fail(what + " is not a text");
    }
    return value.get<std::string>();
  }

  RecordedModel record_of(const Json& entry, const std::string& where) const {
    allow_only(entry, {"model", "up", "views", "mirror_planes", "gaze"}, where);
    if (!has(entry, "model")) {
      fail(where + " names no \"model\"");
    }
    RecordedModel record;
    const fs::path model = text(entry["model"], where + ".model");
    record.name = model.lexically_normal().generic_string();
    record.path = (folder_ / model).string();
    std::error_code error;
    if (!fs::is_regular_file(record.path, error)) {
      throw IoError(record.path, "is not there, but " + name() + " names it");
    }
    if (has(entry, "up")) {
      record.up = up_of(text(entry["up"], where + ".up"), where);
    }
    if (has(entry, "views")) {
      add_views(entry["views"], where + ".views", record);
    }
    if (has(entry, "mirror_planes")) {
      for (const Json& plane : list(entry["mirror_planes"], where + ".mirror_planes")) {
        record.planes.push_back({.normal = unit_vector(plane, where + ".mirror_planes")});
      }
    }
    if (has(entry, "gaze")) {
      record.gaze = gaze_of(entry["gaze"], where + ".gaze");
    }
    if (record.views.empty() && record.gaze.empty()) {
      fail(where + " has neither \"views\" nor \"gaze\"");
    }
    return record;
  }

  [[nodiscard]] const Json& list(const Json& value, const std::string& what) const {
    if (!value.is_array()) {
      fail(what + " is not a list");
    }
    return value;
  }

  [[nodiscard]] UpAxis up_of(const std::string& name, const std::string& where) const {
    constexpr std::array<UpAxis, 6> kAxes{UpAxis::X,      UpAxis::Y,      UpAxis::Z,
                                          UpAxis::MinusX, UpAxis::MinusY, UpAxis::MinusZ};
    for (const UpAxis axis : kAxes) {
      if (up_name(axis) == name) {
        return axis;
      }
    }
    fail(where + ".up is none of x, y, z, -x, -y, -z");
  }

  void add_views(const Json& views, const std::string& where, RecordedModel& record) const {
    for (const Json& view : list(views, where)) {
      allow_only(view, {"direction", "status", "subject"}, where);
      if (!has(view, "direction")) {
        fail(where + " has a view without \"direction\"");
      }
      const bool moved = !has(view, "status") || text(view["status"], where + ".status") == "moved";
      record.views.push_back({unit_vector(view["direction"], where + ".direction"), moved});
    }
  }

  [[nodiscard]] std::vector<double> gaze_of(const Json& gaze, const std::string& where) const {
    if (gaze.is_string()) {
      return read_gaze_values(folder_ / gaze.get<std::string>());
    }
    std::vector<double> values;
    for (const Json& value : list(gaze, where)) {
      if (!value.is_number()) {
        fail(where + " is neither a file nor a list of numbers");
      }
      values.push_back(value.get<double>());
    }
    return values;
  }

  fs::path folder_;
};

}  // namespace

std::vector<RecordedModel> read_manifest(const fs::path& file) {
  return Manifest(read_file(file.string()), file).read();
}

}  // namespace vantage
