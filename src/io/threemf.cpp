// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "vantage/core/error.h"

#include "io/model_builder.h"
#include "io/number_parsing.h"
#include "io/readers.h"
#include "io/reuse_budget.h"
#include "io/threemf_package.h"
#include "io/threemf_parts.h"

namespace vantage {
namespace {

constexpr const char* kRelationships = "_rels/.rels";
constexpr const char* kUsualRoot = "3d/3dmodel.model";

/// Objects, items, components and colours that may be read, and one for each byte of the file: each is
/// kept, and takes more than its text. [ours]
constexpr std::size_t kMostRecordsOfSmallFile = 100'000;
/// Larger relationships are none. [ours]
constexpr std::size_t kLargestRelationships = 1'000'000;

using Parts = std::map<std::string, ThreemfPart, std::less<>>;

/// The name of the part to begin with.
std::string root_of(std::string_view bytes, const ModelBuilder& builder) {
  std::string relationships;
  std::string first;
  bool has_usual = false;
  const PartSink sink{[&](const std::string& name) {
                        const bool is_model = name.ends_with(".model");
                        first = is_model && first.empty() ? name : first;
                        has_usual = has_usual || name == kUsualRoot;
                        return name == kRelationships;
                      },
                      [&](std::string_view piece) {
                        if (relationships.size() < kLargestRelationships) {
                          relationships += piece;
                        }
                      },
                      [] {}};
  read_package(bytes, sink, builder);
  std::string root = threemf_root(relationships);
  if (root.empty()) {
    root = has_usual ? kUsualRoot : first;
  }
  if (root.empty()) {
    builder.fail("the archive holds no 3D model; is it a 3MF file?");
  }
  return root;
}

/// The parts that are models; those that cannot be read matter only if they are named.
struct PartsOfPackage {
  Parts parts{};
  std::map<std::string, FormatError, std::less<>> broken{};
};

PartsOfPackage read_parts(std::string_view bytes, const std::string& root, ModelBuilder& builder) {
  PartsOfPackage package;
  std::string name;
  std::optional<ThreemfPartReader> reader;
  std::size_t records_left = kMostRecordsOfSmallFile + bytes.size();
  const auto attempt = [&](const auto& step) {
    try {
      if (reader) {
        step();
      }
    } catch (const FormatError& error) {
      package.broken.try_emplace(name, error);
      reader.reset();  // the rest of it is passed over
    }
  };
  const PartSink sink{[&](const std::string& part) {
                        name = part;
                        const bool is_wanted = part == root || part.ends_with(".model");
                        if (is_wanted) {
                          reader.emplace(part, builder, records_left);
                        }
                        return is_wanted;
                      },
                      [&](std::string_view piece) {
                        builder.advance(0, 1);
                        attempt([&] { reader->add(piece); });
                      },
                      [&] { attempt([&] { package.parts[name] = reader->finish(); }); }};
  read_package(bytes, sink, builder);
  return package;
}

/// The root and the parts that it names, and so on: others, such as what a Mac adds to archives, change nothing.
/// \throw FormatError of one of these that is broken
Parts named_parts(PartsOfPackage package, const std::string& root) {
  Parts named;
  std::vector<std::string> waiting{root};
  const auto ask_for = [&](const std::vector<ThreemfUse>& uses) {
    for (const ThreemfUse& use : uses) {
      if (!use.part.empty()) {
        waiting.push_back(use.part);
      }
    }
  };
  while (!waiting.empty()) {
    const std::string name = std::move(waiting.back());
    waiting.pop_back();
    if (const auto broken = package.broken.find(name); broken != package.broken.end()) {
      throw FormatError(broken->second);
    }
    auto part = package.parts.extract(name);
    if (part.empty()) {
      continue;  // known, or complained of where it is shown
    }
    ask_for(part.mapped().items);
    for (const auto& [id, object] : part.mapped().objects) {
      ask_for(object.components);
    }
    named.insert(std::move(part));
  }
  return named;
}

/// Each object of a part that is no component of another there; all of them where none is left, so that
/// objects that hold each other are refused as ever.
std::vector<ThreemfUse> uses_of_wholes(const ThreemfPart& part) {
  std::set<std::uint32_t> components;
  for (const auto& [id, object] : part.objects) {
    for (const ThreemfUse& use : object.components) {
      if (use.part.empty()) {
        components.insert(use.object);
      }
    }
  }
  const bool is_any_whole =
      std::any_of(part.objects.begin(), part.objects.end(),
                  [&](const auto& entry) { return !components.contains(entry.first); });
  std::vector<ThreemfUse> uses;
  for (const auto& [id, object] : part.objects) {
    if (!is_any_whole || !components.contains(id)) {
      uses.push_back({{}, id, unmoved()});
    }
  }
  return uses;
}

/// Puts the items of the build plate where they stand.
class PlateReader {
 public:
  /// \param most_faces that may be shown together; 0: any number.
  PlateReader(const Parts& parts, std::size_t file_bytes, std::size_t most_faces,
              ModelBuilder& builder)
      : parts_(parts), builder_(builder), file_bytes_(file_bytes), most_faces_(most_faces) {
    std::uint32_t first = 0;
    for (const auto& [name, part] : parts) {
      objects_ += part.objects.size();
      first_material_[name] = first;
      first += static_cast<std::uint32_t>(part.materials.size());
    }
  }

