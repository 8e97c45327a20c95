// An observer and a generator of initial meshes written in Python.
#include <dsc/base/error.hpp>
#include <dsc/hooks/initial_mesh.hpp>
#include <dsc/hooks/observer.hpp>

#include "adapters.hpp"
#include "arrays.hpp"
#include "contexts.hpp"

namespace dsc::python {
namespace {

class PythonObserver final : public hooks::Observer {
public:
    explicit PythonObserver(Instance instance)
        : python_(std::move(instance)),
          needs_faces_(python_.value("needs_faces_of_points", false)),
          needs_support_(python_.value("needs_support", false)) {}

    bool needs_faces_of_points() const override { return needs_faces_; }
    bool needs_support() const override { return needs_support_; }
    void begin(const hooks::StepContext& context) override {
        figures("begin", context, [&](const py::object& view) {
            python_.self().attr("begin")(view);
            return py::none();
        });
    }
    hooks::Figures step(const hooks::StepContext& context,
                        const hooks::StepFigures& figures_so_far) override {
        return figures("step", context, [&](const py::object& view) {
            return python_.self().attr("step")(view, object_of(figures_so_far));
        });
    }
    hooks::Figures end(const hooks::StepContext& context) override {
        return figures("end", context,
                       [&](const py::object& view) { return python_.self().attr("end")(view); });
    }
    void save(std::ostream& out) const override { python_.save(out); }
    void load(std::istream& in) override { python_.load(in); }

private:
    static py::object object_of(const hooks::StepFigures& figures) {
        return py::module_::import("types").attr("SimpleNamespace")(
            py::arg("step") = figures.step,
            py::arg("interface_vertices") = figures.interface_vertices,
            py::arg("tets") = figures.tets, py::arg("volume") = figures.volume,
            py::arg("min_tet_quality") = figures.min_tet_quality);
    }

    /// Calls a method if the class has it.
    template <class Method>
    hooks::Figures figures(const char* name, const hooks::StepContext& context, Method method) {
        return with_python([&]() -> hooks::Figures {
            if (!python_.has(name)) return {};
            return with_view<StepView>(context, [&](const py::object& view) {
                return figures_from(py::object(method(view)), name);
            });
        });
    }

    Instance python_;
    bool needs_faces_, needs_support_;
};

class PythonInitialMesh final : public hooks::InitialMesh {
public:
    explicit PythonInitialMesh(Instance instance) : python_(std::move(instance)) {}

    mesh::TetMesh build(const hooks::InitialMeshContext& context) override {
        return with_python([&] {
            return with_view<BuildView>(context, [&](const py::object& view) {
                const py::object answer = python_.self().attr("build")(view);
                if (!py::isinstance<py::tuple>(answer) || py::len(answer) != 3)
                    throw std::runtime_error(
                        "build() must return three arrays: points, tets and labels");
                mesh::TetMesh mesh;
                mesh.points = vectors_from(answer[py::int_(0)], "build()[0], the points,");
                mesh.tets =
                    rows_from<4>(answer[py::int_(1)], "build()[1], the tets,", mesh.points.size());
                for (const std::uint32_t label : indices_from(
                         answer[py::int_(2)], "build()[2], the labels,", std::size_t{1} << 31U))
                    mesh.labels.push_back(static_cast<mesh::Label>(label));
                require_size(mesh.labels.size(), mesh.tets.size(), "build()[2], the labels,",
                             "tets");
                return mesh;
            });
        });
    }

    hooks::Figures figures() const override {
        return with_python([&]() -> hooks::Figures {
            if (!python_.has("figures")) return {};
            return figures_from(python_.self().attr("figures")(), "figures");
        });
    }

    hooks::Warnings warnings() const override {
        return with_python([&]() -> hooks::Warnings {
            hooks::Warnings all;
            if (!python_.has("warnings")) return all;
            for (const py::handle warning : python_.self().attr("warnings")())
                all.push_back({warning[py::int_(0)].cast<std::string>(),
                               warning[py::int_(1)].cast<std::string>()});
            return all;
        });
    }

    void save(std::ostream& out) const override { python_.save(out); }
    void load(std::istream& in) override { python_.load(in); }

private:
    Instance python_;
};

}  // namespace

std::unique_ptr<hooks::Strategy> adapt_observer(Instance instance) {
    return std::make_unique<PythonObserver>(std::move(instance));
}

std::unique_ptr<hooks::Strategy> adapt_initial_mesh(Instance instance) {
    return std::make_unique<PythonInitialMesh>(std::move(instance));
}

}  // namespace dsc::python
