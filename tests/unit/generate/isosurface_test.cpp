#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numeric>

#include <doctest/doctest.h>

#include <dsc/base/error.hpp>
#include <dsc/base/random.hpp>
#include <dsc/generate/isosurface.hpp>
#include <dsc/generate/lattice.hpp>
#include <dsc/geometry/predicates.hpp>
#include <dsc/geometry/quality.hpp>
#include <dsc/mesh/adopt.hpp>
#include <dsc/mesh/validate.hpp>

using namespace dsc;
using namespace dsc::mesh;
using namespace dsc::generate;

namespace {

using Field = std::function<double(const Vec3&)>;
using Key = std::vector<std::uint32_t>;

class Union {
public:
    explicit Union(std::size_t n) : parent_(n) {
        std::iota(parent_.begin(), parent_.end(), std::size_t{0});
    }
    std::size_t root(std::size_t i) {
        while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
        return i;
    }
    void join(std::size_t i, std::size_t j) { parent_[root(i)] = root(j); }

private:
    std::vector<std::size_t> parent_;
};

// Euler numbers of the components of a surface, ascending: its cells, each with the keys of its
// edges and vertices.
struct Cell {
    std::vector<Key> edges, vertices;
};
std::vector<long> euler_numbers(const std::vector<Cell>& cells) {
    std::map<Key, std::size_t> edges, vertices;  // to the first cell
    Union joined(cells.size());
    for (std::size_t i = 0; i < cells.size(); ++i) {
        for (const Key& e : cells[i].edges) joined.join(i, edges.emplace(e, i).first->second);
        for (const Key& v : cells[i].vertices) vertices.emplace(v, i);
    }
    std::map<std::size_t, long> euler;
    for (std::size_t i = 0; i < cells.size(); ++i) ++euler[joined.root(i)];
    for (const auto& [key, cell] : edges) --euler[joined.root(cell)];
    for (const auto& [key, cell] : vertices) ++euler[joined.root(cell)];
    std::vector<long> out;
    for (const auto& [root, number] : euler) out.push_back(number);
    std::sort(out.begin(), out.end());
    return out;
}

Key sorted(Key key) {
    std::sort(key.begin(), key.end());
    return key;
}

// The interface of marching tets: a polygon in each mixed tet, an edge in each mixed face, a vertex
// on each mixed edge.
std::vector<long> euler_numbers_of_labels(const TetMesh& lattice,
                                          const std::vector<double>& values) {
    const auto mixed = [&](const Key& key) {
        return std::any_of(key.begin(), key.end(),
                           [&](std::uint32_t v) { return values[v] > 0; }) &&
               std::any_of(key.begin(), key.end(), [&](std::uint32_t v) { return values[v] < 0; });
    };
    std::vector<Cell> cells;
    for (const auto& t : lattice.tets) {
        if (!mixed({t[0], t[1], t[2], t[3]})) continue;
        Cell cell;
        for (unsigned i = 0; i < 4; ++i) {
            for (unsigned j = i + 1; j < 4; ++j) {
                if (const Key edge = sorted({t[i], t[j]}); mixed(edge))
                    cell.vertices.push_back(edge);
            }
            if (const Key face = sorted({t[(i + 1) % 4], t[(i + 2) % 4], t[(i + 3) % 4]});
                mixed(face))
                cell.edges.push_back(face);
        }
        cells.push_back(cell);
    }
    return euler_numbers(cells);
}

// The same of the faces between different labels.
std::vector<long> euler_numbers_of_mesh(const TetMesh& mesh, std::size_t& vertices) {
    std::map<std::array<std::uint32_t, 3>, std::array<int, 2>> faces;  // tets of either label
    for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
        for (unsigned i = 0; i < 4; ++i) {
            std::array<std::uint32_t, 3> face{};
            for (unsigned k = 0; k < 3; ++k) face[k] = mesh.tets[t][(i + k + 1) % 4];
            std::sort(face.begin(), face.end());
            ++faces[face][mesh.labels[t] > 0 ? 1 : 0];
        }
    }
    std::vector<Cell> cells;
    std::vector<char> used(mesh.points.size(), 0);
    for (const auto& [f, count] : faces) {
        if (count[0] == 0 || count[1] == 0) continue;
        cells.push_back({{{f[0], f[1]}, {f[1], f[2]}, {f[0], f[2]}}, {{f[0]}, {f[1]}, {f[2]}}});
        for (const auto v : f) used[v] = 1;
    }
    vertices = static_cast<std::size_t>(std::count(used.begin(), used.end(), 1));
    return euler_numbers(cells);
}

