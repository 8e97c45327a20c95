// Makes the contexts of a run's strategies.
#include "step_data.hpp"

#include <dsc/hooks/support.hpp>

#include "refinement.hpp"

namespace dsc::run {

StepData::StepData(const kernel::Deformer& deformer, const ContextBase& base, Workers& workers)
    : deformer_(deformer), base_(base), workers_(workers), volume_(deformer.complex()) {}

void StepData::refresh() {
    surface::build_view(deformer_.complex(), view_, &workers_, &view_memory_);
    history_.note_births(deformer_.complex().next_birth(), deformer_.step_count());
    history_.apply(deformer_.step_count(), view_);
    faces_of_points_.clear();
    support_.clear();
    refresh_fields();
    // The velocity of the next step and the figures of this one use the nearest points.
    if (base_.cloud != nullptr) nearest_.refresh(view_, base_.cloud->search(), &workers_);
}

void StepData::refresh_fields() {
    lengths_ = deformer_.target_lengths(view_.vertex_ids);
    attributes_ = attributes_at(deformer_, view_.vertex_ids);
}

hooks::StepContext StepData::context(std::uint64_t step, std::uint64_t planned_steps,
                                     const Needs& needs) {
    hooks::StepContext context{
        .step = step,
        .surface = view_,
        .cloud = base_.cloud,
        .nearest = nearest_.all(),
        .target_length = deformer_.target_length(),
        .box = deformer_.complex().box(),
        .to_normalised = base_.cloud != nullptr ? base_.cloud->transform() : cloud::Transform{},
        .seed = base_.seed,
        .instance = 0,
        .workers = &workers_,
        .planned_steps = planned_steps,
        .target_lengths = lengths_,
        .attributes = attributes_};
    add(needs, context);
    return context;
}

void StepData::add(const Needs& needs, hooks::StepContext& context) {
    if (needs.volume) context.volume = &volume_;
    if (base_.cloud == nullptr || (!needs.faces_of_points && !needs.support)) return;
    if (faces_of_points_.empty())
        surface::nearest_faces(view_, base_.cloud->points(), faces_of_points_, &workers_);
    if (needs.faces_of_points) context.faces_of_points = faces_of_points_;
    if (!needs.support || view_.face_count() == 0) return;
    if (support_.empty())
        hooks::measure_support(view_, *base_.cloud, faces_of_points_, support_, &workers_);
    context.support = support_;
}

}  // namespace dsc::run
