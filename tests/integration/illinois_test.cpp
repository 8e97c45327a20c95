// The Illinois DSC: each class' repair on meshes with flat tets of that class, and the two demos,
// whose figures are in strategies/improvement/illinois/README.md.
#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <sstream>

#include <doctest/doctest.h>

#include <dsc/base/random.hpp>
#include <dsc/geometry/quality.hpp>
#include <dsc/hooks/improvement.hpp>
#include <dsc/io/read.hpp>
#include <dsc/kernel/deformer.hpp>
#include <dsc/mesh/adopt.hpp>
#include <dsc/mesh/validate.hpp>

#include "../unit/mesh/meshes.hpp"
#include "results.hpp"

namespace {

using namespace dsc;
using dsc::test::Cli;
using nlohmann::json;

// ---- repairs on small meshes --------------------------------------------------------------------

/// Takes v to `target`, or says that a tet would not stay positive.
bool place(mesh::Complex& c, mesh::VertexId v, const Vec3& target) {
    std::vector<mesh::TetId> star;
    c.star(v, star);
    const bool positive = std::all_of(star.begin(), star.end(), [&](mesh::TetId t) {
        std::array<Vec3, 4> p;
        for (unsigned i = 0; i < 4; ++i)
            p[i] = c.tet(t).v[i] == v ? target : c.position(c.tet(t).v[i]);
        return geometry::tet_quality(p[0], p[1], p[2], p[3]) > 1e-4;
    });
    if (positive) c.move(v, target, star);
    return positive;
}

/// Presses two opposite edges of the tet together until they almost cross.
bool press(mesh::Complex& c, mesh::TetId t) {
    const auto v = c.tet(t).v;
    if (c.quality(t) < 0.8F) return false;
    const Vec3 across =
        0.5 * (c.position(v[2]) + c.position(v[3]) - c.position(v[0]) - c.position(v[1]));
    bool done = true;
    for (unsigned i = 0; i < 4; ++i)
        done = place(c, v[i], c.position(v[i]) + (i < 2 ? 0.49 : -0.49) * across) && done;
    return done;
}

/// A grid whose inner vertices are shaken, and in it a tet made flat, of the class that is wanted.
bool flatten(mesh::Complex& c, const std::string& flat_class, RandomStream& random) {
    for (mesh::VertexId v = 0; v < c.vertex_slots(); ++v) {
        if (!c.on_box(v))
            place(c, v,
                  c.position(v) + 0.04 * Vec3(random.normal(), random.normal(), random.normal()));
    }
    for (int attempt = 0; attempt < 200; ++attempt) {
        const auto t = static_cast<mesh::TetId>(random.index(c.tet_slots()));
        const auto v = c.tet(t).v;
        const auto p = [&](unsigned i) { return c.position(v[i]); };
        if (std::any_of(v.begin(), v.end(), [&](mesh::VertexId x) { return c.on_box(x); }) ||
            c.on_interface(v[0]))
            continue;
        if (flat_class == "sliver") {
            if (std::none_of(v.begin(), v.end(),
                             [&](mesh::VertexId x) { return c.on_interface(x); }) &&
                press(c, t))
                return true;
            continue;
        }
        Vec3 target = p(0);
        if (flat_class == "wedge") target = p(1);
        if (flat_class == "tee") target = 0.5 * (p(1) + p(2));
        if (flat_class == "cap") target = (p(1) + p(2) + p(3)) / 3.0;
        if (place(c, v[0], p(0) + 0.97 * (target - p(0)))) return true;
    }
    return false;
}

kernel::RepairPolicy policy_of(hooks::Improvement& improvement, const hooks::StepContext& context) {
    kernel::RepairPolicy policy;
    policy.propose = [&](const repair::RepairRound& round, std::vector<repair::Request>& out) {
        improvement.propose(context, round, out);
    };
    policy.topology = improvement.topology_limits();
    policy.flatness = improvement.flatness();
    return policy;
}

struct Tally {
    int meshes = 0, repaired = 0, valid = 0, grown = 0;
};

/// What a round without motion does to such meshes.
Tally repair_meshes(const std::string& flat_class, bool fallbacks) {
    host::Host host;
    dsc::test::load_strategies(host);
    Tally tally;
    for (std::uint64_t n = 0; n < 40; ++n) {
        RandomStream random(RandomKey{n, stream_id(flat_class), 0, 0});
        mesh::Complex c = mesh::adopt(dsc::test::cube_grid(7), "cube");
        if (!flatten(c, flat_class, random)) continue;
        ++tally.meshes;
        const float before = c.least_quality();
        const std::size_t vertices = c.vertex_count();
        const auto improvement = host.create<hooks::Improvement>(
            {"illinois", config::ConfigNode::map({{"fallbacks", fallbacks}})}, "improvement");
        const std::vector<std::string> names = improvement->repair_classes();
        const auto own = static_cast<std::size_t>(
            std::find(names.begin(), names.end(), flat_class) - names.begin());
        const surface::SurfaceView view;
        const hooks::StepContext context{.surface = view, .box = c.box(), .to_normalised = {}};
        kernel::Deformer deformer(std::move(c));
        const kernel::StepReport report = deformer.step({}, {}, policy_of(*improvement, context));
        tally.valid += mesh::validate(deformer.complex()).valid() ? 1 : 0;
        const bool better = deformer.complex().least_quality() > before;
        tally.repaired += better && (fallbacks || report.repair_classes[own].committed > 0) ? 1 : 0;
        tally.grown += deformer.complex().vertex_count() > vertices ? 1 : 0;
        if (fallbacks) continue;
        for (std::size_t i = 4; i < names.size(); ++i) CHECK(report.repair_classes[i].tried == 0);
    }
    return tally;
}

// ---- demos --------------------------------------------------------------------------------------

struct Demo {
    json summary;
    std::size_t vertices = 0;                         // of the written volume
    std::map<std::string, std::uint64_t> requested;   // by class, from events.jsonl
    std::vector<std::map<std::string, double>> rows;  // of metrics.csv, from the first step on
};

Demo run_demo(const std::string& name, const std::vector<std::string>& overrides = {}) {
    const Cli cli;
    std::vector<std::string> arguments = {"run", dsc::test::config("demos/" + name + ".yaml"), "-o",
                                          "out", "-q"};
    arguments.insert(arguments.end(), overrides.begin(), overrides.end());
    REQUIRE(cli.dsc(arguments).code == 0);
    dsc::test::check_result(cli.folder() / "out");
    Demo demo;
    demo.summary = dsc::test::summary_of(cli, "out");
    demo.vertices = io::read_volume(cli.folder() / "out/result/volume.dsc").points.size();
    std::istringstream events(cli.read("out/events.jsonl"));
    for (std::string line; std::getline(events, line);) {
        const json event = json::parse(line);
        CHECK(event["kind"] == "repair");
        demo.requested[event["class"]] += event["requested"].get<std::uint64_t>();
    }
    std::istringstream metrics(cli.read("out/metrics.csv"));
    std::string header;
    std::getline(metrics, header);
    std::string start;
    std::getline(metrics, start);
    for (std::string line; std::getline(metrics, line);) {
        std::istringstream names(header), cells(line);
        auto& row = demo.rows.emplace_back();
        for (std::string column, cell;
             std::getline(names, column, ',') && std::getline(cells, cell, ',');) {
            if (!cell.empty()) row[column] = std::stod(cell);
        }
    }
    return demo;
}

void check_targets_reached(const Demo& demo) {
    CHECK(demo.summary["dropped_motion"].get<double>() < 1e-9);
    for (const auto& row : demo.rows) CHECK(row.at("arrived") == row.at("requested"));
}

/// Angle by which the vertices turned in the mean, in steps of one degree.
double turned(const Demo& demo) {
    double sum = 0.0;
    for (const auto& row : demo.rows)
        sum += 1.0 - row.at("dropped_motion") / (row.at("mean_speed") * row.at("requested"));
    return sum;
}

double figure(const Demo& demo, const char* name) {
    return demo.summary["observers"]["analytic"][name].get<double>();
}

const std::set<std::string> four_classes = {"wedge", "tee", "cap", "sliver"};
const std::set<std::string> allowed = {"wedge",        "tee",          "cap",       "sliver",
                                       "edge_removal", "face_removal", "smoothing", "collapse"};

}  // namespace

