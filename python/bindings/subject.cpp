// SPDX-License-Identifier: MIT
#include "subject.h"

#include <cstdint>
#include <limits>
#include <utility>

#include <pybind11/stl.h>

#include "vantage/core/error.h"
#include "vantage/io/model.h"
#include "vantage/pipeline/measured_shape.h"
#include "vantage/pipeline/sidecar.h"

#include "arguments.h"
#include "arrays.h"
#include "released_run.h"
#include "text.h"

namespace vantage::python {
namespace {

bool is_path(const py::object& value) {
  return py::isinstance<py::str>(value) || py::isinstance<py::bytes>(value) ||
         py::hasattr(value, "__fspath__");
}

ModelHandle model_of_arrays(const py::object& V, const py::object& F, const py::object& name,
                            const py::object& colours) {
  auto model = std::make_shared<Model>();
  model->name = name.is_none() ? "arrays" : word_of(name, "name");
  model->mesh = mesh_of(V, F);
  model->double_precision = true;
  model->polygons = model->mesh.triangles.size();
  if (!F.is_none() && model->mesh.triangles.empty()) {
    model->notes.emplace_back("F holds no faces, so V is taken for a point cloud");
  }
  if (!colours.is_none()) {
    model->vertex_colours = colours_of(colours);
    if (model->vertex_colours.size() != model->mesh.positions.size()) {
      throw InvalidInput("colours must have one row for each of the " +
                         std::to_string(model->mesh.positions.size()) + " vertices");
    }
  }
  return {std::move(model)};
}

/// What the program reads, by its own limit where none is given.
ReadOptions reading(bool appearance, std::size_t max_faces) {
  return {.appearance = appearance,
          .max_faces = max_faces > 0 ? max_faces : faces_that_fit(usable_memory_bytes())};
}

ModelHandle load(const py::object& path, const py::object& progress, const py::object& threads,
                 const py::object& max_faces) {
  constexpr std::int64_t kMost = std::numeric_limits<std::int64_t>::max();
  const std::int64_t most =
      max_faces.is_none() ? 0 : whole_number_of(max_faces, "max_faces", 0, kMost);
  const std::string file = path_text(path);
  return {released({progress, threads}, [&](const RunContext& run) {
    return std::make_shared<const Model>(
        load_model(file, run, reading(true, static_cast<std::size_t>(most))));
  })};
}

AnalysisHandle analyse(const py::object& model, const py::object& F, const py::dict& options,
                       const py::object& progress, const py::object& threads) {
  const Subject subject(model, F);
  const Settings settings = subject.settings(options);
  return {released({progress, threads}, [&](const RunContext& run) {
    return subject.analysed(settings, with_map, run, true);
  })};
}

py::tuple parts_of(const ModelHandle& handle) {
  py::list parts;
  for (const ModelPart& part : handle.model->parts) {
    parts.append(py::make_tuple(text_of(part.name), part.first_triangle, part.triangle_count));
  }
  return py::tuple(parts);
}

/// For people: "12 vertices, 20 faces".
std::string sizes_of(const Model& model) {
  return std::to_string(model.mesh.positions.size()) + " vertices, " +
         std::to_string(model.mesh.triangles.size()) + " faces";
}

/// Copies go through pickle as well. Without this, protocols 0 and 1 end the interpreter.
py::object refuse_pickle(const py::object& self, const py::args& /*protocol*/) {
  throw py::type_error("cannot pickle " + std::string(Py_TYPE(self.ptr())->tp_name) +
                       ": pickle its arrays, or the path of its file");
}

void define_model(py::module_& module) {
  py::class_<ModelHandle>(
      module, "Model",
      "A model as load() read it, or as arrays describe it. Never changes; its arrays "
      "are read-only views.\n\n"
      "Model(V, F=None, *, name=\"arrays\", colours=None): V is (n, 3) vertices, F (m, 3) "
      "integers; without faces it is a point cloud. colours is (n, 3) of the vertices, "
      "uint8 or floats from 0 to 1, sRGB.\n"
      "Raises InvalidInput, TypeError. Cannot be pickled: pickle its arrays.")
      .def("__reduce__", &refuse_pickle)
      .def("__reduce_ex__", &refuse_pickle)
      .def(py::init(&model_of_arrays), py::arg("V"), py::arg("F") = py::none(), py::kw_only(),
           py::arg("name") = "arrays", py::arg("colours") = py::none(),
           "Takes V, (n, 3) vertices, and F, (m, 3) integers, or None of a point cloud.")
      .def("__repr__",
           [](const ModelHandle& h) {
             return "Model(" + py::repr(text_of(h.model->name)).cast<std::string>() + ", " +
                    sizes_of(*h.model) + ")";
           })
      .def_property_readonly(
          "name", [](const ModelHandle& h) { return text_of(h.model->name); },
          "str: the file's name without its ending, or the name that was given.")
      .def_property_readonly(
          "format", [](const ModelHandle& h) { return format_name(*h.model); },
          "str: the format of the file; of arrays the one that their habits are of.")
      .def_property_readonly(
          "vertices",
          [](const ModelHandle& h) {
            const auto& points = h.model->mesh.positions;
            return shared_array<double>(points.data(), {extent(points.size()), 3}, h.model);
          },
          "(n, 3) float64: positions in the units of the file.")
      .def_property_readonly(
          "faces",
          [](const ModelHandle& h) {
            const auto& faces = h.model->mesh.triangles;
            return shared_array<std::uint32_t>(faces.data(), {extent(faces.size()), 3}, h.model);
          },
          "(m, 3) uint32: triangles, counter-clockwise from outside; (0, 3) of a point cloud.")
      .def_property_readonly(
          "colours",
          [](const ModelHandle& h) {
            const auto& colours = h.model->vertex_colours;
            return shared_array<std::uint8_t>(colours.data(), {extent(colours.size()), 3}, h.model);
          },
          "(n, 3) uint8: sRGB of the vertices; (0, 3) where there are none.")
      .def_property_readonly("parts", &parts_of,
                             "tuple of (name, first face, faces): what the file calls objects; "
                             "empty where it names none.")
      .def_property_readonly(
          "notes", [](const ModelHandle& h) { return messages_of(h.model->notes); },
          "tuple of str: what the reader left out, mended or guessed, one sentence each.");
}

void define_analysis(py::module_& module) {
  const auto shape_of = [](const AnalysisHandle& h) -> const ShapeAnalysis& {
    return h.analysis->shape;
  };
  py::class_<AnalysisHandle>(
      module, "Analysis",
      "A model with its contraction, skeleton and significance map, as analyse() makes it. Never "
      "changes.\n\n"
      "Every function takes it in place of a model; options of the method and the map stay those "
      "that "
      "analyse() was given. Cannot be pickled.")
      .def("__reduce__", &refuse_pickle)
      .def("__reduce_ex__", &refuse_pickle)
      .def("__repr__",
           [](const AnalysisHandle& h) {
             const Model& model = *h.analysis->model;
             return "Analysis of " + py::repr(text_of(model.name)).cast<std::string>() + ", " +
                    sizes_of(model);
           })
      .def_property_readonly(
          "model", [](const AnalysisHandle& h) { return ModelHandle{h.analysis->model}; },
          "Model: what was analysed.")
      .def_property_readonly(
          "closed", [=](const AnalysisHandle& h) { return shape_of(h).check.closed; },
          "bool: the surface has no border, once vertices at one place are joined.")
      .def_property_readonly(
          "components", [=](const AnalysisHandle& h) { return shape_of(h).check.components; },
          "int: pieces of the surface that nothing joins.")
      .def_property_readonly(
          "genus", [=](const AnalysisHandle& h) { return shape_of(h).check.genus; },
          "int: handles of all pieces together; None unless the surface is closed.")
      .def_property_readonly(
          "centre", [=](const AnalysisHandle& h) { return array_of(shape_of(h).sphere.centre); },
          "(3,) float64: centre of the smallest enclosing sphere, which directions start from.")
      .def_property_readonly(
          "diameter", [=](const AnalysisHandle& h) { return shape_of(h).sphere.diameter; },
          "float: of that sphere, in the units of the model.")
      .def_property_readonly(
          "warnings", [=](const AnalysisHandle& h) { return messages_of(shape_of(h).warnings); },
          "tuple of str: every repair and doubt, one sentence each.");
}

/// The same analysis with the map that these settings sum.
std::shared_ptr<const Analysis> with_other_map(const Analysis& analysis, const Settings& settings,
                                               const RunContext& run) {
  auto other = std::make_shared<Analysis>(analysis);
  other->settings = settings;
  add_map(other->shape, settings.view, run);
  return other;
}

}  // namespace

Subject::Subject(const py::object& model, const py::object& faces) {
  const bool is_model = py::isinstance<ModelHandle>(model);
  const bool is_analysis = py::isinstance<AnalysisHandle>(model);
  if (!faces.is_none() && (is_model || is_analysis || is_path(model))) {
    throw py::type_error("F goes with an array of vertices only");
  }
  if (is_model) {
    model_ = model.cast<const ModelHandle&>().model;
  } else if (is_analysis) {
    analysis_ = model.cast<const AnalysisHandle&>().analysis;
  } else if (is_path(model)) {
    path_ = path_text(model);
  } else {
    model_ = model_of_arrays(model, faces, py::none(), py::none()).model;
  }
}

Settings Subject::settings(const py::dict& keywords, const IdleRule& idle) const {
  Settings settings =
      analysis_ ? settings_over(analysis_->settings, keywords, idle) : settings_of(keywords, idle);
  if (!path_.empty()) {
    Sidecar sidecar = sidecar_of(path_);
    const auto is_said = [&](const char* name) {
      return keywords.contains(name) && !keywords[name].is_none();
    };
    if (is_said("up")) {  // "auto" too
      sidecar.up.reset();
    }
    if (is_said("front")) {
      sidecar.front.reset();
    }
    sidecar.apply(settings.view);
    const bool has_style = is_said("style");
    settings.look.style =
        has_style ? settings.look.style : sidecar.style.value_or(settings.look.style);
  }
  if (settings.view.up == UpAxis::Any) {
    throw InvalidInput(
        "option up: any turns the model, which would no longer be where its arrays are; write it "
        "with vantage orient MODEL --up=any -o OUT, and take what that writes");
  }
  return settings;
}

std::shared_ptr<const Analysis> Subject::analysed(const Settings& settings, const Analyser& analyse,
                                                  const RunContext& run, bool is_drawn) const {
  if (analysis_) {
    const bool is_other_map =
        sums_a_map(settings.view.method) && settings.view.method != analysis_->settings.view.method;
    return is_other_map ? with_other_map(*analysis_, settings, run) : analysis_;
  }
  auto made = std::make_shared<Analysis>();
  made->model = model_ ? model_
                       : std::make_shared<const Model>(load_model(
                             path_, run.part(0.0, 0.05),
                             reading(is_drawn && settings.look.style == Style::Asset, 0)));
  made->shape = analyse(*made->model, settings.view, run.part(0.05, 1.0));
  made->settings = settings;
  return made;
}

ShapeAnalysis surface_only(const Model& model, const ViewOptions& options, const RunContext& run) {
  return prepare_surface(model, options, run);
}

ShapeAnalysis with_skeleton(const Model& model, const ViewOptions& options, const RunContext& run) {
  ShapeAnalysis shape = prepare_surface(model, run);
  add_history(shape, options, run.part(0.0, 0.8));
  add_skeleton(shape, options, run.part(0.8, 1.0));
  return shape;
}

ShapeAnalysis with_map(const Model& model, const ViewOptions& options, const RunContext& run) {
  return analyse_shape(model, options, run);
}

void define_models(py::module_& module) {
  define_model(module);
  define_analysis(module);
  module.def("load", &load, py::arg("path"), py::arg("progress"), py::arg("threads"),
             py::arg("max_faces"));
  module.def("analyse", &analyse, py::arg("model"), py::arg("F"), py::arg("options"),
             py::arg("progress"), py::arg("threads"));
}

}  // namespace vantage::python
