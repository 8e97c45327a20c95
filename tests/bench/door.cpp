// dsc_door plugin|linked: steps of the deformer driven by velocity point_cloud, which comes through
// the plugin's door, with the checks that it is wrapped in, or is linked into this program and
// called directly. door.py compares the instructions.
#include <cstdio>
#include <string>

#include <dsc/base/error.hpp>
#include <dsc/run/input.hpp>

#include "pipeline.hpp"
#include "resources.hpp"
// The class is local to its source.
#include "velocity/point_cloud/strategy.cpp"

namespace {

using namespace dsc;
using namespace dsc::bench;

constexpr int steps = 4;
constexpr std::size_t block = 256;  // as in the simulation

std::unique_ptr<hooks::VelocityField> field(const Plugins& plugins, bool linked) {
    if (!linked)
        return plugins.host().create<hooks::VelocityField>({"point_cloud", {}}, "velocity");
    return std::make_unique<PointCloud>(PointCloud::Params{},
                                        plugin::Setup(plugins.host(), "velocity"));
}

std::string outcome(bool linked) {
    const Plugins plugins;
    const run::LoadedExperiment loaded = thesis(plugins, "teapot", false);
    const run::LoadedInput input = run::load_input(*loaded.experiment.input, loaded.experiment.seed,
                                                   plugins.host(), *loaded.files);
    Body body(initial_complex(plugins, strategy("grid", std::vector<std::string>{"cells=20"})),
              plugins.host().create<hooks::Improvement>(strategy("dsc", {}), "improvement"),
              &input.target);
    const auto velocity = field(plugins, linked);
    const auto displace = [&](const hooks::StepContext& context, std::span<Vec3> out) {
        velocity->prepare(context);
        for (std::size_t begin = 0; begin < out.size(); begin += block) {
            const std::size_t end = std::min(begin + block, out.size());
            velocity->evaluate({begin, end}, out.subspan(begin, end - begin));
        }
    };
    body.step(displace);  // whatever is made once
    measured([&] {
        for (int i = 0; i < steps; ++i) body.step(displace);
    });
    return std::to_string(body.view().vertex_count()) + " interface vertices, mean edge " +
           config::real_text(body.view().mean_edge);
}

}  // namespace

int main(int argc, char** argv) {
    const std::string way = argc == 2 ? argv[1] : "";
    if (way != "plugin" && way != "linked") {
        std::fprintf(stderr, "dsc_door plugin|linked\n");
        return 2;
    }
    try {
        std::printf("%s\n", outcome(way == "linked").c_str());
        return 0;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
}
