// The result of a run: arrays and files.
#include "outcome.hpp"

#include <fmt/core.h>

#include <dsc/base/error.hpp>
#include <dsc/geometry/quality.hpp>
#include <dsc/io/formats.hpp>
#include <dsc/io/write.hpp>
#include <dsc/surface/measure.hpp>

#include "arrays.hpp"

namespace dsc::python {
namespace {

std::vector<double> qualities(const mesh::TetMesh& mesh) {
    std::vector<double> all;
    all.reserve(mesh.tets.size());
    for (const auto& tet : mesh.tets) {
        all.push_back(geometry::tet_quality(mesh.points[tet[0]], mesh.points[tet[1]],
                                            mesh.points[tet[2]], mesh.points[tet[3]]));
    }
    return all;
}

std::vector<io::DataArray> arrays_of(const hooks::Attributes& attributes) {
    std::vector<io::DataArray> arrays;
    for (const hooks::Attribute& a : attributes) arrays.push_back({a.name, a.values});
    return arrays;
}

/// A read-only array on memory of the outcome, which the array keeps alive.
template <class T>
py::array part(const py::object& owner, const T* data, std::size_t rows, std::size_t columns) {
    std::vector<py::ssize_t> shape = {static_cast<py::ssize_t>(rows)};
    if (columns > 0) shape.push_back(static_cast<py::ssize_t>(columns));
    py::array_t<T> array(shape, data, owner);
    array.attr("setflags")(py::arg("write") = false);
    return array;
}

template <class T, class Item>
auto member(const std::vector<Item>& (*select)(const Outcome&), std::size_t columns) {
    return [select, columns](const py::object& self) {
        const std::vector<Item>& items = select(self.cast<const Outcome&>());
        return part(self, reinterpret_cast<const T*>(items.data()), items.size(), columns);
    };
}

py::dict attributes_of(const py::object& self) {
    py::dict all;
    for (const hooks::Attribute& a : self.cast<const Outcome&>().attributes)
        all[py::str(a.name)] = part(self, a.values.data(), a.values.size(), 0);
    return all;
}

py::list warnings_of(const Outcome& outcome) {
    py::list all;
    for (const hooks::Warning& warning : outcome.run.totals.warnings)
        all.append(py::make_tuple(warning.code, warning.text));
    return all;
}

}  // namespace

void Outcome::take(const run::ResultData& data) {
    volume = data.volume;
    quality = qualities(volume);
    surface = data.surface;
    vertex_of.assign(data.vertex_of.begin(), data.vertex_of.end());
    point_attributes = data.attributes;
    for (const hooks::Attribute& a : point_attributes) {
        hooks::Attribute& on_surface = attributes.emplace_back();
        on_surface.name = a.name;
        for (const std::uint32_t v : vertex_of) on_surface.values.push_back(a.values[v]);
    }
}

void Outcome::save(const std::filesystem::path& file) const {
    const io::Format* format = io::find_format(file);
    if (format == nullptr) {
        throw UsageError("usage.format", file.string(),
                         "does not have the extension of a format that dsc writes",
                         "use " + io::surface_extensions() + " for the surface, " +
                             io::volume_extensions() + " for the volume");
    }
    if (format->volume) {
        io::VolumeData data;
        data.points = arrays_of(point_attributes);
        io::write_volume(file, volume, data);
        return;
    }
    io::write_surface(file, surface, arrays_of(attributes), surface::vertex_normals(surface));
}

void declare_outcome(py::module_& module) {
    using Rows3 = std::array<std::uint32_t, 3>;
    using Rows4 = std::array<std::uint32_t, 4>;
    py::class_<Outcome>(module, "Outcome")
        .def_property_readonly("vertices",
                               member<double, Vec3>(
                                   [](const Outcome& o) -> auto& { return o.surface.points; }, 3))
        .def_property_readonly("faces",
                               member<std::uint32_t, Rows3>(
                                   [](const Outcome& o) -> auto& { return o.surface.faces; }, 3))
        .def_property_readonly("colors",
                               member<std::uint8_t, cloud::Colour>(
                                   [](const Outcome& o) -> auto& { return o.surface.colours; }, 3))
        .def_property_readonly("points",
                               member<double, Vec3>(
                                   [](const Outcome& o) -> auto& { return o.volume.points; }, 3))
        .def_property_readonly("tets",
                               member<std::uint32_t, Rows4>(
                                   [](const Outcome& o) -> auto& { return o.volume.tets; }, 4))
        .def_property_readonly("labels",
                               member<std::int32_t, mesh::Label>(
                                   [](const Outcome& o) -> auto& { return o.volume.labels; }, 0))
        .def_property_readonly("quality",
                               member<double, double>(
                                   [](const Outcome& o) -> auto& { return o.quality; }, 0))
        .def_property_readonly("vertex_points",
                               member<std::uint32_t, std::uint32_t>(
                                   [](const Outcome& o) -> auto& { return o.vertex_of; }, 0))
        .def_property_readonly("attributes", &attributes_of)
        .def_property_readonly("warnings", &warnings_of)
        .def_property_readonly(
            "status", [](const Outcome& o) { return std::string(name(o.run.totals.status)); })
        .def_property_readonly("steps", [](const Outcome& o) { return o.run.totals.steps; })
        .def_property_readonly("folder", [](const Outcome& o) { return o.run.folder.string(); })
        .def("save", [](const Outcome& o, const std::string& file) {
            const py::gil_scoped_release released;
            o.save(file);
        });
}

}  // namespace dsc::python