TetMesh lattice_of(int cells, const SameWithin& same, double growth = 2.0) {
    LatticeOptions options;
    options.cells = cells;
    options.growth = growth;
    options.finest = LatticePattern::bcc;
    return make_lattice(options, same, "test");
}
TetMesh uniform(int cells) {
    return lattice_of(
        cells, [](const Vec3&, double) { return false; }, 1.0);
}
// Fine near the surface for x < 0 only, so that the surface runs through cells of all sizes.
TetMesh half_graded(int cells, const Field& distance) {
    return lattice_of(cells, [&](const Vec3& x, double radius) {
        return x.x() > radius || std::abs(distance(x)) > radius;
    });
}
TetMesh graded(int cells, const Field& distance) {
    return lattice_of(cells,
                      [&](const Vec3& x, double radius) { return std::abs(distance(x)) > radius; });
}

bool on_box(const Vec3& p, const Box3& box) {
    return (p.array() <= box.low.array()).any() || (p.array() >= box.high.array()).any();
}

std::vector<double> values_at(const TetMesh& mesh, const Field& field) {
    const Box3 box = bounding_box(mesh.points);
    std::vector<double> out;
    for (const Vec3& p : mesh.points) {
        const double f = on_box(p, box) ? -1.0 : field(p);
        out.push_back(f == 0 ? 1e-6 : f);
    }
    return out;
}

// Numbers without any order, or smoothed by a few rounds of averaging over edges.
std::vector<double> noise(const TetMesh& mesh, std::uint64_t seed, unsigned rounds) {
    RandomStream random({seed, 1, 2, 3});
    std::vector<double> f = values_at(mesh, [&](const Vec3&) { return random.uniform(-1.0, 1.0); });
    for (unsigned round = 0; round < rounds; ++round) {
        std::vector<double> sum(f.size(), 0.0), count(f.size(), 0.0);
        for (const auto& t : mesh.tets) {
            for (const auto v : t) {
                for (const auto w : t) {
                    sum[v] += f[w];
                    count[v] += 1;
                }
            }
        }
        for (std::size_t v = 0; v < f.size(); ++v) f[v] = sum[v] / count[v];
    }
    const Box3 box = bounding_box(mesh.points);
    for (std::size_t v = 0; v < f.size(); ++v)
        f[v] = on_box(mesh.points[v], box) ? -1.0 : f[v] == 0 ? 1e-6 : f[v];
    return f;
}