  void read(const std::string& root) {
    const ThreemfPart& part = parts_.at(root);
    std::vector<ThreemfUse> each;
    if (part.items.empty()) {
      builder_.note("nothing is to be built: each object of the file is shown once");
      each = uses_of_wholes(part);
    }
    const std::span<const ThreemfUse> uses = part.items.empty() ? each : part.items;
    is_counting_ = true;  // before anything is made
    walk(uses, root);
    is_counting_ = false;
    left_out_ = 0;
    walk(uses, root);
    if (left_out_ > 0) {
      builder_.note("objects that only support others left out: " + std::to_string(left_out_));
    }
    if (part.unprinted > 0) {
      builder_.note("items that are not to be printed are shown too: " +
                    std::to_string(part.unprinted));
    }
    if (part.unit != "millimeter") {
      builder_.note("the file's unit is the " + in_quotes(part.unit) +
                    "; coordinates are in that unit, as they stand there");
    }
  }

  [[nodiscard]] bool shows_triangles() const { return faces_ > 0; }

  [[nodiscard]] std::vector<Material> materials() const {
    std::vector<Material> all;
    for (const auto& [name, part] : parts_) {
      all.insert(all.end(), part.materials.begin(), part.materials.end());
    }
    return all;
  }

 private:
  /// Goes to every object that is shown.
  void walk(std::span<const ThreemfUse> uses, const std::string& root) {
    budget_ = kMostInSmallFile + kMostPerByte * file_bytes_;
    visits_left_ = budget_;  // objects may be visited as often [ours]
    std::vector<Level> levels;
    levels.push_back({uses, root, Eigen::Affine3d::Identity()});
    while (!levels.empty()) {
      Level& level = levels.back();
      if (level.next == level.uses.size()) {
        levels.pop_back();
        continue;
      }
      const ThreemfUse& use = level.uses[level.next++];
      Eigen::Affine3d inner = Eigen::Affine3d::Identity();
      inner.affine() = use.transform.transpose();
      const Visit visit{use.part.empty() ? level.part : use.part, use.object, level.outer * inner};
      read_object(visit, levels);
    }
  }

  /// Objects shown together, and which of them is next. A stack of these is no deeper than the file has
  /// objects, however often they show each other.
  struct Level {
    std::span<const ThreemfUse> uses;
    std::string_view part;
    Eigen::Affine3d outer;
    std::size_t next = 0;
  };

  struct Visit {
    std::string_view part;
    std::uint32_t object;
    Eigen::Affine3d transform;
  };

  void spend(std::size_t amount) {
    if (amount > budget_) {
      builder_.fail("shows its objects so often that the model is out of proportion to the file");
    }
    budget_ -= amount;
  }

  [[nodiscard]] const ThreemfObject& object_of(const Visit& visit) const {
    const auto part = parts_.find(visit.part);
    if (part == parts_.end()) {
      builder_.fail("names the part " + in_quotes(visit.part) + ", which is not in the archive");
    }
    const auto object = part->second.objects.find(visit.object);
    if (object == part->second.objects.end()) {
      builder_.fail("shows object " + std::to_string(visit.object) + " of part " +
                    in_quotes(visit.part) + ", which does not exist");
    }
    return object->second;
  }

