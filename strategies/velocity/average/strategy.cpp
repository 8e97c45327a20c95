#include "strategy.hpp"

namespace dsc::strategies {

void Average::declare(config::ParamSchema<Params>& schema) {
    schema.real("part", &Params::part)
        .range(0, 1)
        .unit("1")
        .doc("Fraction of the way to the mean of the neighbours that a vertex moves per step.");
}

Average::Average(const Params& params, const plugin::Setup&) : part_(params.part) {}

void Average::prepare(const hooks::StepContext& context) { surface_ = &context.surface; }

// Around a closed vertex every neighbour is in two faces, so the mean over the faces is the mean over the neighbours.
Vec3 Average::mean_of_neighbours(std::size_t vertex) const {
    Vec3 sum = Vec3::Zero();
    std::size_t count = 0;
    for (const std::uint32_t face : surface_->faces_of(vertex)) {
        for (const std::uint32_t v : surface_->faces[face]) {
            if (v == vertex) continue;
            sum += surface_->positions[v];
            ++count;
        }
    }
    return count == 0 ? surface_->positions[vertex] : Vec3(sum / static_cast<double>(count));
}

void Average::evaluate(hooks::Range range, std::span<Vec3> out) const {
    for (std::size_t i = 0; i < out.size(); ++i) {
        const std::size_t v = range.begin + i;
        out[i] = surface_->movable[v] ? Vec3(part_ * (mean_of_neighbours(v) - surface_->positions[v]))
                                      : Vec3(Vec3::Zero());
    }
}

}  // namespace dsc::strategies
