#include "fixtures.hpp"

#include <cmath>
#include <numbers>

#include <fmt/core.h>

#include <dsc/generate/shape_mesh.hpp>
#include <dsc/mesh/adopt.hpp>
#include <dsc/sdk/surfaces.hpp>

#include "guarded_input.hpp"

namespace dsc::conformance {
namespace {

constexpr std::size_t cloud_points = 1500;

// Points of an ellipsoid, from points that are evenly spread over a sphere [golden spiral].
std::vector<Vec3> ellipsoid(std::size_t count) {
    const Vec3 radii(1.0, 0.85, 0.7);
    const double turn = std::numbers::pi * (3.0 - std::sqrt(5.0));
    std::vector<Vec3> points;
    for (std::size_t i = 0; i < count; ++i) {
        const double z = 1.0 - (2.0 * static_cast<double>(i) + 1.0) / static_cast<double>(count);
        const double r = std::sqrt(1.0 - z * z);
        const double angle = turn * static_cast<double>(i);
        points.push_back(radii.cwiseProduct(Vec3(r * std::cos(angle), r * std::sin(angle), z)));
    }
    return points;
}

cloud::TargetCloud target(std::vector<Vec3> points) {
    const cloud::Normalized normalized{std::move(points), {}};
    auto made = in_guarded_memory([&] { return cloud::TargetCloud(normalized); });
    name_memory(made.points().data(), "the points of the cloud");
    return made;
}

// Built once: it takes longer than most tests.
std::shared_ptr<const mesh::Complex> sphere_complex() {
    static const auto complex = [] {
        generate::Shape sphere;
        sphere.radius = 0.9;
        const std::vector<generate::Shape> shapes = {sphere};
        generate::LatticeOptions options;
        options.cells = 14;
        return std::make_shared<const mesh::Complex>(
            mesh::adopt(generate::make_shape_mesh(options, shapes, "the fixture"), "the fixture"));
    }();
    return complex;
}

Fixture of_triangles(std::string name, const surface::TriangleMesh& mesh) {
    Fixture fixture;
    fixture.name = std::move(name);
    fixture.view = sdk::view_of(mesh);
    fixture.cloud = target(ellipsoid(200));
    return fixture;
}

surface::TriangleMesh tetrahedron(const Vec3& at, double size) {
    surface::TriangleMesh mesh;
    for (const Vec3& p : {Vec3(1, 1, 1), Vec3(1, -1, -1), Vec3(-1, 1, -1), Vec3(-1, -1, 1)})
        mesh.points.push_back(at + size * p);
    mesh.faces = {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}};
    return mesh;
}

surface::TriangleMesh pieces(int count) {
    surface::TriangleMesh all;
    for (int i = 0; i < count; ++i) {
        const surface::TriangleMesh piece =
            tetrahedron(Vec3(0.1 * (i % 10) - 0.5, 0.1 * (i / 10) - 0.5, 0.3), 0.02);
        const auto first = static_cast<std::uint32_t>(all.points.size());
        all.points.insert(all.points.end(), piece.points.begin(), piece.points.end());
        for (const auto& [a, b, c] : piece.faces)
            all.faces.push_back({first + a, first + b, first + c});
    }
    return all;
}

surface::TriangleMesh stretched(const Vec3& factors, const Vec3& shift = Vec3::Zero()) {
    return sdk::moved(sdk::icosphere(2, 1.0),
                      [&](const Vec3& p) { return Vec3(factors.cwiseProduct(p) + shift); });
}

// Shrinks the first face to a line and the second to a point.
surface::TriangleMesh with_flat_faces() {
    surface::TriangleMesh mesh = sdk::icosphere(2, 1.0);
    const auto& [a, b, c] = mesh.faces[0];
    mesh.points[c] = 0.5 * (mesh.points[a] + mesh.points[b]);
    const auto& [d, e, f] = mesh.faces.back();
    mesh.points[e] = mesh.points[d];
    mesh.points[f] = mesh.points[d];
    return mesh;
}

double scale_at(std::uint64_t step) { return 1.0 - 0.02 * static_cast<double>(step % 10); }

}  // namespace

void prepare_fixtures() { sphere_complex(); }

Fixture ordinary() {
    Fixture fixture;
    fixture.name = "a sphere";
    fixture.complex = sphere_complex();
    surface::build_view(*fixture.complex, fixture.view);
    fixture.cloud = target(ellipsoid(cloud_points));
    return fixture;
}

Fixture triangles(unsigned level) {
    Fixture fixture = of_triangles(fmt::format("a sphere of {} triangles", 20U << (2 * level)),
                                   sdk::icosphere(level, 1.0));
    fixture.cloud = target(ellipsoid(cloud_points));
    return fixture;
}

