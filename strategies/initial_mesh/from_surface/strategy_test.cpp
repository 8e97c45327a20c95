// Tests of the mesh; the plugin is loaded as in a run.
#include <algorithm>
#include <cmath>
#include <map>

#include <doctest/doctest.h>

#include <dsc/base/error.hpp>
#include <dsc/host/host.hpp>
#include <dsc/mesh/adopt.hpp>
#include <dsc/mesh/validate.hpp>
#include <dsc/sdk/surfaces.hpp>
#include <dsc/surface/measure.hpp>
#include <dsc/surface/surface_view.hpp>

namespace {

using dsc::Vec3;
using dsc::config::ConfigNode;
using dsc::mesh::TetMesh;
using dsc::surface::TriangleMesh;
constexpr double pi = 3.14159265358979323846;

/// Readers that return the same surface for any file.
struct OneFile final : dsc::hooks::MeshFiles {
    explicit OneFile(TriangleMesh held) : mesh(std::move(held)) {}
    TetMesh read_volume(const std::string&) const override { return {}; }
    TriangleMesh read_surface(const std::string&) const override { return mesh; }
    TriangleMesh mesh;
};

struct Built {
    TetMesh mesh;
    TriangleMesh surface;
    std::map<std::string, double> figures;
};

Built build(const TriangleMesh& surface,
            const std::vector<std::pair<std::string, ConfigNode>>& more = {},
            dsc::Workers* workers = nullptr, const dsc::cloud::TargetCloud* cloud = nullptr) {
    dsc::host::Host host;
    host.load(DSC_TEST_PLUGIN);
    ConfigNode params = ConfigNode::map({{"file", "given.obj"}});
    for (const auto& [key, value] : more) params = params.with(key, value);
    const auto strategy =
        host.create<dsc::hooks::InitialMesh>({"from_surface", params}, "initial_mesh");
    const OneFile file(surface);
    dsc::hooks::InitialMeshContext context;
    context.files = &file;
    context.workers = workers;
    context.cloud = cloud;
    Built out;
    out.mesh = strategy->build(context);
    out.surface = dsc::surface::extract_interface(out.mesh);
    for (const auto& [figure, value] : strategy->figures()) out.figures[figure] = value;
    return out;
}

TriangleMesh box(const Vec3& half) {
    TriangleMesh m;
    for (int i = 0; i < 8; ++i)
        m.points.push_back(half.cwiseProduct(
            Vec3((i & 1) != 0 ? 1 : -1, (i & 2) != 0 ? 1 : -1, (i & 4) != 0 ? 1 : -1)));
    m.faces = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
               {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
    return m;
}

TriangleMesh torus(int n, int m, double big, double small) {
    TriangleMesh out;
    const auto index = [&](int i, int j) {
        return static_cast<std::uint32_t>((i % n) * m + j % m);
    };
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < m; ++j) {
            const double u = 2 * pi * i / n, v = 2 * pi * j / m, r = big + small * std::cos(v);
            out.points.emplace_back(r * std::cos(u), r * std::sin(u), small * std::sin(v));
            out.faces.push_back({index(i, j), index(i + 1, j), index(i + 1, j + 1)});
            out.faces.push_back({index(i, j), index(i + 1, j + 1), index(i, j + 1)});
        }
    }
    return out;
}

TriangleMesh inside_out(TriangleMesh m) {
    for (auto& f : m.faces) std::swap(f[1], f[2]);
    return m;
}

TriangleMesh joined(TriangleMesh a, const TriangleMesh& b) {
    const auto offset = static_cast<std::uint32_t>(a.points.size());
    a.points.insert(a.points.end(), b.points.begin(), b.points.end());
    for (const auto& f : b.faces) a.faces.push_back({f[0] + offset, f[1] + offset, f[2] + offset});
    return a;
}

/// A valid complex without changes: positive, conforming, regular.
dsc::mesh::Complex check_sound(const TetMesh& mesh) {
    dsc::mesh::AdoptReport report;
    dsc::mesh::Complex complex = dsc::mesh::adopt(mesh, "from_surface", &report);
    CHECK(report.reoriented_tets == 0);
    CHECK(report.dropped_vertices == 0);
    CHECK(report.unpinched_vertices == 0);
    const auto found = dsc::mesh::validate(complex);
    CHECK(found.faults == std::vector<std::string>{});
    // The kernel's floor is 1e-3.
    CHECK(found.min_quality >= 0.0199);
    return complex;
}