  void read_object(const Visit& visit, std::vector<Level>& levels) {
    const ThreemfObject& object = object_of(visit);
    if (levels.size() > objects_) {
      builder_.fail("object " + std::to_string(visit.object) + " is a component of itself");
    }
    if (visits_left_-- == 0) {
      builder_.fail("shows its objects so often that the model is out of proportion to the file");
    }
    builder_.run().check();
    // Of an object with components the type is ignored (3MF core, chapter 4).
    if (!object.is_model && object.components.empty()) {
      ++left_out_;
      return;
    }
    add_mesh(object, visit);
    levels.push_back({object.components, visit.part, visit.transform});
  }

  void add_mesh(const ThreemfObject& object, const Visit& visit) {
    if (object.points.empty()) {
      return;
    }
    spend(object.points.size() + object.triangles.size() * 3 + object.name.size());
    if (is_counting_) {
      faces_ += object.triangles.size();
      if (most_faces_ > 0 && faces_ > most_faces_) {
        builder_.fail(too_many_faces(most_faces_));
      }
      return;
    }
    builder_.begin_part(object.name);
    const std::size_t first = builder_.point_count();
    for (const Vec3& point : object.points) {
      builder_.add_point(visit.transform * point, {"vertex", builder_.point_count()});
      builder_.advance(1, 1);
    }
    // A reflection turns the surface inside out, which is taken back.
    const bool is_mirrored = visit.transform.linear().determinant() < 0.0;
    for (std::size_t t = 0; t < object.triangles.size(); ++t) {
      const auto& [a, b, c] = object.triangles[t];
      if (builder_.keeps_appearance()) {
        const std::uint32_t material = object.materials[t];
        builder_.begin_material(material == Appearance::kNone
                                    ? material
                                    : material + first_material_.find(visit.part)->second);
      }
      builder_.add_triangle(first + a, first + (is_mirrored ? c : b), first + (is_mirrored ? b : c),
                            {"vertex", first});
    }
  }

  const Parts& parts_;
  ModelBuilder& builder_;
  std::size_t file_bytes_;
  std::size_t most_faces_;
  bool is_counting_ = false;
  std::size_t faces_ = 0;  // counted
  std::size_t budget_ = 0;
  std::size_t visits_left_ = 0;
  std::size_t objects_ = 0;
  std::size_t left_out_ = 0;
  std::map<std::string, std::uint32_t, std::less<>> first_material_{};
};

/// Extensions that the file needs and nobody reads here, such as lattices of beams.
std::set<std::string> unread_extensions(const Parts& parts) {
  std::set<std::string> unread;
  for (const auto& [name, part] : parts) {
    unread.insert(part.unread_extensions.begin(), part.unread_extensions.end());
  }
  return unread;
}

}  // namespace

Model parse_threemf(std::string_view bytes, std::string_view name, const RunContext& run,
                    const Surroundings& surroundings) {
  ModelBuilder builder(ModelFormat::Threemf, name, run, 0);
  if (surroundings.options.appearance) {
    builder.keep_appearance(/*of_vertices=*/false);
  }
  const std::string root = root_of(bytes, builder);
  const Parts parts = named_parts(read_parts(bytes, root, builder), root);
  if (parts.find(root) == parts.end()) {
    builder.fail("names the part " + in_quotes(root) + ", which is not in the archive");
  }
  bool has_unread_materials = false;
  for (const auto& [part_name, part] : parts) {
    if (part.needs_double) {
      builder.coordinates_need_double();
    }
    has_unread_materials = has_unread_materials || part.has_unread_materials;
  }
  if (has_unread_materials && builder.keeps_appearance()) {
    builder.note("textures and mixed materials left out; colours are read");
  }
  PlateReader reader(parts, bytes.size(), surroundings.options.max_faces, builder);
  reader.read(root);
  for (const std::string& extension : unread_extensions(parts)) {
    if (!reader.shows_triangles()) {
      builder.fail("has no triangles but for what the extension " + in_quotes(extension) +
                   " makes, which is not read; save it as a mesh");
    }
    builder.note("needs the extension " + in_quotes(extension) +
                 ", which is not read: what it adds is not shown");
  }
  if (builder.keeps_appearance()) {
    builder.set_materials(reader.materials(), {});
  }
  return builder.finish();
}

}  // namespace vantage
