#include "repairs.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace dsc::improvement {
namespace {

using mesh::VertexId;
using repair::CollapseMode;
using repair::Operation;
using repair::Request;

// Altitudes are compared in steps of 1e-6, so that rounding does not decide the order.
std::int64_t quantised(double value) { return std::llround(value * 1e6); }

std::array<Vec3, 4> corners(const mesh::Complex& c, mesh::TetId t) {
    const auto& v = c.tet(t).v;
    return {c.position(v[0]), c.position(v[1]), c.position(v[2]), c.position(v[3])};
}

Request on_tet(const mesh::Complex& c, mesh::TetId t, Operation operation,
               RepairClass repair_class) {
    Request request = repair::on_tet(c, t, operation);
    request.repair_class = static_cast<std::uint8_t>(repair_class);
    return request;
}

bool free_vertex(const mesh::Complex& c, VertexId v) { return !c.on_interface(v) && !c.on_box(v); }

}  // namespace

std::vector<std::string> repair_class_names() {
    return {"wedge",        "tee",       "cap",      "sliver", "edge_removal",
            "face_removal", "smoothing", "collapse", "spoke"};
}

bool Repairs::Visits::first(std::uint32_t slot) {
    if (slot >= seen_.size()) seen_.resize(std::max<std::size_t>(slot + 1, 2 * seen_.size()), 0);
    if (seen_[slot] == round_) return false;
    seen_[slot] = round_;
    return true;
}

bool Repairs::interface_edge(const mesh::Complex& c, mesh::TetId t, VertexId a, VertexId b) {
    if (!c.on_interface(a) || !c.on_interface(b)) return false;
    c.ring(t, a, b, ring_);
    const mesh::Label label = c.label(t);
    return std::any_of(ring_.tets.begin(), ring_.tets.end(),
                       [&](mesh::TetId r) { return c.label(r) != label; });
}

// The two edges of a sliver that cross; an edge of the interface comes first.
std::array<std::array<VertexId, 2>, 2> Repairs::crossing_edges(const mesh::Complex& c,
                                                               const Entry& entry) {
    const auto& v = c.tet(entry.tet).v;
    const TetShape& shape = entry.shape;
    std::array<std::array<VertexId, 2>, 2> edges = {
        {{v[shape.edge[0]], v[shape.edge[1]]}, {v[shape.vertex], v[shape.opposite]}}};
    if (interface_edge(c, entry.tet, edges[1][0], edges[1][1])) std::swap(edges[0], edges[1]);
    return edges;
}

bool Repairs::inserts_on_interface(const mesh::Complex& c, const Entry& entry) {
    if (entry.shape.flat_class != FlatClass::sliver) return false;
    const auto first = crossing_edges(c, entry)[0];
    return interface_edge(c, entry.tet, first[0], first[1]);
}

void Repairs::begin_step(const repair::RepairRound& round) {
    std::fill(searched_.begin(), searched_.end(), 0);
    const double budget =
        limits_.insertions * static_cast<double>(round.complex.interface_vertices().size());
    insertions_left_ = static_cast<std::size_t>(budget);
}

void Repairs::count_insertions(const repair::RepairRound& round) {
    for (std::size_t i = 0; i < round.last_outcomes.size(); ++i) {
        const Request& request = round.last_requests[i];
        const bool inserted =
            !round.last_outcomes[i].refused() && request.operation == Operation::compound &&
            request.repair_class == static_cast<std::uint8_t>(RepairClass::sliver);
        if (inserted && insertions_left_ > 0) --insertions_left_;
    }
}

void Repairs::note(const repair::RepairRound& round, mesh::TetId t, bool blocking) {
    const mesh::Complex& c = round.complex;
    const TetShape shape = classify(corners(c, t), round.length_of(t), limits_);
    const bool by_class = blocking || shape.altitude < limits_.flat;
    if (limits_.fallbacks && shape.altitude < limits_.smooth_below) {
        for (const VertexId v : c.tet(t).v) {
            if (!free_vertex(c, v) || !vertices_seen_.first(v)) continue;
            free_.push_back(v);
            free_tets_.push_back(t);
        }
    }
    if (!by_class && !(limits_.fallbacks && shape.altitude < limits_.flip_below)) return;
    if (!tets_seen_.first(t)) return;
    queue_.push_back(
        {quantised(shape.altitude), t, static_cast<std::uint32_t>(queue_.size()), by_class, shape});
}

