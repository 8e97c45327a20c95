// Arrays of the labelled volume. A complex stores its tets with gaps, so every array is a copy.
#include "volume.hpp"

#include <array>
#include <memory>
#include <vector>

#include <dsc/base/error.hpp>

#include "arrays.hpp"

namespace dsc::python {
namespace {

const mesh::VolumeView& open(const VolumeArrays& arrays) {
    if (arrays.volume != nullptr) return *arrays.volume;
    throw UsageError("python.context", "the volume", "is used after the call that received it",
                     "read what you need during the call and keep copies");
}

/// An array with one entry per tet, in the order of their ids.
template <class Get>
auto per_tet(Get get) {
    return [get](const VolumeArrays& arrays) {
        const mesh::VolumeView& volume = open(arrays);
        std::vector<decltype(get(volume, mesh::TetId{}))> values;
        values.reserve(volume.tet_count());
        for (const mesh::TetId tet : volume.tets()) values.push_back(get(volume, tet));
        return copy_of(values);
    };
}

template <class Get>
auto per_vertex(Get get) {
    return [get](const VolumeArrays& arrays) {
        const mesh::VolumeView& volume = open(arrays);
        std::vector<decltype(get(volume, mesh::VertexId{}))> values;
        values.reserve(volume.vertex_count());
        for (const mesh::VertexId vertex : volume.vertices()) values.push_back(get(volume, vertex));
        return copy_of(values);
    };
}

}  // namespace

void declare_volume(py::module_& module) {
    using Volume = mesh::VolumeView;
    using Four = std::array<std::uint32_t, 4>;
    py::class_<VolumeArrays, std::shared_ptr<VolumeArrays>>(module, "Volume")
        .def_property_readonly("tets", per_tet([](const Volume&, mesh::TetId t) { return t; }))
        .def_property_readonly("tet_vertices", per_tet([](const Volume& v, mesh::TetId t) -> Four {
                                   return v.vertices_of(t);
                               }))
        .def_property_readonly("labels",
                               per_tet([](const Volume& v, mesh::TetId t) { return v.label(t); }))
        .def_property_readonly("quality",
                               per_tet([](const Volume& v, mesh::TetId t) { return v.quality(t); }))
        .def_property_readonly("volumes",
                               per_tet([](const Volume& v, mesh::TetId t) { return v.volume(t); }))
        .def_property_readonly(
            "centroids", per_tet([](const Volume& v, mesh::TetId t) { return v.centroid(t); }))
        .def_property_readonly("neighbours", per_tet([](const Volume& v, mesh::TetId t) {
                                   return Four{v.neighbour(t, 0), v.neighbour(t, 1),
                                               v.neighbour(t, 2), v.neighbour(t, 3)};
                               }))
        .def_property_readonly(
            "touches_box", per_tet([](const Volume& v, mesh::TetId t) { return v.touches_box(t); }))
        .def_property_readonly("vertices",
                               per_vertex([](const Volume&, mesh::VertexId v) { return v; }))
        .def_property_readonly("positions", per_vertex([](const Volume& v, mesh::VertexId id) {
                                   return v.position(id);
                               }));
}

}  // namespace dsc::python