TEST_CASE("illinois: flat tets of each class are repaired, with fall-backs and without") {
    for (const std::string& flat_class : four_classes) {
        CAPTURE(flat_class);
        const Tally with = repair_meshes(flat_class, true);
        CHECK(with.meshes >= 30);
        CHECK(with.valid == with.meshes);
        CHECK(with.repaired == with.meshes);
        const Tally without = repair_meshes(flat_class, false);
        CHECK(without.valid == without.meshes);
        CHECK(without.repaired * 10 >= without.meshes * 9);
        // A sliver's own repair makes a vertex.
        if (flat_class == "sliver") CHECK(without.grown > 0);
        MESSAGE(flat_class << ": by its class alone " << without.repaired << " of "
                           << without.meshes);
    }
}

TEST_CASE("rotate_sphere_illinois: all the way round, every vertex at its target after every step, "
          "no run-away") {
    const Demo demo = run_demo("rotate_sphere_illinois");
    CHECK(demo.summary["status"] == "max_steps");
    CHECK(demo.rows.size() == 360);
    check_targets_reached(demo);
    for (const auto& row : demo.rows) {
        CHECK(std::abs(row.at("observers.analytic.vertex_ratio") - 1.0) <= 0.2);
        CHECK(std::abs(row.at("tets") / 69120.0 - 1.0) <= 0.2);
    }
    CHECK(std::abs(static_cast<double>(demo.vertices) / (25 * 25 * 25) - 1.0) <= 0.2);
    CHECK(figure(demo, "volume_drift") < 1e-3);
    CHECK(figure(demo, "distance_ratio") < 1.2);
    for (const auto& [name, count] : demo.requested) {
        CAPTURE(name);
        CHECK(allowed.count(name) == 1);
        CHECK(demo.summary["repair_classes"][name]["tried"] == count);
    }
    for (const std::string& flat_class : four_classes) {
        CAPTURE(flat_class);
        CHECK(demo.requested.at(flat_class) >= 100);
        CHECK(demo.summary["repair_classes"][flat_class]["committed"].get<int>() >= 100);
    }
}