// The tet of lowest quality in the star of a vertex stops the vertex, whether it is flat or not.
void Repairs::note_blocking(const repair::RepairRound& round, VertexId v) {
    const mesh::Complex& c = round.complex;
    if (searched_.size() < c.vertex_slots()) searched_.resize(c.vertex_slots(), 0);
    if (searched_[v] != 0 && c.vertex_date(v) <= searched_[v]) return;
    searched_[v] = std::max(1U, c.clock());
    c.star(v, star_);
    const auto lower = [&](mesh::TetId a, mesh::TetId b) { return c.quality(a) < c.quality(b); };
    note(round, *std::min_element(star_.begin(), star_.end(), lower), true);
}

void Repairs::collect(const repair::RepairRound& round) {
    queue_.clear();
    free_.clear();
    free_tets_.clear();
    tets_seen_.begin_round();
    vertices_seen_.begin_round();
    spokes_.clear();
    for (const VertexId v : round.blocked) note_blocking(round, v);
    for (const mesh::TetId t : round.dirty) {
        note(round, t, false);
        if (limits_.longest_spoke > 0.0) note_spokes(round, t);
    }
    std::sort(queue_.begin(), queue_.end(), [](const Entry& x, const Entry& y) {
        return x.altitude != y.altitude ? x.altitude < y.altitude : x.order < y.order;
    });
}

void Repairs::note_spokes(const repair::RepairRound& round, mesh::TetId t) {
    const mesh::Complex& c = round.complex;
    for (const auto& ends : mesh::edge_vertices) {
        VertexId a = c.tet(t).v[ends[0]], b = c.tet(t).v[ends[1]];
        if (c.on_interface(a) == c.on_interface(b)) continue;
        const double length =
            (c.position(a) - c.position(b)).norm() / round.length_at(c.on_interface(a) ? a : b);
        if (length <= limits_.longest_spoke) continue;
        if (c.birth(a) > c.birth(b)) std::swap(a, b);
        spokes_.push_back({-quantised(length), c.birth(a), c.birth(b), {a, b, mesh::none}});
    }
}

// Longest first, each once, so that edges that share tets are split at the same rate.
void Repairs::split_spokes(std::vector<Request>& out) {
    const auto key = [](const Spoke& s) { return std::tie(s.length, s.low, s.high); };
    std::sort(spokes_.begin(), spokes_.end(),
              [&](const Spoke& x, const Spoke& y) { return key(x) < key(y); });
    for (std::size_t i = 0; i < spokes_.size(); ++i) {
        if (i > 0 && key(spokes_[i - 1]) == key(spokes_[i])) continue;
        Request request;
        request.operation = Operation::edge_split;
        request.vertices = spokes_[i].ends;
        request.repair_class = static_cast<std::uint8_t>(RepairClass::spoke);
        out.push_back(request);
    }
}

void Repairs::smooth(const repair::RepairRound& round, std::vector<Request>& out) const {
    for (std::size_t i = 0; i < free_.size(); ++i) {
        Request request = on_tet(round.complex, free_tets_[i], Operation::smooth_laplacian,
                                 RepairClass::smoothing);
        request.vertices[0] = free_[i];
        out.push_back(request);
    }
}

