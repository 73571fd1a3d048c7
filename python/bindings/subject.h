// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <memory>
#include <string>

#include <pybind11/pybind11.h>

#include "vantage/core/run_context.h"
#include "vantage/io/model.h"
#include "vantage/pipeline/shape_analysis.h"

#include "options.h"

/// \file
/// What functions are asked about: the path of a file, arrays, a model, or a model that has been
/// analysed already.

namespace vantage::python {

/// A model that Python holds. Never changes, so threads and array views share it.
struct ModelHandle {
  std::shared_ptr<const Model> model{};
};

/// A model with its contraction, skeleton and map, and the options these were made with.
struct Analysis {
  std::shared_ptr<const Model> model{};
  ShapeAnalysis shape{};
  Settings settings{};
};

/// An analysis that Python holds; never changes.
struct AnalysisHandle {
  std::shared_ptr<const Analysis> analysis{};
};

/// Takes a handle out of its Python object. What Python made by __new__ alone holds none: pybind11
/// would read it from memory that nobody wrote.
template <class Handle>
class HandleCaster : public py::detail::type_caster_base<Handle> {
 public:
  bool load(py::handle source, bool convert) {
    if (py::isinstance<Handle>(source)) {
      auto* const object = reinterpret_cast<py::detail::instance*>(source.ptr());
      if (!object->get_value_and_holder().holder_constructed()) {
        throw py::type_error("this " + std::string(Py_TYPE(source.ptr())->tp_name) +
                             " was made by __new__ alone and holds nothing");
      }
    }
    return py::detail::type_caster_base<Handle>::load(source, convert);
  }
};

/// Makes of a model what a function needs of it.
using Analyser = std::function<ShapeAnalysis(const Model&, const ViewOptions&, const RunContext&)>;

/// The first two arguments of most functions.
class Subject {
 public:
  /// \param model path, vertices, Model or Analysis. \param faces None unless `model` is vertices.
  /// \pre holds the interpreter's lock. \throw py::type_error, InvalidInput
  Subject(const py::object& model, const py::object& faces);

  /// The options of a call about it. \param idle as for settings_of().
  [[nodiscard]] Settings settings(const py::dict& keywords, const IdleRule& idle = {}) const;

  /// The analysis, made now unless there was one. Does not touch Python. \throw Cancelled
  /// \param is_drawn whether materials and textures are read, if the style shows them.
  [[nodiscard]] std::shared_ptr<const Analysis> analysed(const Settings& settings,
                                                         const Analyser& analyse,
                                                         const RunContext& run,
                                                         bool is_drawn = false) const;

 private:
  std::string path_{};
  std::shared_ptr<const Model> model_{};
  std::shared_ptr<const Analysis> analysis_{};
};

/// Only what every view needs: welded, turned outwards.
ShapeAnalysis surface_only(const Model& model, const ViewOptions& options, const RunContext& run);
/// Contraction and skeleton too.
ShapeAnalysis with_skeleton(const Model& model, const ViewOptions& options, const RunContext& run);
/// Everything.
ShapeAnalysis with_map(const Model& model, const ViewOptions& options, const RunContext& run);

/// Adds Model, Analysis, load() and analyse() to the module.
void define_models(py::module_& module);
/// Adds skeleton(), kssm() and vertex_map().
void define_shape_functions(py::module_& module);
/// Adds visible_vertices(), score(), directions() and measures().
void define_view_functions(py::module_& module);
/// Adds best_view().
void define_best_view(py::module_& module);
/// Adds render() and colour_map().
void define_pictures(py::module_& module);

}  // namespace vantage::python

template <>
class pybind11::detail::type_caster<vantage::python::ModelHandle>
    : public vantage::python::HandleCaster<vantage::python::ModelHandle> {};

template <>
class pybind11::detail::type_caster<vantage::python::AnalysisHandle>
    : public vantage::python::HandleCaster<vantage::python::AnalysisHandle> {};
