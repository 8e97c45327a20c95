#include "proposals.hpp"

#include <algorithm>
#include <atomic>

#include <dsc/base/large_vector.hpp>
#include <dsc/base/prefetch.hpp>
#include <dsc/geometry/quality.hpp>
#include <dsc/mesh/tet_visit.hpp>

#include "quantised.hpp"

namespace dsc::improvement {
namespace {

using repair::CollapseMode;
using repair::Operation;
using repair::Request;

Request on_tet(const mesh::Complex& c, mesh::TetId t, Operation operation, double only_below,
               double accept_above) {
    Request request = repair::on_tet(c, t, operation);
    request.only_below = static_cast<float>(only_below);
    request.accept_above = static_cast<float>(accept_above);
    return request;
}

bool edge_is_flat(const mesh::Complex& c, const mesh::EdgeRing& ring, mesh::VertexId a,
                  mesh::VertexId b, double flatness) {
    std::array<Vec3, 2> normals;
    std::size_t count = 0;
    const std::size_t n = ring.tets.size();
    for (std::size_t i = 0; i < n; ++i) {
        const mesh::Label before = c.label(ring.tets[(i + n - 1) % n]),
                          after = c.label(ring.tets[i]);
        if (before == after) continue;
        const Vec3 normal =
            geometry::triangle_normal(c.position(a), c.position(b), c.position(ring.link[i]));
        if (count < 2) normals[count] = after > before ? normal : Vec3(-normal);
        ++count;
    }
    return count == 2 && normals[0].dot(normals[1]) >= flatness;
}

}  // namespace

// The volume below which a tet is collapsed.
double Proposals::small_volume_of(const repair::RepairRound& round, mesh::TetId t) const {
    const double length = round.lengths.empty() ? round.target_length : round.length_of(t);
    return limits_.min_tet_volume * geometry::regular_tet_volume(length);
}

// If a refinement owns the sizing, tets with an interface edge are not changed.
bool Proposals::may_thin_out(const repair::RepairRound& round, mesh::TetId t) {
    if (round.size_edits) return true;
    const auto& v = round.complex.tet(t).v;
    return std::count_if(v.begin(), v.end(),
                         [&](mesh::VertexId x) { return round.complex.on_interface(x); }) < 2;
}

// The target length of an edge from the interface into a phase is that of its end on the interface.
double Proposals::free_length(const repair::RepairRound& round, mesh::VertexId a,
                              mesh::VertexId b) {
    return round.length_at(round.complex.on_interface(a) ? a : b);
}

// Finds the repairs that a tet needs; it only reads, so threads may call it together.
std::uint8_t Proposals::look(const repair::RepairRound& round, mesh::TetId t) const {
    const mesh::Complex& c = round.complex;
    const auto length2 = [&c](mesh::VertexId a, mesh::VertexId b) {
        return (c.position(a) - c.position(b)).squaredNorm();
    };
    const auto square = [](double x) { return x * x; };
    const auto& v = c.tet(t).v;
    std::uint8_t found = 0;
    unsigned on_interface = 0;  // the number of corners there
    unsigned interior = 0;      // bits of the corners
    for (unsigned k = 0; k < 4; ++k) {
        on_interface += c.on_interface(v[k]) ? 1U : 0U;
        interior |= (c.interior(v[k]) ? 1U : 0U) << k;
    }
    const auto q = static_cast<double>(c.quality(t));
    if (q < limits_.min_tet_quality) found |= low_quality;
    if (q < limits_.smooth_below) found |= static_cast<std::uint8_t>(to_smooth * interior);
    if (geometry::tet_volume(c.position(v[0]), c.position(v[1]), c.position(v[2]),
                             c.position(v[3])) < small_volume_of(round, t) &&
        may_thin_out(round, t))
        found |= small_volume;
    // Only a tet with three vertices on the interface can have a face there.
    const bool has_face = round.size_edits && on_interface >= 3;
    for (unsigned f = 0; f < 4 && has_face; ++f) {
        if (c.label(t) <= c.label_across(t, f)) continue;
        for (unsigned k = 0; k < 3; ++k) {
            const mesh::VertexId a = v[mesh::face_vertices[f][k]],
                                 b = v[mesh::face_vertices[f][(k + 1) % 3]];
            const double target = round.length_at(a, b), l2 = length2(a, b);
            // Slightly wider than the wanted range; note_edges() decides.
            const double shortest2 = square(limits_.min_edge_length * target) * (1.0 + 1e-9);
            const double longest2 = square(limits_.max_edge_length * target) * (1.0 - 1e-9);
            if (l2 < shortest2 || l2 > longest2) found |= interface_edges;
        }
    }
    if (!(limits_.max_free_edge > 0.0) || on_interface == 0 || on_interface == 4) return found;
    for (const auto& ends : mesh::edge_vertices) {
        const mesh::VertexId a = v[ends[0]], b = v[ends[1]];
        if (c.on_interface(a) == c.on_interface(b)) continue;
        if (length2(a, b) > square(limits_.max_free_edge * free_length(round, a, b)) * (1.0 - 1e-9))
            found |= free_edges;
    }
    return found;
}

void Proposals::note_edges(const repair::RepairRound& round, mesh::TetId t, Findings& out) const {
    const mesh::Complex& c = round.complex;
    for (unsigned f = 0; f < 4; ++f) {
        // Of the two tets at an interface face, the one with the larger label handles its edges.
        if (c.label(t) <= c.label_across(t, f)) continue;
        for (unsigned k = 0; k < 3; ++k) {
            mesh::VertexId a = c.tet(t).v[mesh::face_vertices[f][k]],
                           b = c.tet(t).v[mesh::face_vertices[f][(k + 1) % 3]];
            const double length = (c.position(a) - c.position(b)).norm();
            const double target = round.length_at(a, b);
            const double shortest = limits_.min_edge_length * target;
            if (length >= shortest && length <= limits_.max_edge_length * target) continue;
            if (c.birth(a) > c.birth(b)) std::swap(a, b);
            auto& edges = length < shortest ? out.short_edges : out.long_edges;
            edges.push_back({c.birth(a), c.birth(b), a, b, t, quantised(length / target), 0});
        }
    }
}

void Proposals::note_free_edges(const repair::RepairRound& round, mesh::TetId t,
                                Findings& out) const {
    const mesh::Complex& c = round.complex;
    for (const auto& ends : mesh::edge_vertices) {
        mesh::VertexId a = c.tet(t).v[ends[0]], b = c.tet(t).v[ends[1]];
        if (c.on_interface(a) == c.on_interface(b)) continue;
        const double length = (c.position(a) - c.position(b)).norm();
        const double target = free_length(round, a, b);
        if (length <= limits_.max_free_edge * target) continue;
        if (c.birth(a) > c.birth(b)) std::swap(a, b);
        out.free_edges.push_back({c.birth(a), c.birth(b), a, b, t, quantised(length / target), 0});
    }
}

void Proposals::Findings::clear() {
    low.clear();
    small.clear();
    short_edges.clear();
    long_edges.clear();
    free_edges.clear();
    free.clear();
}

// Whether no tet earlier in the list is known to ask for this vertex; threads may ask together.
bool Proposals::come_first(mesh::VertexId v, std::uint32_t place) {
    const std::atomic_ref<std::uint32_t> first(first_[v]);
    std::uint32_t known = first.load(std::memory_order_relaxed);
    while (place < known) {
        if (first.compare_exchange_weak(known, place, std::memory_order_relaxed)) return true;
    }
    return false;
}

void Proposals::find_in(const repair::RepairRound& round, std::uint32_t place, Findings& out) {
    const mesh::Complex& c = round.complex;
    const mesh::TetId t = round.dirty[place];
    const std::uint8_t found = look(round, t);
    if ((found & low_quality) != 0)
        out.low.push_back({quantised(static_cast<double>(c.quality(t))), t, 0});
    for (unsigned k = 0; k < 4 && found >= to_smooth; ++k) {
        const mesh::VertexId v = c.tet(t).v[k];
        if ((found & to_smooth << k) != 0 && come_first(v, place))
            out.free.push_back({v, t, place});
    }
    if ((found & small_volume) != 0)
        out.small.push_back({quantised(c.volume(t) / small_volume_of(round, t)), t, 0});
    if ((found & interface_edges) != 0) note_edges(round, t, out);
    if ((found & free_edges) != 0) note_free_edges(round, t, out);
}

// Looks at the dirty tets in blocks, and joins what it finds in their order; at many blocks in
// turn, so that their findings do not fill the memory.
void Proposals::find(const repair::RepairRound& round, Workers* workers) {
    if (first_.size() < round.complex.vertex_slots())
        first_.resize(round.complex.vertex_slots(), mesh::none);
    all_.clear();
    blocks_.resize(looked_blocks);
    struct Job {
        Proposals& proposals;
        const repair::RepairRound& round;
        std::size_t start;
    };
    for (std::size_t start = 0; start < round.dirty.size(); start += looked_blocks * look_block) {
        const std::size_t count = std::min(looked_blocks * look_block, round.dirty.size() - start);
        const Job job{*this, round, start};
        for_blocks(workers, count, look_block, [&job](std::size_t begin, std::size_t end) {
            job.proposals.find_in_block(job.round, job.start + begin, job.start + end,
                                        job.proposals.blocks_[begin / look_block]);
        });
        join(block_count(count, look_block), workers);
    }
    for_blocks(workers, all_.free.size(), look_block, [this](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) first_[all_.free[i].vertex] = mesh::none;
    });
}