TEST_CASE("rotate_sphere_illinois without fall-backs: locks before it is half-way to 90 degrees, "
          "and says stalled") {
    const Demo demo = run_demo("rotate_sphere_illinois", {"improvement.fallbacks=false"});
    CHECK(demo.summary["status"] == "stalled");
    CHECK(demo.summary["steps"].get<int>() < 120);
    CHECK(turned(demo) < 45.0);
    for (const auto& [name, count] : demo.requested) CHECK(four_classes.count(name) == 1);
    CHECK(demo.summary["tets"].get<int>() < 1.2 * 69120);
    for (const auto& row : demo.rows) CHECK(row.at("rounds") <= 50);
}

TEST_CASE(
    "rotate_sphere_corner_box: the thesis' start, all the way round, every vertex at its target") {
    const Demo demo = run_demo("rotate_sphere_corner_box");
    CHECK(demo.summary["status"] == "max_steps");
    check_targets_reached(demo);
    CHECK(figure(demo, "radius_error") < 1e-3);
    CHECK(figure(demo, "distance_ratio") < 1.2);
    CHECK(demo.requested.at("spoke") > 0);
    // The start has 2,633 vertices and 15,132 tets; growth is told, not bounded.
    MESSAGE(demo.vertices << " vertices, " << demo.rows.back().at("tets")
                          << " tets, interface vertices by " << figure(demo, "vertex_ratio"));
}

TEST_CASE("rotate_sphere_corner_box without fall-backs: the thesis' deadlock near 55 degrees is "
          "reported as stalled") {
    const Demo demo = run_demo(
        "rotate_sphere_corner_box",
        {"improvement.fallbacks=false", "improvement.longest_spoke=0", "initial_mesh.divisions=7"});
    CHECK(demo.summary["status"] == "stalled");
    CHECK(turned(demo) > 45.0);
    CHECK(turned(demo) < 65.0);
    for (const auto& row : demo.rows) CHECK(row.at("rounds") <= 50);
    for (const auto& [name, count] : demo.requested) CHECK(four_classes.count(name) == 1);
    MESSAGE("turned by " << turned(demo) << " degrees in " << demo.rows.size() << " steps");
}