void check_refused(const TriangleMesh& surface,
                   const std::vector<std::pair<std::string, ConfigNode>>& more,
                   const std::string& code, const char* text) {
    try {
        build(surface, more);
        FAIL("accepted");
    } catch (const dsc::Error& error) {
        CAPTURE(error.what());
        CHECK(error.code() == code);
        CHECK(std::string(error.what()).find(text) != std::string::npos);
    }
}

}  // namespace

TEST_CASE("sphere: distance, volume and area at three resolutions, the better the finer") {
    const double radius = 0.9;
    const TriangleMesh file = dsc::sdk::icosphere(5, radius);
    double last_volume = 1, last_away = 1;
    for (const int cells : {16, 32, 48}) {
        CAPTURE(cells);
        const Built b = build(file, {{"cells", cells}});
        const auto complex = check_sound(b.mesh);
        const auto counts = dsc::mesh::count_interface(complex);
        CHECK(counts.shells == 1);
        CHECK(counts.genus() == 0);
        const double cell = 3.0 / cells;
        double away = 0, flattest = 0;
        for (const Vec3& p : b.surface.points) away = std::max(away, std::abs(p.norm() - radius));
        for (const auto& [i, j, k] : b.surface.faces) {
            const Vec3 middle =
                (b.surface.points[i] + b.surface.points[j] + b.surface.points[k]) / 3;
            flattest = std::max(flattest, radius - middle.norm());
        }
        // The faces of the file lie up to 3.6e-4 inside the sphere; a chord of two cells lies up to
        // cell^2 / 2 r inside.
        CHECK(away < 0.15 * cell + 3.6e-4);
        CHECK(flattest < 0.7 * cell * cell / radius + 3.6e-4 + 0.1 * cell);
        const double volume =
            std::abs(dsc::surface::volume(b.surface) / (4 * pi / 3 * std::pow(radius, 3)) - 1);
        // Triangles of edges l with their corners on the sphere reduce the volume by l^2 / 4 r^2,
        // those of the file by 0.0003.
        const double edge = 1.6 * cell;
        CHECK(volume < edge * edge / (4 * radius * radius) + 0.0003);
        CHECK(volume < last_volume);
        CHECK(flattest < last_away);
        last_volume = volume;
        last_away = flattest;
        CHECK(b.figures.at("interface_to_surface") < 0.2);
        CHECK(b.figures.at("surface_to_interface") < 0.2);
        CHECK(b.figures.at("finest_cell") == doctest::Approx(cell));
    }
}

TEST_CASE("torus: one handle, its vertices on the torus") {
    const Built b = build(torus(96, 48, 0.75, 0.3), {{"cells", 32}});
    const auto complex = check_sound(b.mesh);
    const auto counts = dsc::mesh::count_interface(complex);
    CHECK(counts.shells == 1);
    CHECK(counts.genus() == 1);
    CHECK(b.figures.at("surface_genus") == 1);
    CHECK(b.figures.at("interface_genus") == 1);
    // The chords of the file lie up to 0.3 (1 - cos(pi / 48)) + 1.05 (1 - cos(pi / 96)) = 0.0012
    // inside.
    std::size_t off = 0;
    for (const Vec3& p : b.surface.points)
        off += std::abs(std::hypot(std::hypot(p.x(), p.y()) - 0.75, p.z()) - 0.3) > 1.3e-3 ? 1 : 0;
    CHECK(off * 100 <= b.surface.points.size());
    CHECK(dsc::surface::volume(b.surface) ==
          doctest::Approx(2 * pi * pi * 0.75 * 0.09).epsilon(0.03));
}