std::vector<Fixture> hostile_surfaces() {
    std::vector<Fixture> all;
    all.push_back(of_triangles("no interface", {}));
    all.push_back(of_triangles("one tet", tetrahedron(Vec3::Zero(), 0.5)));
    all.push_back(of_triangles("slivers", stretched(Vec3(1, 1, 1e-7))));
    all.push_back(of_triangles("faces without area", with_flat_faces()));
    all.push_back(of_triangles("all vertices in one place", stretched(Vec3::Zero())));
    all.push_back(of_triangles("a tiny sphere", stretched(Vec3::Constant(1e-9))));
    all.push_back(of_triangles("a tiny sphere in a corner",
                               stretched(Vec3::Constant(1e-9), Vec3::Constant(1.4))));
    all.push_back(of_triangles("100 pieces", pieces(100)));
    all.push_back(of_triangles("an open surface", sdk::square(4, 0.5)));
    all.push_back(of_triangles("no movable vertex", sdk::icosphere(1, 1.0)));
    all.back().view.movable.assign(all.back().view.vertex_count(), 0);
    return all;
}

std::vector<Fixture> hostile_clouds() {
    const Fixture base = ordinary();
    const auto with = [&base](std::string name, std::optional<cloud::TargetCloud> cloud) {
        Fixture fixture = base;
        fixture.name = std::move(name);
        fixture.cloud = std::move(cloud);
        return fixture;
    };
    std::vector<Fixture> all;
    all.push_back(with("no cloud", std::nullopt));
    all.push_back(with("a cloud of one point", target({Vec3(0.1, 0.2, 0.3)})));
    all.push_back(
        with("three points on a line", target({Vec3(-1, 0, 0), Vec3(0, 0, 0), Vec3(1, 0, 0)})));
    all.push_back(
        with("1,000 points in one place", target(std::vector<Vec3>(1000, Vec3(0.5, 0, 0)))));
    all.push_back(
        with("two points in the corners", target({Vec3::Constant(-1.5), Vec3::Constant(1.5)})));
    all.push_back(with("the surface's own vertices", target(base.view.positions)));
    return all;
}

Fixture at_step(const Fixture& fixture, std::uint64_t step) {
    Fixture result = fixture;
    if (step == 0 || fixture.view.positions.empty()) return result;
    const double scale = scale_at(step), scale_before = scale_at(step - 1);
    Vec3 centroid = Vec3::Zero();
    for (const Vec3& p : fixture.view.positions) centroid += p;
    centroid /= static_cast<double>(fixture.view.positions.size());
    for (std::size_t v = 0; v < result.view.vertex_count(); ++v) {
        Vec3& p = result.view.positions[v];
        result.view.previous_positions[v] = centroid + scale_before * (p - centroid);
        p = centroid + scale * (p - centroid);
        result.view.arrived[v] = step > 1 && result.view.births[v] % 5 == 0 ? 0 : 1;
        result.view.age[v] = static_cast<std::uint32_t>(step - 1);
    }
    for (double& area : result.view.face_areas) area *= scale * scale;
    result.view.mean_edge *= scale;
    return result;
}

Fixture moved(const Fixture& fixture, const Motion& motion) {
    Fixture result = fixture;
    result.name += ", moved";
    result.complex = nullptr;
    const auto move = [&motion](const Vec3& p) { return Vec3(motion.rotation * p + motion.shift); };
    for (Vec3& p : result.view.positions) p = move(p);
    for (Vec3& p : result.view.previous_positions) p = move(p);
    for (Vec3& n : result.view.normals) n = motion.rotation * n;
    for (Vec3& n : result.view.face_normals) n = motion.rotation * n;
    if (fixture.cloud) {
        std::vector<Vec3> points;
        for (const Vec3& p : fixture.cloud->points()) points.push_back(move(p));
        result.cloud = target(std::move(points));
    }
    return result;
}

Fixture scaled(const Fixture& fixture, double factor) {
    Fixture result = fixture;
    result.name += ", scaled";
    result.complex = nullptr;
    for (Vec3& p : result.view.positions) p *= factor;
    for (double& area : result.view.face_areas) area *= factor * factor;
    result.view.mean_edge *= factor;
    result.box = {factor * fixture.box.low, factor * fixture.box.high};
    if (fixture.cloud) {
        std::vector<Vec3> points(fixture.cloud->points().begin(), fixture.cloud->points().end());
        for (Vec3& p : points) p *= factor;
        result.cloud = target(std::move(points));
    }
    return result;
}

Fixture reordered(const Fixture& fixture, const std::vector<std::uint32_t>& order) {
    Fixture result = fixture;
    result.name += ", its vertices in another order";
    result.complex = nullptr;
    const surface::SurfaceView& from = fixture.view;
    surface::SurfaceView& to = result.view;
    std::vector<std::uint32_t> place(order.size());
    to.face_offsets = {0};
    to.vertex_faces.clear();
    for (std::uint32_t i = 0; i < order.size(); ++i) {
        const std::uint32_t old = order[i];
        place[old] = i;
        to.vertex_ids[i] = from.vertex_ids[old];
        to.positions[i] = from.positions[old];
        to.normals[i] = from.normals[old];
        to.movable[i] = from.movable[old];
        to.previous_positions[i] = from.previous_positions[old];
        to.arrived[i] = from.arrived[old];
        to.age[i] = from.age[old];
        const auto faces = from.faces_of(old);
        to.vertex_faces.insert(to.vertex_faces.end(), faces.begin(), faces.end());
        to.face_offsets.push_back(static_cast<std::uint32_t>(to.vertex_faces.size()));
    }
    for (auto& face : to.faces) {
        for (std::uint32_t& v : face) v = place[v];
    }
    return result;
}

}  // namespace dsc::conformance
