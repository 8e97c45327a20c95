// Slots, births and the list of the interface, for serial work and for lanes side by side.
#include "dsc/mesh/lane.hpp"

#include <algorithm>

#include <dsc/mesh/complex.hpp>

namespace dsc::mesh {
namespace {

template <class T>
void append(std::vector<T>& list, const std::vector<T>& more) {
    list.insert(list.end(), more.begin(), more.end());
}

// Moves up to `count` entries from the end of one list to another, in the order in which they would
// be taken.
template <class T>
std::size_t hand_over(std::vector<T>& from, std::size_t count, std::vector<T>& to) {
    const std::size_t moved = std::min(count, from.size());
    to.assign(from.end() - static_cast<std::ptrdiff_t>(moved), from.end());
    from.resize(from.size() - moved);
    return moved;
}

}  // namespace

VertexId Complex::new_vertex_slot() {
    const auto v = static_cast<VertexId>(vertices_.size());
    vertices_.push_back({Vec3::Zero(), none, 0, 0, no_slot, 1, 0});
    shape_dates_.push_back(0);
    stars_.grow(vertices_.size());
    return v;
}

TetId Complex::new_tet_slot() {
    const auto t = static_cast<TetId>(tets_.size());
    tets_.push_back({{none, none, none, none}, {none, none, none, none}});
    labels_.push_back(0);
    qualities_.push_back(no_quality);
    dates_.push_back(0);
    birth_dates_.push_back(0);
    return t;
}

VertexId Complex::allocate_vertex(const Vec3& position, Lane& lane) {
    VertexId v = none;
    if (lane.free_vertices_.empty()) {
        v = new_vertex_slot();
    } else {
        v = lane.free_vertices_.back();
        lane.free_vertices_.pop_back();
    }
    vertices_[v] = {position, none, lane.next_birth_++, lane.clock_, no_slot, 1, 0};
    if (lane.open_) lane.created_.push_back(v);
    return v;
}

TetId Complex::allocate_tet(Lane& lane) {
    if (lane.free_tets_.empty()) return new_tet_slot();
    const TetId t = lane.free_tets_.back();
    lane.free_tets_.pop_back();
    return t;
}

void Complex::set_phases(VertexId v, unsigned phases, Lane& lane) {
    vertices_[v].phases = phases & 3U;
    // The list contains vertices of other lanes.
    if (lane.open_) {
        lane.relisted_.push_back(v);
    } else {
        list_by_phases(v);
    }
}

void Complex::list_by_phases(VertexId v) {
    Vertex& vertex = vertices_[v];
    const bool listed = vertex.interface_slot != no_slot;
    if (vertex.phases > 1 && !listed) {
        vertex.interface_slot = static_cast<std::uint32_t>(interface_.size()) & no_slot;
        interface_.push_back(v);
    } else if (vertex.phases <= 1 && listed) {
        const VertexId last = interface_.back();
        interface_[vertex.interface_slot] = last;
        vertices_[last].interface_slot = vertex.interface_slot;
        interface_.pop_back();
        vertex.interface_slot = no_slot;
    }
}

void Complex::open(Lane& lane, const LaneRoom& room) {
    lane.open_ = true;
    lane.short_of_slots_ = false;
    lane.clock_ = serial_.clock_;
    lane.next_birth_ = serial_.next_birth_;  // final births are given by close()
    lane.changes_.clear();
    lane.created_.clear();
    lane.deleted_.clear();
    lane.relisted_.clear();
    for (std::size_t n = hand_over(serial_.free_tets_, room.tets, lane.free_tets_); n < room.tets;
         ++n)
        lane.free_tets_.push_back(new_tet_slot());
    for (std::size_t n = hand_over(serial_.free_vertices_, room.vertices, lane.free_vertices_);
         n < room.vertices; ++n)
        lane.free_vertices_.push_back(new_vertex_slot());
}

void Complex::close(Lane& lane) {
    // Dates are compared only in one neighbourhood, so lanes may use the same ones. What follows is
    // later than all of them.
    serial_.clock_ = std::max(serial_.clock_, lane.clock_);
    for (const VertexId v : lane.created_) vertices_[v].birth = serial_.next_birth_++;
    for (const VertexId v : lane.relisted_) list_by_phases(v);
    append(serial_.changes_, lane.changes_);
    append(serial_.free_tets_, lane.free_tets_);
    append(serial_.free_vertices_, lane.free_vertices_);
    append(serial_.free_vertices_, lane.deleted_);
    lane.free_tets_.clear();
    lane.free_vertices_.clear();
    lane.open_ = false;
}

}  // namespace dsc::mesh