// Checks all that is promised and returns the report.
StuffReport check_stuffed(const TetMesh& lattice, const std::vector<double>& values,
                          const StuffOptions& options = {}) {
    StuffReport report;
    const TetMesh mesh =
        stuff_interface(lattice, values, options, &report, nullptr, nullptr, "test");
    std::size_t vertices = 0;
    CHECK(euler_numbers_of_mesh(mesh, vertices) == euler_numbers_of_labels(lattice, values));
    CHECK(report.interface_vertices == vertices);
    double least = 1.0;
    std::size_t inverted = 0, mislabelled = 0;
    std::vector<char> phases(mesh.points.size(), 0);
    for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
        const auto& [a, b, c, d] = mesh.tets[t];
        const auto& p = mesh.points;
        inverted += geometry::orient3d(p[a], p[b], p[c], p[d]) > 0 ? 0 : 1;
        least = std::min(least, geometry::tet_quality(p[a], p[b], p[c], p[d]));
        for (const auto v : mesh.tets[t])
            phases[v] = static_cast<char>(phases[v] | (mesh.labels[t] > 0 ? 2 : 1));
    }
    CHECK(inverted == 0);
    CHECK(least >= 0.05);
    CHECK(least == doctest::Approx(report.least_quality));
    if (report.collapsed_edges == 0) {
        // Vertices of the lattice that are not snapped stay on their side.
        for (std::size_t v = 0; v < values.size(); ++v)
            mislabelled += phases[v] == 3 || phases[v] == (values[v] > 0 ? 2 : 1) ? 0 : 1;
        CHECK(mislabelled == 0);
        CHECK(report.snapped_vertices + report.cut_vertices == vertices);
    }
    AdoptReport adopted;
    const Complex complex = adopt(mesh, "test", &adopted, 0.0);
    CHECK(adopted.reoriented_tets == 0);
    CHECK(adopted.unpinched_vertices == 0);
    CHECK(adopted.dropped_vertices == 0);
    CHECK(adopted.vanished_components == 0);
    CHECK(validate(complex).faults == std::vector<std::string>{});
    CHECK(count_interface(complex).faces == report.interface_faces);
    return report;
}

double ball(const Vec3& x) { return 0.9 - x.norm(); }
double torus(const Vec3& x) { return 0.28 - std::hypot(std::hypot(x.x(), x.y()) - 0.8, x.z()); }
double plate(const Vec3& x) {
    return std::min({0.9 - std::abs(x.x()), 0.9 - std::abs(x.y()), 0.04 - std::abs(x.z() - 0.013)});
}
double two_balls(const Vec3& x) {
    return 0.5 - std::min((x - Vec3(0.53, 0, 0)).norm(), (x + Vec3(0.53, 0, 0)).norm());
}
double gyroid(const Vec3& x) {
    const Vec3 y = 4.4 * x;
    const double g = std::sin(y.x()) * std::cos(y.y()) + std::sin(y.y()) * std::cos(y.z()) +
                     std::sin(y.z()) * std::cos(y.x());
    return std::min(g / 7.0, 1.1 - x.norm());
}

}  // namespace

TEST_CASE("stuffing keeps the topology of the labels on known shapes, even and graded") {
    for (const auto& [shape, genus] : std::vector<std::pair<Field, long>>{{ball, 0}, {torus, 1}}) {
        for (const TetMesh& lattice : {uniform(20), graded(32, shape), half_graded(32, shape)}) {
            const StuffReport report = check_stuffed(lattice, values_at(lattice, shape));
            CHECK(report.interface_faces ==
                  2 * report.interface_vertices - static_cast<std::size_t>(4 - 4 * genus));
            // Snapping takes most of the cut points away, and no tet is bad for shapes as simple as
            // these.
            CHECK(3 * report.interface_vertices < report.mixed_edges);
            CHECK(report.least_quality > 0.15);
        }
    }
    for (const Field& shape : {Field(plate), Field(two_balls), Field(gyroid)}) {
        for (const TetMesh& lattice : {uniform(20), graded(32, shape), half_graded(32, shape)}) {
            const StuffReport report = check_stuffed(lattice, values_at(lattice, shape));
            CHECK(report.interface_vertices < report.mixed_edges);
        }
    }
}

TEST_CASE("stuffing keeps the topology of any labels") {
    const TetMesh even = uniform(8), mixed_sizes = half_graded(24, ball);
    for (std::uint64_t seed = 0; seed < 6; ++seed) {
        for (const unsigned rounds : {0U, 1U, 3U}) {
            check_stuffed(even, noise(even, seed, rounds));
            if (seed < 2) check_stuffed(mixed_sizes, noise(mixed_sizes, seed, rounds));
        }
    }
}

