// dsc_gate SCENARIO: one small fixed piece of work, whose instructions gate.py counts. Only what
// lies inside the function dsc_measured counts. Prints what came out of the work, so that a change
// of results can be told from a change of cost.
#include <cstdio>
#include <functional>
#include <map>
#include <string>

#include <dsc/base/error.hpp>
#include <dsc/base/random.hpp>

#include "pipeline.hpp"
#include "resources.hpp"

namespace {

using namespace dsc;
using namespace dsc::bench;

const std::vector<std::string> cube = {"cells=14"};

Vec3 random_way(std::uint64_t step, std::uint64_t birth, double length) {
    RandomStream random(RandomKey{1, stream_id("gate"), step, birth});
    return length * Vec3(random.normal(), random.normal(), random.normal()).normalized();
}

Body make_body(const Plugins& plugins, const std::vector<std::string>& parameters) {
    return Body(initial_complex(plugins, strategy("grid", parameters)),
                plugins.host().create<hooks::Improvement>(strategy("dsc", {}), "improvement"));
}

// Every vertex a little way, in all directions.
void shake(Body& body, std::uint64_t step, double part) {
    const double length = part * body.deformer().target_length();
    body.step([&](const hooks::StepContext& context, std::span<Vec3> out) {
        for (std::size_t i = 0; i < out.size(); ++i)
            out[i] = random_way(step, context.surface.births[i], length);
    });
}

std::string state_of(const mesh::Complex& complex) {
    return std::to_string(complex.interface_vertices().size()) + " interface vertices, " +
           std::to_string(complex.tet_count()) + " tets";
}
std::string state_of(const Body& body) { return state_of(body.deformer().complex()); }

/// Reads its complex from arrays: validation, adjacency, order.
std::string adopt() {
    const Plugins plugins;
    std::string result;
    const config::StrategyConfig mesh = strategy("grid", cube);
    measured([&] { result = state_of(initial_complex(plugins, mesh)); });
    return result;
}

/// Moves alone, no repair.
std::string move() {
    const Plugins plugins;
    kernel::Deformer deformer(initial_complex(plugins, strategy("grid", cube)));
    surface::SurfaceView view;
    double dropped = 0.0;
    measured([&] {
        for (std::uint64_t step = 0; step < 5; ++step) {
            surface::build_view(deformer.complex(), view);
            std::vector<Vec3> way;
            for (const std::uint32_t birth : view.births)
                way.push_back(random_way(step, birth, 0.05 * deformer.target_length()));
            dropped += deformer.step(view.vertex_ids, way, {}).dropped_motion;
        }
    });
    return state_of(deformer.complex()) + ", dropped " + std::to_string(dropped);
}

/// What an interface that was shaken without any repair asks for.
std::string repair() {
    const Plugins plugins;
    kernel::Deformer deformer(initial_complex(plugins, strategy("grid", cube)));
    surface::SurfaceView view;
    for (std::uint64_t step = 0; step < 4; ++step) {
        surface::build_view(deformer.complex(), view);
        std::vector<Vec3> way;
        for (const std::uint32_t birth : view.births)
            way.push_back(random_way(step, birth, 0.4 * deformer.target_length()));
        deformer.step(view.vertex_ids, way, {});
    }
    Body body(deformer.complex(),
              plugins.host().create<hooks::Improvement>(strategy("dsc", {}), "improvement"));
    std::uint64_t committed = 0;
    measured([&] {
        for (int i = 0; i < 3; ++i) committed += body.idle().committed;
    });
    return state_of(body) + ", " + std::to_string(committed) + " operations";
}

/// Two balls driven together until they are one, and a little further.
std::string topology() {
    const Plugins plugins;
    Body body = make_body(plugins, {"cells=14", "shape=none",
                                    "shapes=[{shape: sphere, centre: [-0.6, 0, 0], radius: 0.45}, "
                                    "{shape: sphere, centre: [0.6, 0, 0], radius: 0.45}]"});
    std::size_t events = 0;
    measured([&] {
        for (int step = 0; step < 6; ++step) {
            const double length = 0.25 * body.deformer().target_length();
            events +=
                body.step([&](const hooks::StepContext& context, std::span<Vec3> out) {
                        for (std::size_t i = 0; i < out.size(); ++i) {
                            out[i] = Vec3(context.surface.positions[i].x() < 0.0 ? length : -length,
                                          0.0, 0.0);
                        }
                    })
                    .events;
        }
    });
    if (events == 0)
        throw GeometryError("gate.topology",
                            "scenario topology: the balls did not merge, so it measures nothing");
    return state_of(body) + ", " + std::to_string(events) + " events";
}

/// A cube on its way to the teapot, the velocity and all.
std::string deform() {
    const Plugins plugins;
    Protocol protocol(plugins, plugins.load(thesis_file("teapot"),
                                            {"input.cloud={sample: {shape: teapot, n: 1000}}",
                                             "initial_mesh.cells=14", "schedule=[{steps: 5}]"}));
    measured([&] { protocol.run_to(5); });
    return state_of(protocol.body());
}

/// Refinement and the steps after it.
std::string refine() {
    const Plugins plugins;
    Protocol protocol(
        plugins,
        plugins.load(thesis_file("teapot"),
                     {"input.cloud={sample: {shape: teapot, n: 1000}}", "initial_mesh.cells=10",
                      "schedule=[{steps: 5}, {refine: {type: average_area}}, {refine: {type: "
                      "average_area}}, {steps: 3}]"}));
    protocol.run_to(5);
    measured([&] { protocol.run_to(8); });
    return state_of(protocol.body());
}

/// Steps in which nothing moves, and steps in which one vertex does: the Deformer's part of them.
std::string idle() {
    const Plugins plugins;
    Body body = make_body(plugins, cube);
    for (std::uint64_t step = 0; step < 2; ++step) shake(body, step, 0.1);
    for (int i = 0; i < 5; ++i) body.idle();
    body.count_deformer();
    for (int i = 0; i < 20; ++i) body.idle();
    for (std::uint64_t i = 0; i < 20; ++i) {
        body.step([&](const hooks::StepContext& context, std::span<Vec3> out) {
            out[out.size() / 2] =
                random_way(i, context.surface.births[out.size() / 2], 0.02 * context.target_length);
        });
    }
    return state_of(body);
}

/// The interface as flat arrays.
std::string view() {
    const Plugins plugins;
    Body body = make_body(plugins, cube);
    shake(body, 0, 0.1);
    surface::SurfaceView out;
    measured([&] {
        for (int i = 0; i < 10; ++i) surface::build_view(body.deformer().complex(), out);
    });
    return state_of(body);
}

const std::map<std::string, std::function<std::string()>> scenarios = {
    {"adopt", adopt},   {"move", move},     {"repair", repair}, {"topology", topology},
    {"deform", deform}, {"refine", refine}, {"idle", idle},     {"view", view}};

int work(const std::string& word) {
    if (word == "--list") {
        for (const auto& [name, run] : scenarios) std::printf("%s\n", name.c_str());
        return 0;
    }
    if (word == "--build") {  // what instruction counts depend on, besides the sources
        std::printf("%s\n", DSC_BENCH_BUILD);
        return 0;
    }
    const auto found = scenarios.find(word);
    if (found == scenarios.end())
        throw UsageError("bench.usage", "there is no scenario '" + word + "'; --list names them");
    std::printf("%s\n", found->second().c_str());
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    try {
        if (argc != 2) throw UsageError("bench.usage", "dsc_gate SCENARIO | --list | --build");
        return work(argv[1]);
    } catch (const dsc::Error& error) {
        std::fprintf(stderr, "dsc_gate: %s\n", error.what());
        return static_cast<int>(error.exit_code());
    }
}