void Proposals::find_in_block(const repair::RepairRound& round, std::size_t begin, std::size_t end,
                              Findings& found) {
    found.clear();
    // Of the tets at faces look() reads the neighbours.
    const auto may_have_face = [this, &round](mesh::TetId t) {
        const mesh::Complex& c = round.complex;
        const auto& v = c.tet(t).v;
        if (static_cast<double>(c.quality(t)) < limits_.smooth_below) {
            for (const mesh::VertexId x : v) prefetch_line(&first_[x]);
        }
        return c.on_interface(v[0]) + c.on_interface(v[1]) + c.on_interface(v[2]) +
                   c.on_interface(v[3]) >=
               3;
    };
    mesh::visit_tets(
        round.complex, round.dirty.subspan(begin, end - begin), may_have_face,
        [&](std::size_t i) { find_in(round, static_cast<std::uint32_t>(begin + i), found); });
}

// Appends what is in the first blocks.
void Proposals::join(std::size_t blocks, Workers* workers) {
    // A tet of an earlier block may have asked for the vertex afterwards.
    for_blocks(workers, blocks, 1, [this](std::size_t begin, std::size_t end) {
        for (Findings& found : std::span(blocks_).subspan(begin, end - begin)) {
            std::erase_if(found.free, [this](const FreeEntry& entry) {
                return first_[entry.vertex] != entry.place;
            });
        }
    });
    const auto append = [](auto& to, const auto& from) {
        for (auto entry : from) {
            entry.order = static_cast<std::uint32_t>(to.size());
            to.push_back(entry);
        }
    };
    std::size_t free = all_.free.size();
    for (Findings& found : std::span(blocks_).first(blocks)) {
        append(all_.low, found.low);
        append(all_.small, found.small);
        append(all_.short_edges, found.short_edges);
        append(all_.long_edges, found.long_edges);
        append(all_.free_edges, found.free_edges);
        found.free_before = free;
        free += found.free.size();
    }
    all_.free.resize(free);
    for_blocks(workers, blocks, 1, [this](std::size_t begin, std::size_t end) {
        for (const Findings& found : std::span(blocks_).subspan(begin, end - begin)) {
            std::copy(found.free.begin(), found.free.end(),
                      all_.free.begin() + static_cast<std::ptrdiff_t>(found.free_before));
        }
    });
}