TEST_CASE("stuffing leaves no more interface vertices than asked for, with the same topology") {
    for (const Field& shape : {Field(ball), Field(torus), Field(gyroid)}) {
        const TetMesh lattice = graded(32, shape);
        const std::vector<double> values = values_at(lattice, shape);
        StuffOptions options;
        const std::size_t all = check_stuffed(lattice, values).interface_vertices;
        for (const double share : {0.9, 0.5}) {
            options.most_interface_vertices =
                static_cast<std::size_t>(share * static_cast<double>(all));
            CHECK(check_stuffed(lattice, values, options).interface_vertices <=
                  options.most_interface_vertices);
        }
    }
    // Of no shape is more left than is needed for its topology where all is asked to go.
    StuffOptions options;
    options.most_interface_vertices = 0;
    const TetMesh lattice = uniform(8);
    for (std::uint64_t seed = 0; seed < 3; ++seed)
        check_stuffed(lattice, noise(lattice, seed, 1), options);
}

TEST_CASE("stuffing is near to the surface and smooth") {
    const TetMesh lattice = graded(48, ball);
    const TetMesh mesh =
        stuff_interface(lattice, values_at(lattice, ball), {}, nullptr, nullptr, nullptr, "test");
    const Complex c = adopt(mesh, "test");
    double worst = 0.0, turn = 1.0;
    for (const VertexId v : c.interface_vertices())
        worst = std::max(worst, std::abs(ball(c.position(v))));
    CHECK(worst < 0.2 * 3.0 / 48);
    for (TetId t = 0; t < c.tet_slots(); ++t) {
        for (unsigned f = 0; f < 4; ++f) {
            if (c.label(t) != 1 || !c.interface_face(t, f)) continue;
            std::array<Vec3, 3> p;
            for (unsigned k = 0; k < 3; ++k) p[k] = c.position(c.tet(t).v[face_vertices[f][k]]);
            turn = std::min(
                turn,
                geometry::triangle_normal(p[0], p[1], p[2]).dot((p[0] + p[1] + p[2]).normalized()));
        }
    }
    CHECK(turn > std::cos(0.35));
}

TEST_CASE("stuffing gives the same bytes with any number of threads") {
    const TetMesh lattice = graded(40, torus);
    const std::vector<double> values = values_at(lattice, torus);
    StuffOptions options;
    options.most_interface_vertices = 1500;
    const TetMesh one =
        stuff_interface(lattice, values, options, nullptr, nullptr, nullptr, "test");
    for (const unsigned threads : {1U, 3U}) {
        Workers workers(threads);
        const TetMesh other =
            stuff_interface(lattice, values, options, nullptr, &workers, nullptr, "test");
        CHECK(other.points == one.points);
        CHECK(other.tets == one.tets);
        CHECK(other.labels == one.labels);
    }
}

TEST_CASE("stuffing refuses what it cannot cut and stops when asked to") {
    const TetMesh lattice = uniform(6);
    std::vector<double> values = values_at(lattice, ball);
    const auto code = [&](const StuffOptions& options, const CancelToken* cancel) -> std::string {
        try {
            stuff_interface(lattice, values, options, nullptr, nullptr, cancel, "lattice");
        } catch (const Error& error) {
            return error.code();
        }
        return "";
    };
    CHECK(code({}, nullptr).empty());
    StuffOptions options;
    options.cut_low = 0.0;
    CHECK(code(options, nullptr) == "stuff.options");
    CancelToken cancel;
    cancel.cancel();
    CHECK(code({}, &cancel) == "run.cancelled");
    const Box3 box = bounding_box(lattice.points);
    const auto corner = std::find_if(lattice.points.begin(), lattice.points.end(),
                                     [&](const Vec3& p) { return p == box.low; });
    const auto at = static_cast<std::size_t>(corner - lattice.points.begin());
    values[at] = 0.5;
    CHECK(code({}, nullptr) == "stuff.box");
    values[at] = -0.5;
    CHECK(code({}, nullptr).empty());
    values[0] = 0.0;
    CHECK(code({}, nullptr) == "stuff.values");
    values[0] = NAN;
    CHECK(code({}, nullptr) == "stuff.values");
    values.pop_back();
    CHECK(code({}, nullptr) == "stuff.values");
}
