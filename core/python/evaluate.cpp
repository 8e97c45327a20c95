// Measures a surface against the true one.
#include "evaluate.hpp"

#include <thread>

#include <dsc/base/workers.hpp>
#include <dsc/io/read.hpp>
#include <dsc/surface/distance.hpp>
#include <dsc/surface/surface_view.hpp>
#include <dsc/surface/truth_figures.hpp>

#include "arrays.hpp"

namespace dsc::python {
namespace {

surface::TriangleMesh mesh_from(const py::object& vertices, const py::object& faces,
                                const std::string& name) {
    surface::TriangleMesh mesh;
    mesh.points = vectors_from(vertices, name + " vertices");
    mesh.faces = rows_from<3>(faces, name + " faces", mesh.points.size());
    return mesh;
}

py::dict evaluate(const py::object& vertices, const py::object& faces,
                  const py::object& true_vertices, const py::object& true_faces,
                  std::size_t samples) {
    const surface::TriangleMesh result = mesh_from(vertices, faces, "result");
    const surface::TriangleMesh truth = mesh_from(true_vertices, true_faces, "truth");
    surface::Evaluation evaluation;
    {
        const py::gil_scoped_release released;
        Workers workers(std::max(1U, std::thread::hardware_concurrency()));
        surface::EvaluateOptions options;
        options.samples = samples;
        options.workers = &workers;
        evaluation = surface::evaluate(result, truth, options);
    }
    py::dict figures;
    for (const auto& [name, value] : surface::truth_figures(evaluation))
        figures[py::str(std::string(name))] = value;
    return figures;
}

py::tuple read_surface(const std::string& file) {
    surface::TriangleMesh mesh;
    {
        const py::gil_scoped_release released;
        mesh = io::read_surface(file);
    }
    return py::make_tuple(copy_of(mesh.points), copy_of(mesh.faces));
}

py::tuple read_volume(const std::string& file) {
    mesh::TetMesh mesh;
    {
        const py::gil_scoped_release released;
        mesh = io::read_volume(file);
    }
    return py::make_tuple(copy_of(mesh.points), copy_of(mesh.tets), copy_of(mesh.labels));
}

py::tuple interface_of(const std::string& file) {
    surface::TriangleMesh mesh;
    {
        const py::gil_scoped_release released;
        mesh = surface::extract_interface(io::read_volume(file));
    }
    return py::make_tuple(copy_of(mesh.points), copy_of(mesh.faces));
}

}  // namespace

void declare_evaluate(py::module_& module) {
    module.def("evaluate", &evaluate);
    module.def("read_surface", &read_surface);
    module.def("read_volume", &read_volume);
    module.def("interface_of", &interface_of);
}

}  // namespace dsc::python
