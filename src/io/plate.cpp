// SPDX-License-Identifier: MIT
#include "io/plate.h"

#include <algorithm>
#include <set>

#include "io/number_parsing.h"
#include "io/readers.h"
#include "io/reuse_budget.h"

namespace vantage {

std::vector<PlateUse> uses_of_wholes(const PlatePart& part) {
  std::map<std::uint32_t, std::vector<std::uint32_t>> components;  // of the part itself
  std::set<std::uint32_t> held;
  for (const auto& [id, object] : part.objects) {
    for (const PlateUse& use : object.components) {
      if (use.part.empty()) {
        components[id].push_back(use.object);
        held.insert(use.object);
      }
    }
  }
  std::vector<PlateUse> uses;
  std::set<std::uint32_t> reached;
  const auto add = [&](std::uint32_t whole) {
    uses.push_back({{}, whole, unmoved()});
    std::vector<std::uint32_t> waiting{whole};
    while (!waiting.empty()) {
      const std::uint32_t id = waiting.back();
      waiting.pop_back();
      if (reached.insert(id).second) {
        const std::vector<std::uint32_t>& below = components[id];
        waiting.insert(waiting.end(), below.begin(), below.end());
      }
    }
  };
  for (const auto& [id, object] : part.objects) {
    if (!held.contains(id)) {
      add(id);
    }
  }
  for (const auto& [id, object] : part.objects) {
    if (!reached.contains(id)) {
      add(id);
    }
  }
  return uses;
}

PlateReader::PlateReader(const PlateParts& parts, std::size_t file_bytes, ModelBuilder& builder)
    : parts_(parts), builder_(builder), file_bytes_(file_bytes) {
  std::uint32_t first = 0;
  for (const auto& [name, part] : parts) {
    objects_ += part.objects.size();
    first_material_[name] = first;
    first += static_cast<std::uint32_t>(part.materials.size());
  }
}

void PlateReader::read(const std::string& root) {
  const PlatePart& part = parts_.at(root);
  std::vector<PlateUse> each;
  if (part.items.empty()) {
    builder_.note("nothing is to be built: each object of the file is shown once");
    each = uses_of_wholes(part);
  }
  const std::span<const PlateUse> uses = part.items.empty() ? each : part.items;
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
  const auto other = std::find_if(parts_.begin(), parts_.end(), [&](const auto& entry) {
    return entry.second.unit != part.unit;
  });
  if (other != parts_.end()) {
    builder_.note("part " + in_quotes(other->first) + " has the unit " +
                  in_quotes(other->second.unit) + ", the model " + in_quotes(part.unit) +
                  "; coordinates are put side by side as they stand there");
  }
}

std::vector<Material> PlateReader::materials() const {
  std::vector<Material> all;
  for (const auto& [name, part] : parts_) {
    all.insert(all.end(), part.materials.begin(), part.materials.end());
  }
  return all;
}

void PlateReader::walk(std::span<const PlateUse> uses, const std::string& root) {
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
    const PlateUse& use = level.uses[level.next++];
    Eigen::Affine3d inner = Eigen::Affine3d::Identity();
    inner.affine() = use.transform.transpose();
    const Visit visit{use.part.empty() ? level.part : use.part, use.object, level.outer * inner};
    read_object(visit, levels);
  }
}

void PlateReader::spend(std::size_t amount) {
  if (amount > budget_) {
    builder_.fail("shows its objects so often that the model is out of proportion to the file");
  }
  budget_ -= amount;
}

const PlateObject& PlateReader::object_of(const Visit& visit) const {
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

void PlateReader::read_object(const Visit& visit, std::vector<Level>& levels) {
  const PlateObject& object = object_of(visit);
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

/// Where one object has colours the others are white.
void PlateReader::add_points(const PlateObject& object, const Eigen::Affine3d& transform) {
  for (const Vec3& point : object.points) {
    builder_.add_point(transform * point, {"vertex", builder_.point_count()});
    builder_.advance(1, 1);
  }
  if (object.colours.empty() && builder_.colour_count() == 0) {
    return;
  }
  while (builder_.colour_count() + object.colours.size() < builder_.point_count()) {
    builder_.add_colour(1.0, 1.0, 1.0);
  }
  for (const auto& [red, green, blue] : object.colours) {
    builder_.add_colour(static_cast<double>(red), static_cast<double>(green),
                        static_cast<double>(blue));
  }
}

void PlateReader::add_mesh(const PlateObject& object, const Visit& visit) {
  if (object.points.empty()) {
    return;
  }
  spend(object.points.size() + object.triangles.size() * 3 + object.name.size());
  if (is_counting_) {
    faces_ += object.triangles.size();
    points_ += object.points.size();
    builder_.check_counts(faces_, points_);
    return;
  }
  builder_.begin_part(object.name);
  const std::size_t first = builder_.point_count();
  add_points(object, visit.transform);
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

}  // namespace vantage