TEST_CASE("a box along the axes, its sides between the lattice's: edges and corners are there") {
    const Built b = build(box({0.83, 0.79, 0.81}), {{"cells", 40}});
    check_sound(b.mesh);
    CHECK(dsc::surface::volume(b.surface) ==
          doctest::Approx(8 * 0.83 * 0.79 * 0.81).epsilon(0.005));
    for (int i = 0; i < 8; ++i) {
        const Vec3 corner((i & 1) != 0 ? 0.83 : -0.83, (i & 2) != 0 ? 0.79 : -0.79,
                          (i & 4) != 0 ? 0.81 : -0.81);
        CHECK(std::any_of(b.surface.points.begin(), b.surface.points.end(),
                          [&](const Vec3& p) { return (p - corner).norm() < 1e-12; }));
    }
}

TEST_CASE("a rotated box: within the default tolerance, edges cut by a cell") {
    const Eigen::AngleAxisd turn(0.7, Vec3(1, 2, 3).normalized());
    const Built b = build(
        dsc::sdk::moved(box(Vec3::Constant(0.7)), [&](const Vec3& p) { return Vec3(turn * p); }));
    const auto complex = check_sound(b.mesh);
    CHECK(dsc::mesh::count_interface(complex).genus() == 0);
    CHECK(b.figures.at("vertex_distance") < 0.5);
    CHECK(b.figures.at("surface_to_interface") <= 1.5);
    CHECK(b.figures.at("surface_to_interface") > 0.1);
    CHECK(dsc::surface::volume(b.surface) == doctest::Approx(8 * std::pow(0.7, 3)).epsilon(0.04));
}

TEST_CASE("several shells, a cavity, faces turned inside out") {
    const auto at = [](const TriangleMesh& m, const Vec3& by) {
        return dsc::sdk::moved(m, [&](const Vec3& p) { return Vec3(p + by); });
    };
    const TriangleMesh ball = dsc::sdk::icosphere(3, 0.4);
    const Built two = build(joined(at(ball, {-0.6, 0, 0}), at(ball, {0.6, 0, 0})), {{"cells", 32}});
    CHECK(dsc::mesh::count_interface(check_sound(two.mesh)).shells == 2);
    const Built hollow =
        build(joined(dsc::sdk::icosphere(3, 0.9), inside_out(ball)), {{"cells", 32}});
    CHECK(dsc::mesh::count_interface(check_sound(hollow.mesh)).shells == 2);
    CHECK(dsc::surface::volume(hollow.surface) ==
          doctest::Approx(4 * pi / 3 * (0.729 - 0.064)).epsilon(0.03));
    const Built turned = build(inside_out(dsc::sdk::icosphere(3, 0.9)), {{"cells", 32}});
    const Built straight = build(dsc::sdk::icosphere(3, 0.9), {{"cells", 32}});
    CHECK(turned.mesh.tets == straight.mesh.tets);
    CHECK(turned.mesh.labels == straight.mesh.labels);
    CHECK(dsc::surface::volume(turned.surface) > 0);
}

TEST_CASE("overlapping bodies are one where intersections are allowed") {
    const auto at = [](double x) {
        return dsc::sdk::moved(dsc::sdk::icosphere(3, 0.5),
                               [x](const Vec3& p) { return Vec3(p + Vec3(x, 0.01, 0.02)); });
    };
    const TriangleMesh both = joined(at(-0.3), at(0.3));
    check_refused(both, {{"cells", 32}}, "surface.self_intersecting",
                  "pairs of faces intersect, the first at (");
    const Built b = build(both, {{"cells", 32}, {"intersections", 10000}, {"tolerance", 20.0}});
    const auto counts = dsc::mesh::count_interface(check_sound(b.mesh));
    CHECK(counts.shells == 1);
    CHECK(counts.genus() == 0);
}

TEST_CASE("fit, label, the cloud's coordinates") {
    const TriangleMesh far = dsc::sdk::moved(
        dsc::sdk::icosphere(3, 40.0), [](const Vec3& p) { return Vec3(p + Vec3(1000, -200, 30)); });
    const Built fitted = build(far, {{"cells", 24}, {"fit", 1.1}, {"label", 7}});
    for (const Vec3& p : fitted.surface.points) CHECK(std::abs(p.norm() - 1.1) < 0.02);
    CHECK(*std::max_element(fitted.mesh.labels.begin(), fitted.mesh.labels.end()) == 7);

    const dsc::cloud::TargetCloud cloud(dsc::cloud::normalize(dsc::cloud::Cloud{far.points}, 0.9));
    const Built placed = build(far, {{"cells", 24}, {"coordinates", "of_input"}}, nullptr, &cloud);
    for (const Vec3& p : placed.surface.points) CHECK(std::abs(p.norm() - 0.9) < 0.02);
    check_refused(far, {{"coordinates", "of_input"}}, "config.no_input",
                  "the experiment has no input");
    check_refused(far, {}, "lattice.box",
                  "beyond the box from (-1.6, -1.6, -1.6) to (1.6, 1.6, 1.6)");
}

