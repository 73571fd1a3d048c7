// SPDX-License-Identifier: MIT
#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "vantage/core/error.h"

#include "io/model_builder.h"
#include "io/number_parsing.h"
#include "io/plate.h"
#include "io/readers.h"
#include "io/threemf_package.h"
#include "io/threemf_parts.h"

namespace vantage {
namespace {

constexpr const char* kRelationships = "_rels/.rels";
constexpr const char* kUsualRoot = "3d/3dmodel.model";

/// Larger relationships are none. [ours]
constexpr std::size_t kLargestRelationships = 1'000'000;

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
  PlateParts parts{};
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
PlateParts named_parts(PartsOfPackage package, const std::string& root) {
  PlateParts named;
  std::vector<std::string> waiting{root};
  const auto ask_for = [&](const std::vector<PlateUse>& uses) {
    for (const PlateUse& use : uses) {
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

/// Extensions that the file needs and nobody reads here, such as lattices of beams.
std::set<std::string> unread_extensions(const PlateParts& parts) {
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
  const PlateParts parts = named_parts(read_parts(bytes, root, builder), root);
  if (parts.find(root) == parts.end()) {
    builder.fail("names the part " + in_quotes(root) + ", which is not in the archive");
  }
  bool has_unread_materials = false;
  bool has_corner_colours = false;
  for (const auto& [part_name, part] : parts) {
    if (part.needs_double) {
      builder.coordinates_need_double();
    }
    has_unread_materials = has_unread_materials || part.has_unread_materials;
    has_corner_colours = has_corner_colours || part.has_corner_colours;
  }
  if (has_unread_materials && builder.keeps_appearance()) {
    builder.note("textures and mixed materials left out; colours are read");
  }
  if (has_corner_colours && builder.keeps_appearance()) {
    builder.note("colours of corners left out: a triangle has that of its first");
  }
  builder.limit_faces(surroundings.options.max_faces);
  PlateReader reader(parts, bytes.size(), builder);
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
