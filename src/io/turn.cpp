// SPDX-License-Identifier: MIT
#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "vantage/core/error.h"
#include "vantage/io/model.h"
#include "vantage/io/write.h"

#include "core/json_text.h"
#include "io/stl_layout.h"
#include "io/text_cursor.h"

namespace vantage {
namespace {

static_assert(std::endian::native == std::endian::little, "STL and GLB are little-endian");

bool is_space(char c) {
  return c == ' ' || c == '\t' || c == '\r';
}

/// Words of a line, as parts of it.
std::vector<std::string_view> words_of(std::string_view line) {
  std::vector<std::string_view> words;
  for (std::size_t i = 0; i < line.size();) {
    const auto end = static_cast<std::size_t>(
        std::find_if(line.begin() + static_cast<std::ptrdiff_t>(i), line.end(), is_space) -
        line.begin());
    if (end > i) {
      words.push_back(line.substr(i, end - i));
    }
    i = std::max(end, i + 1);
  }
  return words;
}

std::string negative_of(std::string_view number) {
  const std::string_view digits = number.substr(0, number.find_first_of("eE"));
  if (digits.find_first_of("123456789") == std::string_view::npos) {  // 0 has no sign
    return std::string(number.substr(number.starts_with('-') || number.starts_with('+') ? 1 : 0));
  }
  if (number.starts_with('-')) {
    return std::string(number.substr(1));
  }
  return "-" + std::string(number.substr(number.starts_with('+') ? 1 : 0));
}

/// A line whose words `first` to `first` + 2 are coordinates.
std::string turned_line(std::string_view line, const std::vector<std::string_view>& words,
                        std::size_t first, const AxisTurn& turn) {
  std::string result(line.substr(0, static_cast<std::size_t>(words[first].data() - line.data())));
  for (std::size_t i = 0; i < 3; ++i) {
    const std::string_view number = words[first + turn.from[i]];
    result += i == 0 ? "" : " ";
    result += turn.negated[i] ? negative_of(number) : std::string(number);
  }
  const std::string_view last = words[first + 2];
  result += line.substr(static_cast<std::size_t>(last.data() - line.data()) + last.size());
  return result;
}

/// Turns what follows the keywords of a text file's lines. \param place gives the index of the first
/// coordinate of a line's words, 0 if it has none.
template <class Place>
std::string turned_text(std::string_view bytes, std::string_view name, const AxisTurn& turn,
                        Place&& place) {
  std::string result;
  result.reserve(bytes.size() + bytes.size() / 16);
  std::size_t number = 0;
  while (!bytes.empty()) {
    const std::size_t end = std::min(bytes.find('\n'), bytes.size());
    const std::string_view line = bytes.substr(0, end);
    ++number;
    const std::vector<std::string_view> words = words_of(line);
    const std::size_t first = place(words);
    if (first == 0) {
      result += line;
    } else if (words.size() < first + 3 || words.back() == "\\") {
      throw FormatError(std::string(name), "line " + std::to_string(number),
                        "the coordinates do not all stand on one line, and so are not turned in "
                        "place; write a .ply");
    } else {
      result += turned_line(line, words, first, turn);
    }
    if (end < bytes.size()) {
      result += '\n';
    }
    bytes.remove_prefix(std::min(end + 1, bytes.size()));
  }
  return result;
}

/// Whether a file, read anew, has every vertex where the turn takes it.
bool is_turned(const Model& before, std::string_view turned, std::string_view name,
               const AxisTurn& turn) {
  try {
    const Model after = parse_model(turned, name);
    // Where corners lie on one line, polygons may be cut otherwise, but into as many triangles.
    return before.mesh.triangles.size() == after.mesh.triangles.size() &&
           std::equal(before.mesh.positions.begin(), before.mesh.positions.end(),
                      after.mesh.positions.begin(), after.mesh.positions.end(),
                      [&](const Vec3& a, const Vec3& b) { return turn(a) == b; });
  } catch (const FormatError&) {
    return false;
  }
}

/// \throw InvalidInput if lines are written as no line is here, and so were not turned.
void require_turned(std::string_view bytes, std::string_view turned, std::string_view name,
                    const AxisTurn& turn) {
  if (!is_turned(parse_model(bytes, name), turned, name, turn)) {
    throw InvalidInput(
        std::string(name) +
        ": its lines are written in a way that is not turned in place; write a .ply");
  }
}

std::string turned_obj(std::string_view bytes, std::string_view name, const AxisTurn& turn) {
  return turned_text(bytes, name, turn, [](const std::vector<std::string_view>& words) {
    constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
    std::string_view keyword = words.empty() ? std::string_view() : words[0];
    keyword.remove_prefix(keyword.starts_with(kByteOrderMark) ? kByteOrderMark.size() : 0);
    // A normal of fewer numbers is one for no reader, unless the next line has the rest.
    const bool is_short = keyword == "vn" && words.size() < 4 && !words.back().ends_with('\\');
    return (keyword == "v" || keyword == "vn") && !is_short ? std::size_t{1} : std::size_t{0};
  });
}

std::string turned_ascii_stl(std::string_view bytes, std::string_view name, const AxisTurn& turn) {
  return turned_text(bytes, name, turn, [](const std::vector<std::string_view>& words) {
    if (words.size() > 1 && equals_ignoring_case(words[0], "facet") &&
        equals_ignoring_case(words[1], "normal")) {
      return std::size_t{2};
    }
    return !words.empty() && equals_ignoring_case(words[0], "vertex") ? std::size_t{1}
                                                                      : std::size_t{0};
  });
}

std::string turned_binary_stl(std::string_view bytes, std::string_view name, const AxisTurn& turn) {
  if (bytes.size() < kStlPreamble || stl_triangle_count(bytes) > held_stl_triangles(bytes)) {
    throw FormatError(std::string(name), "byte 80", "the file is cut short");
  }
  std::string result(bytes);
  const std::size_t end = kStlPreamble + stl_triangles_to_read(bytes) * kStlTriangle;
  for (std::size_t triangle = kStlPreamble; triangle < end; triangle += kStlTriangle) {
    for (std::size_t point = 0; point < 4; ++point) {
      const std::size_t at = triangle + point * 3 * sizeof(float);
      std::array<float, 3> before{};
      std::array<float, 3> after{};
      std::memcpy(before.data(), bytes.data() + at, sizeof before);
      for (std::size_t i = 0; i < 3; ++i) {
        after[i] = turn.negated[i] ? -before[turn.from[i]] : before[turn.from[i]];
      }
      std::memcpy(result.data() + at, after.data(), sizeof after);
    }
  }
  return result;
}

/// Indices of the nodes that are nobody's child.
OrderedJson nodes_of_no_other(const OrderedJson& nodes) {
  std::set<OrderedJson> children;
  for (const OrderedJson& node : nodes) {
    if (node.is_object() && node.contains("children") && node["children"].is_array()) {
      children.insert(node["children"].begin(), node["children"].end());
    }
  }
  OrderedJson roots = OrderedJson::array();
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (!children.contains(i)) {
      roots.push_back(i);
    }
  }
  return roots;
}

std::string turned_gltf_text(std::string_view text, std::string_view name, const AxisTurn& turn,
                             int indent) {
  OrderedJson root = parsed_json(text);
  const auto fail = [&](const char* problem) {
    throw FormatError(std::string(name), "JSON", problem);
  };
  if (!root.is_object()) {
    fail("is not well formed");
  }
  const bool has_scenes = root.contains("scenes") && root["scenes"] != OrderedJson::array();
  if (!has_scenes && root.contains("nodes") && root["nodes"].is_array()) {
    root["scene"] = 0;  // of a file without scenes readers show all nodes
    root["scenes"] = {{{"nodes", nodes_of_no_other(root["nodes"])}}};
  }
  if (!root.contains("scenes") || !root["scenes"].is_array() || !root.contains("nodes") ||
      !root["nodes"].is_array()) {
    fail("has no scene to turn");
  }
  std::map<OrderedJson, std::size_t> turned;  // by the node of a scene, the one above it
  for (OrderedJson& scene : root["scenes"]) {
    if (!scene.is_object() || !scene.contains("nodes") || !scene["nodes"].is_array() ||
        scene["nodes"].empty()) {
      continue;
    }
    for (OrderedJson& node : scene["nodes"]) {  // one that several scenes show is turned once
      const auto known = turned.find(node);
      if (known == turned.end()) {
        root["nodes"].push_back({{"name", "upright"},
                                 {"rotation", turn.quaternion()},
                                 {"children", OrderedJson::array({node})}});
        turned.emplace(node, root["nodes"].size() - 1);
        node = root["nodes"].size() - 1;
      } else {
        node = known->second;
      }
    }
  }
  if (turned.empty()) {
    fail("has no scene to turn");
  }
  return json_text(root, indent);
}

std::string turned_glb(std::string_view bytes, std::string_view name, const AxisTurn& turn) {
  constexpr std::size_t kHeader = 12;
  constexpr std::size_t kChunkHeader = 8;
  std::uint32_t length = 0;
  if (bytes.size() >= kHeader + kChunkHeader) {
    std::uint32_t whole = 0;
    std::memcpy(&whole, bytes.data() + 8, sizeof whole);
    bytes = bytes.substr(0, std::max<std::size_t>(whole, kHeader + kChunkHeader));  // no part of it
    std::memcpy(&length, bytes.data() + kHeader, sizeof length);
  }
  const std::size_t start = kHeader + kChunkHeader;
  if (bytes.size() < start || length > bytes.size() - start) {
    throw FormatError(std::string(name), "byte 12", "the JSON chunk is cut short");
  }
  std::string text = turned_gltf_text(bytes.substr(start, length), name, turn, -1);
  text.resize((text.size() + 3) / 4 * 4, ' ');
  const auto text_size = static_cast<std::uint32_t>(text.size());
  std::string result(bytes.substr(0, start));
  std::memcpy(result.data() + kHeader, &text_size, sizeof text_size);
  result += text;
  result += bytes.substr(start + length);
  const auto whole = static_cast<std::uint32_t>(result.size());
  std::memcpy(result.data() + 8, &whole, sizeof whole);
  return result;
}

}  // namespace

