// Executes a request: chooses the simplex if the request names only a tet (method.md, section 6.1).
#include <dsc/geometry/quality.hpp>

#include "kernel/operations.hpp"

namespace dsc::kernel {
namespace {

using repair::Operation;
using repair::Request;

struct Edge {
    VertexId a, b;
    double length2;
};

std::array<Edge, 6> edges_of(const mesh::Complex& c, TetId t) {
    std::array<Edge, 6> edges{};
    for (unsigned e = 0; e < 6; ++e) {
        const VertexId a = c.tet(t).v[mesh::edge_vertices[e][0]],
                       b = c.tet(t).v[mesh::edge_vertices[e][1]];
        edges[e] = {a, b, (c.position(a) - c.position(b)).squaredNorm()};
    }
    return edges;
}

// Insertion sort: stable, and without the buffer that std::stable_sort allocates.
void sort_by_length(std::array<Edge, 6>& edges) {
    for (std::size_t i = 1; i < edges.size(); ++i) {
        for (std::size_t j = i; j > 0 && edges[j].length2 < edges[j - 1].length2; --j)
            std::swap(edges[j], edges[j - 1]);
    }
}

// Of several refusals the most informative one: topology and bounds before quality before "does not
// apply".
Refusal stronger(Outcome x, Outcome y) {
    const auto rank = [](Refusal r) {
        switch (r) {
            case Refusal::irregular: return 5;
            case Refusal::bound: return 4;
            case Refusal::quality: return 3;
            case Refusal::no_gain: return 2;
            case Refusal::box: return 1;
            default: return 0;
        }
    };
    return rank(x.reason()) >= rank(y.reason()) ? x.reason() : y.reason();
}

// `known`: the first edges are refused.
template <class Attempt>
Outcome first_success(const std::array<Edge, 6>& edges, const Foresight& known, Attempt&& attempt) {
    Refusal result = known.reason;
    for (std::size_t i = known.edges; i < edges.size(); ++i) {
        const Outcome o = attempt(edges[i]);
        if (!o.refused()) return o;
        result = stronger(result, o);
    }
    return result;
}

Outcome on_edges(Workbench& bench, const Request& request, TetId t, const Foresight& known) {
    const mesh::Complex& c = bench.complex;
    auto edges = edges_of(c, t);
    switch (request.operation) {
        case Operation::edge_removal:
            return first_success(edges, known, [&](const Edge& e) {
                return remove_edge(bench, t, e.a, e.b, request.accept_above);
            });
        case Operation::interface_flip:
            return first_success(edges, known, [&](const Edge& e) -> Outcome {
                if (!c.on_interface(e.a) || !c.on_interface(e.b)) return Refusal::not_applicable;
                return flip_interface_edge(bench, t, e.a, e.b, request.accept_above);
            });
        case Operation::edge_collapse:
            sort_by_length(edges);
            return first_success(edges, known, [&](const Edge& e) {
                if (known.choice.a == e.a && known.choice.b == e.b)
                    return collapse_as_chosen(bench, known.choice);
                return collapse_edge(bench, t, e.a, e.b, request.mode, request.accept_above);
            });
        default: {
            const auto longest = std::max_element(
                edges.begin(), edges.end(),
                [](const Edge& x, const Edge& y) { return x.length2 < y.length2; });
            return split_edge(bench, t, longest->a, longest->b,
                              static_cast<double>(request.parameter));
        }
    }
}

Outcome on_faces(Workbench& bench, const Request& request, TetId t) {
    Refusal result = Refusal::not_applicable;
    const mesh::Complex& c = bench.complex;
    for (unsigned f = 0; f < 4; ++f) {
        const auto& named = request.vertices;
        const bool whole_face = named[2] != mesh::none;
        if (whole_face && std::find(named.begin(), named.end(), c.tet(t).v[f]) != named.end())
            continue;
        Outcome o = Refusal::not_applicable;
        if (request.operation == Operation::face_removal) {
            o = remove_faces(bench, t, f, request.accept_above);
        } else {
            // Splits at the projection of the opposite vertex if it lies inside the face.
            const auto& v = c.tet(t).v;
            const Vec3 &a = c.position(v[mesh::face_vertices[f][0]]),
                       &b = c.position(v[mesh::face_vertices[f][1]]),
                       &d = c.position(v[mesh::face_vertices[f][2]]);
            const Vec3 n = geometry::triangle_normal(a, b, d);
            const Vec3 p = c.position(v[f]) - n.dot(c.position(v[f]) - a) * n;
            const bool inside = n.dot((b - a).cross(p - a)) > 0.0 &&
                                n.dot((d - b).cross(p - b)) > 0.0 &&
                                n.dot((a - d).cross(p - d)) > 0.0;
            if (inside) o = split_face(bench, t, f, p);
        }
        if (!o.refused()) return o;
        result = stronger(result, o);
    }
    return result;
}

// Whether the request names a tet that no longer exists or no longer needs it.
bool is_stale(const mesh::Complex& c, const Request& request) {
    const TetId t = request.tet;
    return t >= c.tet_slots() || !c.tet_alive(t) || c.birth_date(t) != request.birth_date ||
           !(c.quality(t) < request.only_below);
}

// A tet for a request that names only vertices.
TetId tet_of(const mesh::Complex& c, const Request& request) {
    const VertexId a = request.vertices[0], b = request.vertices[1];
    if (a == mesh::none || a >= c.vertex_slots() || !c.vertex_alive(a)) return mesh::none;
    if (b == mesh::none) return c.seed(a);
    if (b >= c.vertex_slots() || !c.vertex_alive(b)) return mesh::none;
    return c.find_edge(a, b);
}

}  // namespace

bool foreseeable(const Request& request) {
    return (request.operation == Operation::edge_removal ||
            request.operation == Operation::edge_collapse) &&
           request.vertices[0] == mesh::none && request.tet != mesh::none;
}

Foresight foresee(Workbench& bench, const Request& request) {
    const mesh::Complex& c = bench.complex;
    const TetId t = request.tet;
    const bool removes = request.operation == Operation::edge_removal;
    if (!foreseeable(request) || is_stale(c, request)) return {};
    auto edges = edges_of(c, t);
    if (!removes) sort_by_length(edges);
    Foresight known;
    for (const Edge& e : edges) {
        const Outcome o = removes ? may_remove(bench, t, e.a, e.b, request.accept_above)
                                  : choose_collapse(bench, t, e.a, e.b, request.mode,
                                                    request.accept_above, known.choice);
        if (!o.refused()) return known;
        known.reason = stronger(known.reason, o);
        ++known.edges;
    }
    known.choice = {};
    return known;
}

Outcome execute(Workbench& bench, const Request& request, const Foresight& known) {
    const mesh::Complex& c = bench.complex;
    TetId t = request.tet;
    if (t != mesh::none) {
        if (is_stale(c, request)) return Refusal::stale;
    } else {
        t = tet_of(c, request);
        if (t == mesh::none) return Refusal::stale;
    }
    for (const VertexId v : request.vertices) {
        if (v != mesh::none && !mesh::has_vertex(c.tet(t), v)) return Refusal::stale;
    }
    const VertexId a = request.vertices[0], b = request.vertices[1];
    const bool edge = a != mesh::none && b != mesh::none;
    switch (request.operation) {
        case Operation::smooth_laplacian:
            return a == mesh::none ? Refusal::not_applicable
                                   : smooth_laplacian(bench, a, request.accept_above);
        case Operation::smooth_optimise:
            return a == mesh::none ? Refusal::not_applicable : smooth_optimise(bench, a);
        case Operation::vertex_split:
            return edge ? split_vertex(bench, a, b) : Refusal::not_applicable;
        case Operation::relabel: return relabel_tet(bench, t);
        case Operation::compound: return compound(bench, t, request);
        case Operation::face_removal:
        case Operation::face_split: return on_faces(bench, request, t);
        case Operation::edge_removal:
            return edge ? remove_edge(bench, t, a, b, request.accept_above)
                        : on_edges(bench, request, t, known);
        case Operation::interface_flip:
            return edge ? flip_interface_edge(bench, t, a, b, request.accept_above)
                        : on_edges(bench, request, t, known);
        case Operation::edge_split:
            return edge ? split_edge(bench, t, a, b, static_cast<double>(request.parameter))
                        : on_edges(bench, request, t, known);
        case Operation::edge_collapse:
            return edge ? collapse_edge(bench, t, a, b, request.mode, request.accept_above)
                        : on_edges(bench, request, t, known);
    }
    return Refusal::not_applicable;
}

}  // namespace dsc::kernel
