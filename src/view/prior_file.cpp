// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <numbers>

#include "vantage/view/prior.h"

#include "core/json_reader.h"

namespace vantage {
namespace {

// More lobes than anybody writes by hand; each costs an exponential a direction.
constexpr std::size_t kMostLobes = 10000;
constexpr double kHighestLobe = 1e6;

class PriorReader : private JsonReader {
 public:
  using JsonReader::JsonReader;

  [[nodiscard]] ViewPrior read() const {
    if (!has(root(), "vantage_prior")) {
      fail("is no prior: expected an object with \"vantage_prior\": 1");
    }
    if (root().at("vantage_prior") != 1) {
      fail("has a vantage_prior other than 1, the only version there is");
    }
    refuse_others(root(), {"vantage_prior", "upright", "lobes"});
    ViewPrior prior;
    prior.name = name().substr(name().find_last_of('/') + 1);
    prior.is_uniform = false;
    prior.upright = {.elevation_sine = 0.0,
                     .elevation_strength = 0.0,
                     .corner_strength = 0.0,
                     .front_strength = 0.0,
                     .side_strength = 0.0};
    if (root().contains("upright")) {
      read_upright(root().at("upright"), prior.upright);
    }
    if (root().contains("lobes")) {
      read_lobes(root().at("lobes"), prior.lobes);
    }
    return prior;
  }

 private:
  void refuse_others(const Json& object, std::initializer_list<std::string_view> known) const {
    for (const auto& [member, value] : object.items()) {
      if (std::find(known.begin(), known.end(), member) == known.end()) {
        fail("has a member " + Json(member).dump(-1, ' ', true, Json::error_handler_t::replace) +
             " that priors do not have");
      }
    }
  }

  [[nodiscard]] double number(const Json& value, const std::string& what, double low,
                              double high) const {
    const double read = value.is_number() ? value.get<double>() : std::nan("");
    if (!(read >= low && read <= high)) {
      fail(what + " is not a number between " + Json(low).dump() + " and " + Json(high).dump());
    }
    return read;
  }

  void read_upright(const Json& object, UprightPrior& upright) const {
    if (!object.is_object()) {
      fail("upright is not an object");
    }
    refuse_others(object, {"elevation_sine", "elevation_strength", "corner_strength",
                           "front_strength", "side_strength"});
    for_each_field(kUprightPriorFields, [&](const auto& field) {
      const std::string member(field.name);
      if (object.contains(member)) {
        upright.*(field.member) =
            number(object.at(member), "upright." + member, field.low, field.high);
      }
    });
  }

  void read_lobes(const Json& list, std::vector<PriorLobe>& lobes) const {
    if (!list.is_array() || list.size() > kMostLobes) {
      fail("lobes is not a list of at most " + std::to_string(kMostLobes) + " objects");
    }
    for (std::size_t i = 0; i < list.size(); ++i) {
      lobes.push_back(lobe(list[i], "lobes[" + std::to_string(i) + "]"));
    }
  }

  [[nodiscard]] PriorLobe lobe(const Json& object, const std::string& what) const {
    if (!has(object, "direction")) {
      fail(what + " is not an object with a direction");
    }
    refuse_others(object, {"direction", "weight", "width_deg"});
    PriorLobe result;
    result.direction = unit_vector(object.at("direction"), what + ".direction");
    if (object.contains("weight")) {
      result.weight = number(object.at("weight"), what + ".weight", 0.0, kHighestLobe);
    }
    if (object.contains("width_deg")) {
      result.width_rad = number(object.at("width_deg"), what + ".width_deg", 1.0, 180.0) *
                         std::numbers::pi / 180.0;
    }
    return result;
  }
};

}  // namespace

ViewPrior parse_prior(std::string_view bytes, std::string_view name) {
  return PriorReader(bytes, name).read();
}

}  // namespace vantage
