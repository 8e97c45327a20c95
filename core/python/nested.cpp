// Calls a nested strategy from Python.
#include "nested.hpp"

#include <vector>

#include <dsc/base/error.hpp>

#include "arrays.hpp"
#include "contexts.hpp"

namespace dsc::python {
namespace {

constexpr std::size_t block = 256;

hooks::VelocityField* velocity_of(const Nested& nested) {
    return nested.kind == plugin::Kind::velocity
               ? static_cast<hooks::VelocityField*>(nested.strategy.get())
               : nullptr;
}

hooks::CurvatureEstimator& curvature_of(const Nested& nested) {
    return static_cast<hooks::CurvatureEstimator&>(*nested.strategy);
}

void advance_nested(Nested& nested, const StepView& view) {
    const hooks::StepContext& context = view.context();
    const py::gil_scoped_release released;
    if (hooks::VelocityField* velocity = velocity_of(nested)) velocity->advance(context);
}

void prepare_nested(Nested& nested, const StepView& view) {
    const hooks::StepContext& context = view.context();
    nested.vertices = context.surface.vertex_count();
    nested.workers = context.workers;
    const py::gil_scoped_release released;
    if (hooks::VelocityField* velocity = velocity_of(nested)) {
        velocity->prepare(context);
    } else {
        curvature_of(nested).prepare(context);
    }
}

py::object evaluate_nested(const Nested& nested) {
    std::vector<Vec3> vectors(nested.vertices, Vec3::Zero());
    std::vector<double> scalars(nested.vertices, 0.0);
    const hooks::VelocityField* const velocity = velocity_of(nested);
    {
        const py::gil_scoped_release released;
        for_blocks(nested.workers, nested.vertices, block, [&](std::size_t begin, std::size_t end) {
            const auto part = std::span(vectors).subspan(begin, end - begin);
            if (velocity != nullptr) {
                velocity->evaluate({begin, end}, part);
            } else {
                curvature_of(nested).evaluate({begin, end},
                                              std::span(scalars).subspan(begin, end - begin), part);
            }
        });
    }
    if (velocity != nullptr) return copy_of(vectors);
    return py::make_tuple(copy_of(scalars), copy_of(vectors));
}

}  // namespace

void declare_nested(py::module_& module) {
    py::class_<Nested, std::shared_ptr<Nested>>(module, "Strategy")
        .def("advance", &advance_nested, py::arg("context"))
        .def("prepare", &prepare_nested, py::arg("context"))
        .def("evaluate", &evaluate_nested);
}

}  // namespace dsc::python
