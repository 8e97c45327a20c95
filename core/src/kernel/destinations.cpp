// Destinations of the moving vertices: passes of movement, and updates after edits (method.md,
// sections 5 and 9).
#include "kernel/destinations.hpp"

#include <atomic>
#include <string>
#include <utility>

#include <fmt/format.h>

#include <dsc/base/error.hpp>

namespace dsc::kernel {

void Destinations::clear() {
    active_.clear();
    clean_at_ = complex_.shape_clock();
    entries_.clear();
    near_collapses_.clear();
    not_arrived_.clear();
    // Few vertices need the list, so without this it could still grow in a settled step.
    not_arrived_.reserve(entries_.capacity());
    tried_ = 0;
    stranded_ = 0;
}

// The entry of v, even if v no longer exists; null if it has none.
Destinations::Entry* Destinations::entry_of(VertexId v) {
    if (v >= entry_of_vertex_.size() || entry_of_vertex_[v] >= entries_.size()) return nullptr;
    Entry& entry = entries_[entry_of_vertex_[v]];
    return entry.vertex == v ? &entry : nullptr;
}

bool Destinations::moves(VertexId v) {
    const Entry* entry = entry_of(v);
    return entry != nullptr && entry->birth == complex_.birth(v);
}

void Destinations::make_room() {
    if (entry_of_vertex_.size() < complex_.vertex_slots())
        entry_of_vertex_.resize(complex_.vertex_slots(), mesh::none);
}

void Destinations::send(VertexId v, const Vec3& destination) {
    make_room();
    Entry* entry = entry_of(v);
    if (entry == nullptr) {
        entry_of_vertex_[v] = static_cast<std::uint32_t>(entries_.size());
        entry = &entries_.emplace_back();
    } else {
        clean_at_ = never;
    }
    *entry = {destination, v, complex_.birth(v), 0, 0};
    active_.push_back(v);
}

// A vertex that was sent twice goes to its last destination.
void Destinations::find_double(Workers* workers) {
    constexpr std::size_t block = 4096;
    std::atomic<bool> found{false};
    for_blocks(workers, active_.size(), block, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            if (entry_of_vertex_[active_[i]] != i) found.store(true, std::memory_order_relaxed);
        }
    });
    if (!found) return;
    clean_at_ = never;
    for (std::uint32_t i = 0; i < active_.size(); ++i) entry_of_vertex_[active_[i]] = i;
}

Destinations::Sent Destinations::send(std::span<const VertexId> vertices,
                                      std::span<const Vec3> displacements, const Box3& inside,
                                      Workers* workers) {
    constexpr std::size_t block = 4096, ahead = 16;  // vertices
    make_room();
    // In this order, so that a vertex without displacement is not even looked at.
    const auto goes = [&](std::size_t i) {
        return !displacements[i].isZero(0.0) && complex_.movable(vertices[i]);
    };
    sent_before_.assign(block_count(vertices.size(), block), 0);
    for_blocks(workers, vertices.size(), block, [&](std::size_t begin, std::size_t end) {
        std::uint64_t requested = 0;
        for (std::size_t i = begin; i < end; ++i) {
            if (i + ahead < end) prefetch(vertices[i + ahead]);
            requested += goes(i) ? 1 : 0;
        }
        sent_before_[begin / block] = requested;
    });
    std::uint64_t count = 0;
    for (std::uint64_t& before : sent_before_) count += std::exchange(before, count);
    entries_.resize(count);
    active_.resize(count);
    if (count == 0) return {};
    std::atomic<std::uint64_t> clamped{0};
    for_blocks(workers, vertices.size(), block, [&](std::size_t begin, std::size_t end) {
        const std::size_t b = begin / block;
        auto at = static_cast<std::uint32_t>(sent_before_[b]);
        const std::uint64_t last = b + 1 < sent_before_.size() ? sent_before_[b + 1] : count;
        std::uint64_t outside = 0;
        for (std::size_t i = begin; at < last; ++i) {
            if (i + ahead < end) complex_.prefetch_birth(vertices[i + ahead]);
            if (!goes(i)) continue;
            const VertexId v = vertices[i];
            const Vec3 wanted = complex_.position(v) + displacements[i];
            const Vec3 place = wanted.cwiseMax(inside.low).cwiseMin(inside.high);
            outside += place != wanted ? 1 : 0;
            entries_[at] = {place, v, complex_.birth(v), 0, 0};
            active_[at] = v;
            std::atomic_ref(entry_of_vertex_[v]).store(at++, std::memory_order_relaxed);
        }
        clamped.fetch_add(outside, std::memory_order_relaxed);
    });
    find_double(workers);
    return {count, clamped};
}