void Proposals::sort_out(const repair::RepairRound& round, Workers* workers) {
    find(round, workers);
    // Total orders, so that a stable sort with its buffer is not needed.
    const auto by_key = [](const Entry& x, const Entry& y) {
        return x.key != y.key ? x.key < y.key : x.order < y.order;
    };
    std::sort(all_.low.begin(), all_.low.end(), by_key);
    std::sort(all_.small.begin(), all_.small.end(), by_key);
    const auto by_births = [](const EdgeEntry& x, const EdgeEntry& y) {
        return x.low != y.low     ? x.low < y.low
               : x.high != y.high ? x.high < y.high
                                  : x.order < y.order;
    };
    for (auto* edges : {&all_.short_edges, &all_.long_edges, &all_.free_edges}) {
        std::sort(edges->begin(), edges->end(), by_births);
        edges->erase(std::unique(edges->begin(), edges->end(),
                                 [](const EdgeEntry& x, const EdgeEntry& y) {
                                     return x.low == y.low && x.high == y.high;
                                 }),
                     edges->end());
        const bool ascending = edges == &all_.short_edges;
        std::sort(edges->begin(), edges->end(), [&](const EdgeEntry& x, const EdgeEntry& y) {
            if (x.key != y.key) return ascending ? x.key < y.key : x.key > y.key;
            return by_births(x, y);
        });
    }
}

// The list need not grow while it is written, which would copy it. Twice the room, because the next
// rounds may write more, and memory that nobody has written to costs nothing.
void Proposals::make_room(std::vector<Request>& out) const {
    constexpr std::size_t most_per_tet = 3 + 4 + 4;  // of low quality, in the stages 2 and 3
    const std::size_t most = out.size() + all_.free_edges.size() + all_.free.size() +
                             most_per_tet * all_.low.size() + all_.short_edges.size() +
                             all_.long_edges.size() + all_.small.size();
    if (out.capacity() >= most) return;
    out.reserve(2 * most);
    if (out.empty()) prefer_large_pages(out.data(), out.capacity() * sizeof(Request));
}