TEST_CASE("the same bits with any number of threads") {
    const TriangleMesh file = torus(48, 24, 0.75, 0.3);
    dsc::Workers four(4);
    const Built one = build(file, {{"cells", 24}}), more = build(file, {{"cells", 24}}, &four);
    CHECK(one.mesh.points == more.mesh.points);
    CHECK(one.mesh.tets == more.mesh.tets);
    CHECK(one.mesh.labels == more.mesh.labels);
    CHECK(one.figures == more.figures);
}

TEST_CASE("a surface that bounds no solid is refused; the message states fault and place") {
    TriangleMesh open = box(Vec3::Constant(0.8));
    open.faces.pop_back();
    check_refused(open, {}, "surface.open",
                  "the surface is open: 3 edges with one face, the first at (0.8, ");
    TriangleMesh turned = box(Vec3::Constant(0.8));
    std::swap(turned.faces[4][0], turned.faces[4][1]);
    check_refused(turned, {}, "surface.misoriented",
                  "edges whose faces have opposite orientations, the first at (");
    // Two boxes along one common edge.
    TriangleMesh fin = box(Vec3::Constant(0.5));
    fin = joined(fin, dsc::sdk::moved(box(Vec3::Constant(0.5)),
                                      [](const Vec3& p) { return Vec3(p + Vec3(1, 1, 0)); }));
    check_refused(fin, {}, "surface.not_manifold",
                  "1 edge with more than two faces, the first at (0.5, 0.5, 0)");
    TriangleMesh flat;
    flat.points = {{0, 0, 0}, {1, 0, 0}};
    flat.faces = {{0, 1, 1}};
    check_refused(flat, {}, "surface.empty", "no face has three different corners");
}

TEST_CASE("a missed tolerance is refused with distance and place; surfaces that are too small or "
          "too large are refused") {
    check_refused(box({0.8, 0.8, 0.03}), {{"cells", 16}}, "from_surface.vanished",
                  "is smaller than a cell");
    // A needle that is thinner than a cell over its last cells.
    TriangleMesh needle;
    needle.points = {
        {-0.5, -0.5, -1}, {0.5, -0.5, -1}, {0.5, 0.5, -1}, {-0.5, 0.5, -1}, {0.01, 0.02, 1.4}};
    needle.faces = {{0, 2, 1}, {0, 3, 2}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}};
    check_refused(needle, {{"cells", 16}}, "from_surface.tolerance",
                  "more than the tolerance of 1.5; use more `cells`");
    check_refused(dsc::sdk::icosphere(3, 0.9), {{"cells", 16}, {"tolerance", 1e-6}},
                  "from_surface.tolerance", "finest cells apart at (");
    check_refused(dsc::sdk::moved(dsc::sdk::icosphere(1, 0.01),
                                  [](const Vec3& p) { return Vec3(p + Vec3(0.04, 0.04, 0.04)); }),
                  {{"cells", 16}}, "from_surface.vanished",
                  "is smaller than a cell of the lattice");
    check_refused(dsc::sdk::icosphere(3, 1.55), {{"cells", 32}}, "lattice.box",
                  "`fit` it into the box");
}

TEST_CASE("a host without readers gets an error") {
    dsc::host::Host host;
    host.load(DSC_TEST_PLUGIN);
    const auto strategy = host.create<dsc::hooks::InitialMesh>(
        {"from_surface", ConfigNode::map({{"file", "given.obj"}})}, "initial_mesh");
    CHECK_THROWS_WITH_AS(strategy->build({}), doctest::Contains("the host provides no readers"),
                         dsc::StrategyError);
}
