#include "idle.hpp"

#include "resources.hpp"

namespace dsc::bench {
namespace {

constexpr unsigned steps = 21;
constexpr unsigned most_settling = 60;

double deformer_seconds(const StepCost& cost) { return cost.seconds.move + cost.seconds.improve; }

}  // namespace

nlohmann::ordered_json quiet_steps(Body& body) {
    for (unsigned i = 0; i < most_settling && body.idle().committed > 0; ++i) {
    }
    std::vector<double> idle, one;
    std::uint64_t tried = 0;
    for (unsigned i = 0; i < steps; ++i) {
        const StepCost cost = body.idle();
        idle.push_back(1e3 * deformer_seconds(cost));
        tried = cost.tried;
    }
    const double stride = 0.05 * body.deformer().target_length();
    for (unsigned i = 0; i < steps; ++i) {
        one.push_back(1e3 * deformer_seconds(body.step([&](const hooks::StepContext& context,
                                                           std::span<Vec3> out) {
                          const auto& movable = context.surface.movable;
                          std::size_t v = out.size() / 2;
                          while (v + 1 < out.size() && movable[v] == 0) ++v;
                          out[v] = context.surface.normals[v] * (i % 2 == 0 ? -stride : stride);
                      })));
    }
    return {{"interface_vertices", body.view().vertex_count()},
            {"tets", body.deformer().complex().tet_count()},
            {"idle_ms", median(idle)},
            {"idle_max_ms", quantile(idle, 1.0)},
            {"idle_requests", tried},
            {"one_vertex_ms", median(one)}};
}

nlohmann::ordered_json exteriors(const Plugins& plugins) {
    // Cells of the same size, 30 and 66 along an edge: the cube in the middle is the same.
    const std::vector<std::string> near = {"cells=30", "box=1.5"}, far = {"cells=66", "box=3.3"};
    const config::StrategyConfig improvement = strategy("dsc", {});
    nlohmann::ordered_json out;
    for (const auto& [name, parameters] :
         {std::pair("thesis' box", near), std::pair("ten times the tets", far)}) {
        Body body(initial_complex(plugins, strategy("grid", parameters)),
                  plugins.host().create<hooks::Improvement>(improvement, "improvement"));
        out[name] = quiet_steps(body);
    }
    out["ratio"] = out["ten times the tets"]["idle_ms"].get<double>() /
                   out["thesis' box"]["idle_ms"].get<double>();
    return out;
}

}  // namespace dsc::bench
