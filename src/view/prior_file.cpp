// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <numbers>

#include <nlohmann/json.hpp>

#include "vantage/core/error.h"
#include "vantage/view/prior.h"

namespace vantage {
namespace {

using Json = nlohmann::json;

// More lobes than anybody writes by hand; each costs an exponential a direction.
constexpr std::size_t kMostLobes = 10000;
constexpr double kHighestLobe = 1e6;

class PriorReader {
 public:
  PriorReader(std::string_view bytes, std::string_view name) : name_(name) {
    root_ = Json::parse(bytes.begin(), bytes.end(), nullptr, false);
    if (root_.is_discarded()) {
      fail("is not well formed JSON");
    }
  }

  [[nodiscard]] ViewPrior read() const {
    if (!root_.is_object() || !root_.contains("vantage_prior")) {
      fail("is no prior: expected an object with \"vantage_prior\": 1");
    }
    if (root_.at("vantage_prior") != 1) {
      fail("has a vantage_prior other than 1, the only version there is");
    }
    refuse_others(root_, {"vantage_prior", "upright", "lobes"});
    ViewPrior prior;
    prior.name = std::string(name_.substr(name_.find_last_of('/') + 1));
    prior.is_uniform = false;
    prior.upright = {.elevation_sine = 0.0,
                     .elevation_strength = 0.0,
                     .corner_strength = 0.0,
                     .front_strength = 0.0,
                     .side_strength = 0.0};
    if (root_.contains("upright")) {
      read_upright(root_.at("upright"), prior.upright);
    }
    if (root_.contains("lobes")) {
      read_lobes(root_.at("lobes"), prior.lobes);
    }
    return prior;
  }

 private:
  [[noreturn]] void fail(const std::string& problem) const {
    throw FormatError(name_, "", problem);
  }

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
    if (!object.is_object() || !object.contains("direction")) {
      fail(what + " is not an object with a direction");
    }
    refuse_others(object, {"direction", "weight", "width_deg"});
    PriorLobe result;
    const Json& direction = object.at("direction");
    if (!direction.is_array() || direction.size() != 3) {
      fail(what + ".direction is not a list of 3 numbers");
    }
    for (std::size_t axis = 0; axis < 3; ++axis) {
      result.direction[static_cast<Eigen::Index>(axis)] =
          number(direction[axis], what + ".direction", -1e100, 1e100);
    }
    const double length = result.direction.stableNorm();
    if (!(length > 0.0)) {
      fail(what + ".direction must not be zero");
    }
    result.direction /= length;
    if (object.contains("weight")) {
      result.weight = number(object.at("weight"), what + ".weight", 0.0, kHighestLobe);
    }
    if (object.contains("width_deg")) {
      result.width_rad = number(object.at("width_deg"), what + ".width_deg", 1.0, 180.0) *
                         std::numbers::pi / 180.0;
    }
    return result;
  }

  std::string_view name_;
  Json root_{};
};

}  // namespace

ViewPrior parse_prior(std::string_view bytes, std::string_view name) {
  return PriorReader(bytes, name).read();
}

}  // namespace vantage