AxisTurn::AxisTurn(const Vec3& up, const Vec3& front, const Vec3& new_up, const Vec3& new_front) {
  Eigen::Matrix3d before;
  Eigen::Matrix3d after;
  before << up, front, up.cross(front);
  after << new_up, new_front, new_up.cross(new_front);
  const Eigen::Matrix3d matrix = after * before.transpose();
  for (Eigen::Index i = 0; i < 3; ++i) {
    Eigen::Index source = 0;
    matrix.row(i).cwiseAbs().maxCoeff(&source);
    from[static_cast<std::size_t>(i)] = static_cast<std::size_t>(source);
    negated[static_cast<std::size_t>(i)] = matrix(i, source) < 0.0;
  }
}

bool AxisTurn::is_none() const {
  return from == std::array<std::size_t, 3>{0, 1, 2} &&
         negated == std::array<bool, 3>{false, false, false};
}

Vec3 AxisTurn::operator()(const Vec3& p) const {
  Vec3 result;
  for (std::size_t i = 0; i < 3; ++i) {
    const double value = p[static_cast<Eigen::Index>(from[i])];
    result[static_cast<Eigen::Index>(i)] = negated[i] ? -value : value;
  }
  return result;
}

std::array<double, 4> AxisTurn::quaternion() const {
  Eigen::Matrix3d matrix;
  matrix << (*this)(Vec3::UnitX()), (*this)(Vec3::UnitY()), (*this)(Vec3::UnitZ());
  const Eigen::Quaterniond q = Eigen::Quaterniond(matrix).normalized();
  return {q.x(), q.y(), q.z(), q.w()};
}

std::string turned_bytes(std::string_view bytes, std::string_view name, ModelFormat format,
                         const AxisTurn& turn) {
  if (format == ModelFormat::Obj || (format == ModelFormat::Stl && is_text_stl(bytes))) {
    std::string turned = format == ModelFormat::Obj ? turned_obj(bytes, name, turn)
                                                    : turned_ascii_stl(bytes, name, turn);
    require_turned(bytes, turned, name, turn);
    return turned;
  }
  switch (format) {
    case ModelFormat::Stl:
      return turned_binary_stl(bytes, name, turn);
    case ModelFormat::Gltf:
      return turned_gltf_text(bytes, name, turn, 2) + "\n";
    case ModelFormat::Glb:
      return turned_glb(bytes, name, turn);
    default:
      throw InvalidInput(std::string(name) +
                         " is of a format that is not turned in place; write a .ply");
  }
}

}  // namespace vantage