void Repairs::repair_by_class(const repair::RepairRound& round, const Entry& entry,
                              std::vector<Request>& out) {
    const mesh::Complex& c = round.complex;
    const auto& v = c.tet(entry.tet).v;
    const TetShape& shape = entry.shape;
    const VertexId a = v[shape.edge[0]], b = v[shape.edge[1]], apex = v[shape.vertex],
                   opposite = v[shape.opposite];
    const double least_edge = limits_.least_edge * round.length_of(entry.tet);
    const auto compound = [&](RepairClass repair_class, std::array<VertexId, 3> vertices) {
        Request request = on_tet(c, entry.tet, Operation::compound, repair_class);
        request.vertices = vertices;
        request.gain = 2.0F;
        request.least_edge = static_cast<float>(least_edge);
        out.push_back(request);
    };
    const auto splittable = [&](VertexId x, VertexId y) {
        return (c.position(x) - c.position(y)).norm() > 2.0 * least_edge;
    };
    switch (shape.flat_class) {
        case FlatClass::wedge: {
            Request request = on_tet(c, entry.tet, Operation::edge_collapse, RepairClass::wedge);
            request.vertices = {a, b, mesh::none};
            request.mode = CollapseMode::bounded;
            request.accept_above = static_cast<float>(limits_.degenerate_tet_quality);
            out.push_back(request);
            return;
        }
        case FlatClass::tee: {
            if (free_vertex(c, apex) && splittable(a, b))
                compound(RepairClass::tee, {apex, mesh::none, mesh::none});
            const bool on_interface = c.on_interface(a) && c.on_interface(b);
            for (const Operation operation : {Operation::edge_removal, Operation::interface_flip}) {
                if (operation == Operation::interface_flip && !on_interface) continue;
                Request request = on_tet(c, entry.tet, operation, RepairClass::tee);
                request.vertices = {a, b, mesh::none};
                out.push_back(request);
            }
            return;
        }
        case FlatClass::cap: {
            const bool large =
                splittable(a, b) && splittable(b, opposite) && splittable(opposite, a);
            if (free_vertex(c, apex) && large)
                compound(RepairClass::cap, {apex, mesh::none, mesh::none});
            Request request = on_tet(c, entry.tet, Operation::face_removal, RepairClass::cap);
            request.vertices = {a, b, opposite};
            out.push_back(request);
            return;
        }
        case FlatClass::sliver: {
            const auto edges = crossing_edges(c, entry);
            if (insertions_open_ == 0 || !splittable(edges[0][0], edges[0][1]) ||
                !splittable(edges[1][0], edges[1][1]))
                return;
            --insertions_open_;
            compound(RepairClass::sliver, {edges[0][0], edges[0][1], mesh::none});
            return;
        }
    }
}

void Repairs::flip_or_smooth(const repair::RepairRound& round, const Entry& entry,
                             std::vector<Request>& out) const {
    const mesh::Complex& c = round.complex;
    out.push_back(on_tet(c, entry.tet, Operation::edge_removal, RepairClass::edge_removal));
    out.push_back(on_tet(c, entry.tet, Operation::interface_flip, RepairClass::edge_removal));
    out.push_back(on_tet(c, entry.tet, Operation::face_removal, RepairClass::face_removal));
    for (const VertexId v : c.tet(entry.tet).v) {
        if (!free_vertex(c, v)) continue;
        Request request = on_tet(c, entry.tet, Operation::smooth_optimise, RepairClass::smoothing);
        request.vertices[0] = v;
        out.push_back(request);
    }
}

// The shortest edge with an end inside a phase; edges of the interface are handled as wedges.
void Repairs::collapse(const repair::RepairRound& round, const Entry& entry,
                       std::vector<Request>& out) const {
    const mesh::Complex& c = round.complex;
    const auto& v = c.tet(entry.tet).v;
    std::array<VertexId, 2> shortest = {mesh::none, mesh::none};
    double least = INFINITY;
    for (const auto& ends : mesh::edge_vertices) {
        const VertexId a = v[ends[0]], b = v[ends[1]];
        const double length = (c.position(a) - c.position(b)).norm();
        if (length >= least || (!free_vertex(c, a) && !free_vertex(c, b))) continue;
        least = length;
        shortest = {a, b};
    }
    if (shortest[0] == mesh::none) return;
    Request request = on_tet(c, entry.tet, Operation::edge_collapse, RepairClass::collapse);
    request.vertices = {shortest[0], shortest[1], mesh::none};
    request.mode = CollapseMode::bounded;
    request.accept_above = static_cast<float>(limits_.degenerate_tet_quality);
    out.push_back(request);
}

void Repairs::write(const repair::RepairRound& round, std::vector<Request>& out) {
    if (round.round == 0) begin_step(round);
    count_insertions(round);
    collect(round);
    insertions_open_ = insertions_left_;
    split_spokes(out);
    smooth(round, out);
    for (const Entry& entry : queue_) {
        // Nothing removes an additional vertex on the interface: these slivers come after the
        // flips.
        const bool last = limits_.fallbacks && inserts_on_interface(round.complex, entry);
        if (entry.by_class && !last) repair_by_class(round, entry, out);
        if (!limits_.fallbacks) continue;
        flip_or_smooth(round, entry, out);
        if (entry.by_class && last) repair_by_class(round, entry, out);
        if (entry.by_class) collapse(round, entry, out);
    }
}

}  // namespace dsc::improvement
