#include "dsc/sdk/steps.hpp"

#include <dsc/base/workers.hpp>
#include <dsc/hooks/support.hpp>

namespace dsc::sdk {

hooks::StepContext step_context(const surface::SurfaceView& view, std::uint64_t step) {
    return {.step = step,
            .surface = view,
            .target_length = view.mean_edge,
            .box = {Vec3::Constant(-1.5), Vec3::Constant(1.5)},
            .to_normalised = {}};
}

std::vector<Vec3> displacements(hooks::VelocityField& field, const hooks::StepContext& context,
                                unsigned threads, std::size_t block) {
    hooks::StepContext full = context;
    std::vector<surface::FacePoint> faces;
    std::vector<double> support;
    if (context.cloud != nullptr && (field.needs_faces_of_points() || field.needs_support()))
        surface::nearest_faces(context.surface, context.cloud->points(), faces);
    if (field.needs_faces_of_points()) full.faces_of_points = faces;
    if (context.cloud != nullptr && field.needs_support()) {
        hooks::measure_support(context.surface, *context.cloud, faces, support);
        full.support = support;
    }
    field.advance(full);
    field.prepare(full);
    std::vector<Vec3> out(context.surface.vertex_count());
    Workers workers(threads);
    workers.for_blocks(out.size(), block, [&](std::size_t begin, std::size_t end) {
        field.evaluate({begin, end}, std::span(out).subspan(begin, end - begin));
    });
    return out;
}

}  // namespace dsc::sdk
