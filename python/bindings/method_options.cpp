// SPDX-License-Identifier: MIT
#include "option_makers.h"

namespace vantage::python {
namespace {

void add_map_options(std::vector<Option>& table) {
  const std::string group(kMapGroup);
  table.push_back(
      {.name = "focus",
       .group = group,
       .type = "str",
       .help = "only the significance of this object counts, the others still hide it: its name "
               "or number",
       .set = [](Settings& s,
                 const py::object& given) { s.view.focus = py::str(given).cast<std::string>(); },
       .value =
           [](const Settings& s) {
             return s.view.focus.empty() ? py::object(py::none()) : py::cast(s.view.focus);
           }});
  table.push_back(word_option(
      "weight", group,
      "what counts: vertices, or the surface they stand for, however it is cut into faces",
      {"vertex", "area"},
      [](Settings& s, std::size_t i) {
        s.view.weight = i == 1 ? Weight::Area : Weight::Vertex;
        s.view.kssm.area_weighted_mean = i == 1;
      },
      [](const Settings& s) { return s.view.weight; }));
  table.push_back(word_option(
      "suppression", group, "what lowers the share of an even level: its mean, or its local maxima",
      {"mean", "local-maxima"},
      [](Settings& s, std::size_t i) { s.view.kssm.suppression = static_cast<Suppression>(i); },
      [](const Settings& s) { return s.view.kssm.suppression; }));
  table.push_back(word_option(
      "kinematics", group, "what is summed: the distance to the skeleton, or its change a step",
      {"displacement", "velocity"},
      [](Settings& s, std::size_t i) { s.view.kssm.kinematics = static_cast<Kinematics>(i); },
      [](const Settings& s) { return s.view.kssm.kinematics; }));
  table.push_back(word_option(
      "graph", group, "skeleton that distances are taken to: before or after centring and pruning",
      {"raw", "finished"},
      [](Settings& s, std::size_t i) { s.view.kssm_to_finished_graph = i == 1; },
      [](const Settings& s) { return s.view.kssm_to_finished_graph; }));
  add_fields(
      table, group, kKssmFields, [](Settings & s) -> auto& { return s.view.kssm; });
}

void add_saliency_options(std::vector<Option>& table) {
  const std::string group = "saliency";
  add_fields(
      table, group, kMeshSaliencyFields, [](Settings & s) -> auto& { return s.view.saliency; });
  table.push_back(switch_option(
      "signed", group, "mesh saliency keeps the sign of the mean curvature",
      [](Settings & s) -> auto& { return s.view.saliency.signed_curvature; }));
  table.push_back(word_option(
      "kernel_weight", group,
      "what the Gaussian means of mesh saliency count: vertices, or the area they stand for",
      {"vertex", "area"}, [](Settings& s, std::size_t i) { s.view.saliency.area_kernel = i == 1; },
      [](const Settings& s) { return s.view.saliency.area_kernel; }));
}

}  // namespace

void add_method_options(std::vector<Option>& table) {
  const std::string group(kMethodGroup);
  table.push_back(word_option(
      "contraction", group,
      "how the surface is contracted: large components by a decimated proxy, or all exactly",
      {"auto", "exact"},
      [](Settings& s, std::size_t i) {
        s.view.contraction.method = static_cast<ContractionMethod>(i);
      },
      [](const Settings& s) { return s.view.contraction.method; }));
  add_fields(
      table, group, kContractionFields, [](Settings & s) -> auto& { return s.view.contraction; });
  add_fields(
      table, group, kSkeletonFields, [](Settings & s) -> auto& { return s.view.skeleton; });
  table.push_back(switch_option(
      "prune", group, "cut ends of the skeleton shorter than the local thickness",
      [](Settings & s) -> auto& { return s.view.skeleton.prune; }));
  table.push_back(switch_option(
      "centre", group, "move skeleton nodes to the middle of what they stand for",
      [](Settings & s) -> auto& { return s.view.skeleton.centre; }));
  add_map_options(table);
  add_saliency_options(table);
}

}  // namespace vantage::python
