// The contexts of the hooks as objects of Python.
#include "contexts.hpp"

#include <fmt/core.h>
#include <pybind11/stl.h>

#include <dsc/base/error.hpp>

#include "arrays.hpp"

namespace dsc::python {
namespace {

using surface::SurfaceView;

[[noreturn]] void refuse_late_use() {
    throw UsageError("python.context", "the context", "is used after the call that received it",
                     "read what you need during the call and keep copies");
}

/// An array of the surface, lent for the call.
template <class Make>
auto lent(const char* name, Make make) {
    return [name, make](StepView& view) {
        return view.lent().get(name, [&] {
            py::object array = make(view.context());
            array.attr("setflags")(py::arg("write") = false);  // some are copies
            return array;
        });
    };
}

py::array bools(const std::vector<std::uint8_t>& values) {
    static_assert(sizeof(bool) == sizeof(std::uint8_t));
    return view_of(reinterpret_cast<const bool*>(values.data()), values.size());
}

template <class T, std::size_t Width>
py::array rows(const std::vector<std::array<T, Width>>& values) {
    return view_of(reinterpret_cast<const T*>(values.data()), values.size(), Width,
                   Width * sizeof(T));
}

py::object target_lengths(const hooks::StepContext& context) {
    if (!context.target_lengths.empty())
        return view_of(context.target_lengths.data(), context.target_lengths.size());
    const std::vector<double> equal(context.surface.vertex_count(), context.target_length);
    return copy_of(equal);
}

/// A column of the table of nearest points, which is searched here if it does not exist yet.
template <class T>
py::array nearest(const hooks::StepContext& context, T cloud::Neighbour::*member) {
    if (context.cloud == nullptr)
        throw UsageError("python.no_cloud", "the experiment", "has no cloud",
                         "test context.cloud for None first");
    if (!context.nearest.empty()) {
        return view_of(&(context.nearest.data()->*member), context.nearest.size(), 0,
                       sizeof(cloud::Neighbour));
    }
    std::vector<T> found;
    for (const Vec3& p : context.surface.positions)
        found.push_back(context.cloud->search().nearest(p).*member);
    return copy_of(found);
}

template <class T>
py::object of_points(const hooks::StepContext& context, T surface::FacePoint::*member) {
    const auto& all = context.faces_of_points;
    const surface::FacePoint none;
    const surface::FacePoint& first = all.empty() ? none : all.front();
    if constexpr (std::is_same_v<T, std::array<double, 3>>) {
        return view_of((first.*member).data(), all.size(), 3, sizeof(surface::FacePoint));
    } else {
        return view_of(&(first.*member), all.size(), 0, sizeof(surface::FacePoint));
    }
}

py::dict attributes(StepView& view) {
    py::dict all;
    for (const hooks::Attribute& a : view.context().attributes) {
        all[py::str(a.name)] = view.lent().get("attributes['" + a.name + "']", [&] {
            return view_of(a.values.data(), a.values.size());
        });
    }
    return all;
}

/// `count` random numbers for each of the elements, each element with a stream of its own.
template <class Draw>
py::array random(const py::object& elements, std::size_t count, const RandomKey& key, Draw draw) {
    const std::vector<std::uint32_t> ids =
        indices_from(elements, "elements", std::size_t{1} << 32U);
    py::array_t<double> numbers({ids.size(), count});
    double* out = numbers.mutable_data();
    for (const std::uint32_t id : ids) {
        RandomKey own = key;
        own.element = id;
        RandomStream stream(own);
        for (std::size_t k = 0; k < count; ++k) *out++ = draw(stream);
    }
    return numbers;
}

RandomKey key_of(const hooks::StepContext& c) { return {c.seed, c.instance, c.step, 0}; }

py::object cloud_of(const cloud::TargetCloud* cloud) {
    return cloud == nullptr ? py::none() : py::cast(CloudView{*cloud});
}

py::array box_of(const Box3& box) { return copy_of(std::vector<Vec3>{box.low, box.high}); }

/// An array of the cloud, which keeps the cloud alive.
template <class T>
py::object part(const py::object& self, std::span<const T> values) {
    if (values.empty()) return py::none();
    if constexpr (std::is_same_v<T, Vec3>) {
        py::array_t<double> array(
            std::vector<py::ssize_t>{static_cast<py::ssize_t>(values.size()), 3},
            reinterpret_cast<const double*>(values.data()), self);
        array.attr("setflags")(py::arg("write") = false);
        return array;
    } else if constexpr (std::is_same_v<T, cloud::Colour>) {
        py::array_t<std::uint8_t> array(
            std::vector<py::ssize_t>{static_cast<py::ssize_t>(values.size()), 3},
            reinterpret_cast<const std::uint8_t*>(values.data()), self);
        array.attr("setflags")(py::arg("write") = false);
        return array;
    } else {
        py::array_t<T> array(static_cast<py::ssize_t>(values.size()), values.data(), self);
        array.attr("setflags")(py::arg("write") = false);
        return array;
    }
}

template <class Get>
auto of_cloud(Get get) {
    return [get](const py::object& self) {
        return part(self, get(self.cast<const CloudView&>().cloud));
    };
}

/// The k nearest points of each place: indices and distances, shape (n,) for k = 1, else (n, k).
py::tuple nearest_points(const CloudView& view, const py::object& places, std::size_t k) {
    const std::vector<Vec3> points = vectors_from(places, "places");
    const std::size_t count = std::min(k, view.cloud.size());
    if (count == 0) throw UsageError("array.range", "k", "is 0", "ask for at least one point");
    std::vector<std::uint32_t> indices;
    std::vector<double> distances;
    {
        const py::gil_scoped_release released;
        std::vector<cloud::Neighbour> found;
        for (const Vec3& p : points) {
            view.cloud.search().k_nearest(p, count, found);
            for (const cloud::Neighbour& neighbour : found) {
                indices.push_back(neighbour.index);
                distances.push_back(neighbour.distance);
            }
        }
    }
    const py::array index = copy_of(indices), distance = copy_of(distances);
    if (k == 1) return py::make_tuple(index, distance);
    return py::make_tuple(index.attr("reshape")(points.size(), count),
                          distance.attr("reshape")(points.size(), count));
}

py::array sample(const VelocityView& view, const py::object& points, const py::object& normals) {
    if (view.velocity == nullptr) refuse_late_use();
    const std::vector<Vec3> places = vectors_from(points, "points");
    const std::vector<Vec3> directions = vectors_from(normals, "normals");
    require_size(directions.size(), places.size(), "normals", "points");
    std::vector<Vec3> out(places.size(), Vec3::Zero());
    {
        const py::gil_scoped_release released;
        view.velocity->sample(places, directions, out);
    }
    return copy_of(out);
}

const hooks::MeshFiles& files_of(const BuildView& view) {
    const hooks::MeshFiles* files = view.context().files;
    if (files == nullptr)
        throw UsageError("python.no_files", "the context", "has no readers of files",
                         "read the file with a library of Python");
    return *files;
}

void declare_cloud(py::module_& module) {
    using cloud::TargetCloud;
    py::class_<CloudView>(module, "Cloud")
        .def_property_readonly("points", of_cloud([](const TargetCloud& c) { return c.points(); }))
        .def_property_readonly("normals",
                               of_cloud([](const TargetCloud& c) { return c.normals(); }))
        .def_property_readonly("areas", of_cloud([](const TargetCloud& c) { return c.areas(); }))
        .def_property_readonly("confidence",
                               of_cloud([](const TargetCloud& c) { return c.confidence(); }))
        .def_property_readonly("colors", of_cloud([](const TargetCloud& c) { return c.colours(); }))
        .def_property_readonly("point_width", of_cloud([](const TargetCloud& c) {
                                   return std::span<const double>(c.statistics().point_width);
                               }))
        .def_property_readonly("noise", [](const CloudView& v) { return v.cloud.noise(); })
        .def_property_readonly(
            "centre",
            [](const CloudView& v) {
                return copy_of(std::vector<Vec3>{v.cloud.transform().centre}).attr("reshape")(3);
            })
        .def_property_readonly("scale",
                               [](const CloudView& v) { return v.cloud.transform().scale; })
        .def("nearest", &nearest_points, py::arg("places"), py::arg("k") = 1)
        .def("__len__", [](const CloudView& v) { return v.cloud.size(); });
}

template <class Class>
void declare_surface(Class& c) {
    const auto add = [&c](const char* name, auto make) {
        c.def_property_readonly(name, lent(name, make));
    };
    using Context = hooks::StepContext;
    const auto vectors = [](const std::vector<Vec3>& v) { return view_of(v.data(), v.size()); };
    const auto numbers = [](const auto& v) { return view_of(v.data(), v.size()); };
    add("positions", [=](const Context& x) { return vectors(x.surface.positions); });
    add("normals", [=](const Context& x) { return vectors(x.surface.normals); });
    add("movable", [](const Context& x) { return bools(x.surface.movable); });
    add("births", [=](const Context& x) { return numbers(x.surface.births); });
    add("faces", [](const Context& x) { return rows(x.surface.faces); });
    add("face_labels", [](const Context& x) { return rows(x.surface.face_labels); });
    add("previous_positions",
        [=](const Context& x) { return vectors(x.surface.previous_positions); });
    add("arrived", [](const Context& x) { return bools(x.surface.arrived); });
    add("age", [=](const Context& x) { return numbers(x.surface.age); });
    add("support", [](const Context& x) { return view_of(x.support.data(), x.support.size()); });
    add("face_normals", [=](const Context& x) { return vectors(x.surface.face_normals); });
    add("face_areas", [=](const Context& x) { return numbers(x.surface.face_areas); });
    add("face_tets", [=](const Context& x) { return numbers(x.surface.face_tets); });
    add("face_offsets", [=](const Context& x) { return numbers(x.surface.face_offsets); });
    add("vertex_faces", [=](const Context& x) { return numbers(x.surface.vertex_faces); });
    add("target_lengths", &target_lengths);
    add("nearest_index", [](const Context& x) { return nearest(x, &cloud::Neighbour::index); });
    add("nearest_distance",
        [](const Context& x) { return nearest(x, &cloud::Neighbour::distance); });
    add("point_faces", [](const Context& x) { return of_points(x, &surface::FacePoint::face); });
    add("point_weights",
        [](const Context& x) { return of_points(x, &surface::FacePoint::weights); });
    add("point_distances",
        [](const Context& x) { return of_points(x, &surface::FacePoint::distance); });
}

template <class Class>
void declare_values(Class& c) {
    const auto add = [&c](const char* name, auto get) {
        c.def_property_readonly(name, [get](const StepView& v) { return get(v.context()); });
    };
    using Context = hooks::StepContext;
    add("step", [](const Context& x) { return x.step; });
    add("planned_steps", [](const Context& x) { return x.planned_steps; });
    add("target_length", [](const Context& x) { return x.target_length; });
    add("mean_edge", [](const Context& x) { return x.surface.mean_edge; });
    add("seed", [](const Context& x) { return x.seed; });
    add("box", [](const Context& x) { return box_of(x.box); });
    add("cloud", [](const Context& x) { return cloud_of(x.cloud); });
    add("cancelled", [](const Context& x) { return x.cancelled(); });
    c.def_property_readonly("attributes", &attributes);
    c.def_property_readonly("volume", [](const StepView& v) -> py::object {
        return v.context().volume == nullptr ? py::none() : py::cast(v.volume());
    });
    c.def(
        "uniform",
        [](const StepView& v, const py::object& elements, std::size_t count) {
            return random(elements, count, key_of(v.context()),
                          [](RandomStream& s) { return s.uniform(); });
        },
        py::arg("elements"), py::arg("count") = 1);
    c.def(
        "normal",
        [](const StepView& v, const py::object& elements, std::size_t count) {
            return random(elements, count, key_of(v.context()),
                          [](RandomStream& s) { return s.normal(); });
        },
        py::arg("elements"), py::arg("count") = 1);
    c.def_property_readonly("pass_number", [](const StepView& v) { return v.refinement().pass; });
    c.def_property_readonly("velocity", [](const StepView& v) -> py::object {
        return v.refinement().velocity == nullptr ? py::none() : py::cast(v.velocity());
    });
}

}  // namespace

const hooks::StepContext& StepView::context() const {
    if (context_ == nullptr) refuse_late_use();
    return *context_;
}

const hooks::RefinementContext& StepView::refinement() const {
    if (refinement_ != nullptr) return *refinement_;
    if (context_ == nullptr) refuse_late_use();
    throw UsageError("python.context", "the context", "is not one of a refinement",
                     "read it in refine()");
}

void StepView::close() {
    context_ = nullptr;
    refinement_ = nullptr;
    if (velocity_) velocity_->velocity = nullptr;
    volume_->volume = nullptr;
    lent_.take_back();
}

void StepView::abandon() noexcept {
    context_ = nullptr;
    refinement_ = nullptr;
    if (velocity_) velocity_->velocity = nullptr;
    volume_->volume = nullptr;
    lent_.forget();
}

const hooks::InitialMeshContext& BuildView::context() const {
    if (context_ == nullptr) refuse_late_use();
    return *context_;
}

void declare_contexts(py::module_& module) {
    declare_cloud(module);
    declare_volume(module);
    py::class_<VelocityView, std::shared_ptr<VelocityView>>(module, "Velocity")
        .def("sample", &sample, py::arg("points"), py::arg("normals"));
    py::class_<StepView, std::shared_ptr<StepView>> step(module, "StepContext");
    declare_surface(step);
    declare_values(step);
    py::class_<BuildView, std::shared_ptr<BuildView>>(module, "InitialMeshContext")
        .def("read_surface",
             [](const BuildView& v, const std::string& file) {
                 const surface::TriangleMesh mesh = files_of(v).read_surface(file);
                 return py::make_tuple(copy_of(mesh.points), copy_of(mesh.faces));
             })
        .def("read_volume",
             [](const BuildView& v, const std::string& file) {
                 const mesh::TetMesh mesh = files_of(v).read_volume(file);
                 return py::make_tuple(copy_of(mesh.points), copy_of(mesh.tets),
                                       copy_of(mesh.labels));
             })
        .def_property_readonly("cloud",
                               [](const BuildView& v) { return cloud_of(v.context().cloud); })
        .def_property_readonly("seed", [](const BuildView& v) { return v.context().seed; })
        .def(
            "uniform",
            [](const BuildView& v, const py::object& elements, std::size_t count) {
                return random(elements, count, {v.context().seed, v.context().instance, 0, 0},
                              [](RandomStream& s) { return s.uniform(); });
            },
            py::arg("elements"), py::arg("count") = 1);
}

}  // namespace dsc::python
