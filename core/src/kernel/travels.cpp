// Destinations of the moving vertices: passes of movement, and updates after edits (method.md, sections 5 and 9).
#include "kernel/travels.hpp"

#include <string>

#include <dsc/base/error.hpp>

namespace dsc::kernel {

void Travels::clear() {
    active_.clear();
    travel_.clear();
    near_collapses_.clear();
    tried_ = 0;
    stranded_ = 0;
}

// The entry of v, even if v no longer exists; null if it has none.
Travels::Travel* Travels::way_of(VertexId v) {
    if (v >= travel_of_.size() || travel_of_[v] >= travel_.size()) return nullptr;
    Travel& way = travel_[travel_of_[v]];
    return way.vertex == v ? &way : nullptr;
}

bool Travels::travels(VertexId v) {
    const Travel* way = way_of(v);
    return way != nullptr && way->birth == complex_.birth(v);
}

void Travels::send(VertexId v, const Vec3& destination) {
    if (travel_of_.size() < complex_.vertex_slots()) travel_of_.resize(complex_.vertex_slots(), mesh::none);
    Travel* way = way_of(v);
    if (way == nullptr) {
        travel_of_[v] = static_cast<std::uint32_t>(travel_.size());
        way = &travel_.emplace_back();
    }
    *way = {destination, v, complex_.birth(v), 0, 0};
    active_.push_back(v);
}

void Travels::on_split(VertexId vertex, VertexId a, VertexId b, double s) {
    if (!complex_.movable(vertex) || (!travels(a) && !travels(b))) return;
    send(vertex, (1.0 - s) * destination_of(a) + s * destination_of(b));
}

void Travels::on_collapse(VertexId kept, VertexId removed, double s) {
    // The removed id no longer exists, but its entry does: births differ only after the slot is used again.
    const bool goes = way_of(removed) != nullptr;
    const bool stays = travels(kept);
    if ((!goes && !stays) || !complex_.movable(kept) || s == 0.0) return;
    const Vec3 from = stays ? way_of(kept)->destination : complex_.position(kept);
    const Vec3 to = goes ? way_of(removed)->destination : complex_.position(kept);
    send(kept, (1.0 - s) * from + s * to);
}

// What a pass does with active_[i].
struct Travels::Pass {
    enum Fate : std::uint8_t { asleep, arrived, moved, stopped };

    Travels& travels;
    const Limits& limits;
    const PassOptions& options;

    Travel& way(std::size_t i) const { return travels.travel_[travels.travel_of_[travels.active_[i]]]; }
    void decide(std::size_t i, Fate fate) const { travels.fates_[i] = fate; }

    bool ready(std::size_t i) const {
        const VertexId v = travels.active_[i];
        const Travel& goes = way(i);
        if (goes.blocked_at != 0 && !travels.queues_.awake(v, goes.blocked_at)) {
            decide(i, asleep);
            if (options.audit && travels.complex_.vertex_date(v) > goes.blocked_at) {
                throw GeometryError("kernel.audit", "audit: vertex " + std::to_string(v) +
                                                        " sleeps though its star changed; the queues of the kernel lost a wake-up");
            }
            return false;
        }
        decide(i, arrived);
        return !has_arrived(travels.complex_, limits, v, goes.destination);
    }

    bool attempt(std::size_t i, StarScratch& scratch) const {
        const Motion motion = plan_move(travels.complex_, limits, travels.active_[i], way(i).destination, options.free_path, scratch);
        decide(i, motion == Motion::arrived ? arrived : motion == Motion::moved ? moved : stopped);
        return motion != Motion::blocked;
    }

    void settle(std::size_t i, bool, std::uint32_t date) const {
        const auto fate = static_cast<Fate>(travels.fates_[i]);
        if (fate == asleep) return;
        ++travels.tried_;
        Travel& goes = way(i);
        goes.blocked_at = fate == stopped ? date : 0;
        if (fate == arrived) goes.vertex = mesh::none;
    }
};

void Travels::drop_dead_and_double() {
    ++pass_;
    std::size_t kept = 0;
    for (const VertexId v : active_) {
        if (v >= complex_.vertex_slots() || !complex_.vertex_alive(v) || !travels(v) || !complex_.movable(v)) continue;
        Travel& way = *way_of(v);
        if (way.listed == pass_) continue;
        way.listed = pass_;
        active_[kept++] = v;
    }
    active_.resize(kept);
}

double Travels::pass(const Limits& limits, const PassOptions& options) {
    drop_dead_and_double();
    fates_.resize(active_.size());
    Pass action{*this, limits, options};
    loop_.run(active_, options.workers, action);
    blocked_.clear();
    double left = 0.0;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < active_.size(); ++i) {
        if (fates_[i] == Pass::arrived) continue;
        const VertexId v = active_[i];
        const Travel& way = *way_of(v);
        if (way.blocked_at != 0) blocked_.push_back(v);
        left += (way.destination - complex_.position(v)).norm();
        active_[kept++] = v;
    }
    active_.resize(kept);
    return left;
}

void Travels::give_up(StepReport& report) {
    for (const VertexId v : active_) {
        if (!complex_.vertex_alive(v) || !travels(v)) continue;
        Travel& way = *way_of(v);
        report.dropped_motion += (way.destination - complex_.position(v)).norm();
        way.vertex = mesh::none;
        ++stranded_;
    }
    active_.clear();
}

}  // namespace dsc::kernel