void Destinations::on_split(VertexId vertex, VertexId a, VertexId b, double s) {
    if (!complex_.movable(vertex) || (!moves(a) && !moves(b))) return;
    send(vertex, (1.0 - s) * destination_of(a) + s * destination_of(b));
}

void Destinations::on_collapse(VertexId kept, VertexId removed, double s) {
    // The removed id no longer exists, but its entry does: births differ only after the slot is
    // used again.
    const bool goes = entry_of(removed) != nullptr;
    const bool stays = moves(kept);
    if ((!goes && !stays) || !complex_.movable(kept) || s == 0.0) return;
    const Vec3 from = stays ? entry_of(kept)->place : complex_.position(kept);
    const Vec3 to = goes ? entry_of(removed)->place : complex_.position(kept);
    send(kept, (1.0 - s) * from + s * to);
}

// What a pass does with active_[i].
struct Destinations::Pass {
    enum Note : std::uint8_t { asleep, arrived, moved, freed, stopped };

    Destinations& all;
    const Limits& limits;
    const PassOptions& options;

    Entry& of(VertexId v) const { return all.entries_[all.entry_of_vertex_[v]]; }
    Entry& at(std::size_t i) const { return of(all.active_[i]); }

    void prefetch(std::size_t, VertexId v) const { prefetch_line(&of(v)); }

    bool ready(std::size_t i, Note& fate) const {
        const VertexId v = all.active_[i];
        const Entry& entry = at(i);
        if (entry.blocked_at != 0 && !all.queues_.awake(v, entry.blocked_at)) {
            fate = asleep;
            if (options.audit && all.complex_.vertex_date(v) > entry.blocked_at) {
                throw GeometryError("kernel.audit", fmt::format("audit of vertex {}", v),
                                    "it is not tried again although its star changed; the queues "
                                    "of the kernel lost a change",
                                    "please report it with the experiment");
            }
            return false;
        }
        fate = arrived;
        return !has_arrived(all.complex_, limits, v, entry.place);
    }

    bool attempt(std::size_t i, StarScratch& scratch, std::uint32_t, Note& fate) const {
        const Entry& entry = at(i);
        const Motion motion = plan_move(all.complex_, limits, all.active_[i], entry.place,
                                        options.free_path, scratch);
        fate = motion == Motion::arrived   ? arrived
               : motion == Motion::blocked ? stopped
               : entry.blocked_at != 0     ? freed
                                           : moved;
        return motion != Motion::blocked;
    }

    void settle(std::size_t i, std::uint32_t date, Note fate) const {
        if (fate == asleep) return;
        ++all.tried_;
        if (fate == moved) return;  // its entry stays as it is
        Entry& entry = at(i);
        entry.blocked_at = fate == stopped ? date : 0;
        if (fate == arrived) entry.vertex = mesh::none;
    }
};

void Destinations::drop_dead_and_double() {
    if (clean_at_ == complex_.shape_clock()) return;
    clean_at_ = complex_.shape_clock();
    ++pass_;
    std::size_t kept = 0;
    constexpr std::size_t ahead = 16;
    for (std::size_t i = 0; i < active_.size(); ++i) {
        if (i + ahead < active_.size()) prefetch(active_[i + ahead]);
        const VertexId v = active_[i];
        if (v >= complex_.vertex_slots() || !complex_.vertex_alive(v) || !moves(v)) continue;
        if (!complex_.movable(v)) {
            not_arrived_.push_back(complex_.birth(v));
            continue;
        }
        Entry& entry = *entry_of(v);
        if (entry.listed == pass_) continue;
        entry.listed = pass_;
        active_[kept++] = v;
    }
    active_.resize(kept);
}

double Destinations::pass(const Limits& limits, const PassOptions& options) {
    drop_dead_and_double();
    Pass action{*this, limits, options};
    loop_.run(active_, options.workers, action);
    blocked_.clear();
    double left = 0.0;
    std::size_t kept = 0;
    for (const VertexId v : active_) {
        const Entry* const entry = entry_of(v);
        if (entry == nullptr) continue;  // it has arrived
        if (entry->blocked_at != 0) blocked_.push_back(v);
        left += (entry->place - complex_.position(v)).norm();
        active_[kept++] = v;
    }
    active_.resize(kept);
    return left;
}

void Destinations::drop_remaining(StepReport& report) {
    for (const VertexId v : active_) {
        if (!complex_.vertex_alive(v) || !moves(v)) continue;
        Entry& entry = *entry_of(v);
        report.dropped_motion += (entry.place - complex_.position(v)).norm();
        entry.vertex = mesh::none;
        ++stranded_;
        not_arrived_.push_back(entry.birth);
    }
    active_.clear();
}

}  // namespace dsc::kernel
