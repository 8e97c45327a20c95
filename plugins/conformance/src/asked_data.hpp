#pragma once
// The parts of a context that a strategy asks for: faces of the points, support, volume.

#include <optional>
#include <vector>

#include <dsc/hooks/context.hpp>
#include <dsc/hooks/support.hpp>
#include <dsc/mesh/volume_view.hpp>

#include "fixtures.hpp"
#include "guarded_input.hpp"

namespace dsc::conformance {

/// Contains the data of one context, which is valid until the next call.
class AskedData {
public:
    /// The context with what the strategy asks for, as in a run.
    template <class Hook>
    hooks::StepContext complete(const Hook& hook, hooks::StepContext context) {
        faces_ = {};
        support_ = {};
        if (context.cloud == nullptr || context.surface.face_count() == 0) return context;
        const bool faces = hook.needs_faces_of_points(), support = hook.needs_support();
        std::vector<surface::FacePoint> found;
        if (faces || support)
            surface::nearest_faces(context.surface, context.cloud->points(), found,
                                   context.workers);
        if (support) {
            std::vector<double> measured;
            hooks::measure_support(context.surface, *context.cloud, found, measured,
                                   context.workers);
            support_ = in_guarded_memory([&] { return std::vector<double>(measured); });
            name_memory(support_.data(), "the support of the vertices");
            context.support = support_;
        }
        if (faces) {
            faces_ = in_guarded_memory([&] { return std::vector<surface::FacePoint>(found); });
            name_memory(faces_.data(), "the nearest faces of the points");
            context.faces_of_points = faces_;
        }
        return context;
    }

    /// The same with the tets, if the fixture has any.
    template <class Hook>
    hooks::StepContext complete(const Hook& hook, const hooks::StepContext& given,
                                const Fixture& fixture) {
        hooks::StepContext context = complete(hook, given);
        if (fixture.complex) context.volume = &volume_.emplace(*fixture.complex);
        return context;
    }

private:
    std::vector<surface::FacePoint> faces_;
    std::vector<double> support_;
    std::optional<mesh::VolumeView> volume_;
};

}  // namespace dsc::conformance