void Proposals::write(const repair::RepairRound& round, Workers* workers,
                      std::vector<repair::Request>& out) {
    const mesh::Complex& c = round.complex;
    sort_out(round, workers);
    make_room(out);
    const double low = limits_.min_tet_quality, degenerate = limits_.degenerate_tet_quality;
    // For each entry of a list; the memory is asked for the tets of later entries, and their
    // vertices.
    const auto visit = [&c](const auto& entries, const auto& each) {
        constexpr std::size_t near = 8, far = 16;  // entries ahead
        for (std::size_t i = 0; i < entries.size(); ++i) {
            if (i + far < entries.size()) c.prefetch(entries[i + far].tet);
            if (i + near < entries.size()) c.prefetch_vertices(entries[i + near].tet);
            each(entries[i]);
        }
    };
    // 0. Long edges ahead of the interface, longest first: the next stages smooth the new vertices.
    visit(all_.free_edges, [&](const EdgeEntry& edge) {
        Request request = on_tet(c, edge.tet, Operation::edge_split, 2.0, 2.0);
        request.vertices = {edge.a, edge.b, mesh::none};
        out.push_back(request);
    });
    // 1. Free vertices move to the mean of their neighbours.
    const std::size_t first = out.size();
    out.resize(first + all_.free.size());
    for_blocks(workers, all_.free.size(), look_block, [&](std::size_t begin, std::size_t end) {
        constexpr std::size_t ahead = 16;
        for (std::size_t i = begin; i < end; ++i) {
            if (i + ahead < end) c.prefetch(all_.free[i + ahead].tet);
            Request& request = out[first + i];
            request = on_tet(c, all_.free[i].tet, Operation::smooth_laplacian, 2.0, 2.0);
            request.vertices[0] = all_.free[i].vertex;
        }
    });
    // 2. Bad tets, worst first: edges, interface diagonals, faces, then their free vertices one by
    // one.
    visit(all_.low, [&](const Entry& entry) {
        out.push_back(on_tet(c, entry.tet, Operation::edge_removal, low, 2.0));
        out.push_back(on_tet(c, entry.tet, Operation::interface_flip, low, 2.0));
        out.push_back(on_tet(c, entry.tet, Operation::face_removal, low, 2.0));
        for (const mesh::VertexId v : c.tet(entry.tet).v) {
            if (!c.interior(v)) continue;
            Request request = on_tet(c, entry.tet, Operation::smooth_optimise, low, 2.0);
            request.vertices[0] = v;
            out.push_back(request);
        }
    });
    // 3. Tets that are still degenerate: collapse without loss, by shape, within the bounds; split
    // long edges.
    for (const Entry& entry : all_.low) {
        if (static_cast<double>(c.quality(entry.tet)) >= degenerate) break;
        out.push_back(on_tet(c, entry.tet, Operation::edge_collapse, degenerate, low));
        out.push_back(on_tet(c, entry.tet, Operation::compound, degenerate, degenerate));
        Request bounded = on_tet(c, entry.tet, Operation::edge_collapse, degenerate, degenerate);
        bounded.mode = CollapseMode::bounded;
        out.push_back(bounded);
        out.push_back(on_tet(c, entry.tet, Operation::relabel, degenerate, degenerate));
    }
    // 4. Sizes: short interface edges, long ones that are not flat, small tets.
    visit(all_.short_edges, [&](const EdgeEntry& edge) {
        Request request = on_tet(c, edge.tet, Operation::edge_collapse, 2.0, degenerate);
        request.vertices = {edge.a, edge.b, mesh::none};
        request.mode = CollapseMode::bounded;
        out.push_back(request);
    });
    visit(all_.long_edges, [&](const EdgeEntry& edge) {
        c.ring(edge.tet, edge.a, edge.b, ring_);
        if (!ring_.closed || edge_is_flat(c, ring_, edge.a, edge.b, round.flatness)) return;
        Request request = on_tet(c, edge.tet, Operation::edge_split, 2.0, 2.0);
        request.vertices = {edge.a, edge.b, mesh::none};
        out.push_back(request);
    });
    visit(all_.small, [&](const Entry& entry) {
        out.push_back(on_tet(c, entry.tet, Operation::edge_collapse, 2.0, low));
    });
    // 5. Shapes and sizes of single edges, faces and tets, if their thresholds are set.
    shapes_.write(round, {static_cast<float>(degenerate), static_cast<float>(low)}, out);
}

}  // namespace dsc::improvement
