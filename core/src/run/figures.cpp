// Texts of events.jsonl, and the sums over the steps of a run.
#include "dsc/run/figures.hpp"

#include <fmt/format.h>

#include <dsc/text/numbers.hpp>

namespace dsc::run {

std::string_view name(Status status) {
    switch (status) {
        case Status::converged: return "converged";
        case Status::max_steps: return "max_steps";
        case Status::stalled: return "stalled";
        case Status::cancelled: return "cancelled";
    }
    return "cancelled";
}

std::string event_line(const kernel::Event& event, const cloud::Transform& to_normalised) {
    const Vec3 place = to_normalised.inverse(event.place);
    const double scale = to_normalised.scale;
    return fmt::format(R"({{"kind":"{}","step":{},"place":[{},{},{}],"label":{},"tets":{},)"
                       R"("volume":{},"thickness":{}}})"
                       "\n",
                       kernel::name(event.kind), event.step, text::exact(place.x()),
                       text::exact(place.y()), text::exact(place.z()), event.label, event.tets,
                       text::exact(event.volume / (scale * scale * scale)),
                       text::exact(event.thickness));
}

std::string class_line(const ClassFigures& figures) {
    return fmt::format(R"({{"kind":"repair","step":{},"class":"{}","requested":{},"committed":{}}})"
                       "\n",
                       figures.step, figures.repair_class, figures.requested, figures.committed);
}

void RefinementCounts::add(const kernel::RefineReport& report) {
    splits += report.splits;
    collapses += report.collapses;
    flips += report.flips;
    moves += report.moves;
}

void RunTotals::add(const kernel::StepReport& report) {
    ++steps;
    rounds += report.rounds;
    requested += report.requested;
    arrived += report.arrived;
    clamped += report.clamped;
    dropped_motion += report.dropped_motion;
    crease_exceptions += report.crease_exceptions;
    edit_distance += report.edit_distance;
    edit_volume += report.edit_volume;
    relabelled_volume += report.relabelled_volume;
    for (std::size_t i = 0; i < operations.size(); ++i) operations[i] += report.operations[i];
    for (std::size_t i = 0; i < repair_classes.size(); ++i)
        repair_classes[i] += report.repair_classes[i];
    events += report.event_counts;
    seconds.move += report.move_time;
    seconds.improve += report.repair_time;
}

std::uint64_t RunTotals::refused(repair::Refusal reason) const {
    std::uint64_t sum = 0;
    for (const kernel::OperationCounts& counts : operations)
        sum += counts.refused[static_cast<std::size_t>(reason)];
    return sum;
}

}  // namespace dsc::run
