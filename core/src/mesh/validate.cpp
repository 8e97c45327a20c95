// Checks all invariants of a complex by a full scan (method.md, section 2).
#include "dsc/mesh/validate.hpp"

#include <algorithm>
#include <cmath>

#include <dsc/geometry/predicates.hpp>
#include <dsc/geometry/quality.hpp>
#include <dsc/mesh/local_star.hpp>

namespace dsc::mesh {
namespace {

constexpr std::size_t max_faults = 20;

class Faults {
public:
    explicit Faults(std::vector<std::string>& list) : list_(list) {}
    void add(const std::string& text) {
        if (list_.size() < max_faults) list_.push_back(text);
    }

private:
    std::vector<std::string>& list_;
};

std::string tet_name(TetId t) { return "tet " + std::to_string(t); }

void check_tet(const Complex& c, TetId t, ComplexReport& report, Faults& faults) {
    const Tet& tet = c.tet(t);
    for (const VertexId v : tet.v) {
        if (v >= c.vertex_slots() || !c.vertex_alive(v)) {
            faults.add(tet_name(t) + " uses the dead vertex " + std::to_string(v));
            return;
        }
    }
    const Vec3 &p0 = c.position(tet.v[0]), &p1 = c.position(tet.v[1]), &p2 = c.position(tet.v[2]),
               &p3 = c.position(tet.v[3]);
    if (geometry::orient3d(p0, p1, p2, p3) != 1) {
        ++report.inverted_tets;
        faults.add(tet_name(t) + " is not positive");
    }
    report.volume += c.volume(t);
    report.min_quality = std::min(report.min_quality, static_cast<double>(c.quality(t)));
    if (c.quality(t) != static_cast<float>(geometry::tet_quality(p0, p1, p2, p3))) {
        faults.add(tet_name(t) + " has an outdated quality");
    }
    for (unsigned f = 0; f < 4; ++f) {
        const std::uint32_t code = c.across(t, f);
        if (code == none) {
            for (const auto i : face_vertices[f]) {
                if (!c.on_box(tet.v[i]))
                    faults.add("vertex " + std::to_string(tet.v[i]) +
                               " lies on a box face but is not marked");
            }
            continue;
        }
        const TetId other = neighbour_tet(code);
        const unsigned g = neighbour_face(code);
        if (other >= c.tet_slots() || !c.tet_alive(other) || c.across(other, g) != 4 * t + f) {
            faults.add(tet_name(t) + " and its neighbour across face " + std::to_string(f) +
                       " disagree");
            continue;
        }
        for (const auto i : face_vertices[f]) {
            const unsigned j = index_of(c.tet(other), tet.v[i]);
            if (j == 4 || j == g)
                faults.add(tet_name(t) + " and " + tet_name(other) +
                           " do not share their common face");
        }
    }
}

}  // namespace

ComplexReport validate(const Complex& c) {
    ComplexReport report;
    Faults faults(report.faults);
    std::vector<std::uint32_t> degree(c.vertex_slots(), 0);
    for (TetId t = 0; t < c.tet_slots(); ++t) {
        if (!c.tet_alive(t)) continue;
        check_tet(c, t, report, faults);
        for (const VertexId v : c.tet(t).v) ++degree[v];
    }
    std::vector<TetId> star;
    LocalStar local(c);
    std::vector<char> listed(c.vertex_slots(), 0);
    for (const VertexId v : c.interface_vertices()) {
        if (listed[v] != 0) faults.add("vertex " + std::to_string(v) + " is listed twice");
        listed[v] = 1;
    }
    for (VertexId v = 0; v < c.vertex_slots(); ++v) {
        if (!c.vertex_alive(v)) {
            if (degree[v] != 0 || listed[v] != 0)
                faults.add("dead vertex " + std::to_string(v) + " is in use");
            continue;
        }
        const std::string vertex = "vertex " + std::to_string(v);
        if (!c.tet_alive(c.seed(v)) || !has_vertex(c.tet(c.seed(v)), v)) {
            faults.add(vertex + " has a wrong seed");
            continue;
        }
        c.star(v, star);
        if (star.size() != degree[v]) {
            faults.add(vertex + " has " + std::to_string(degree[v]) + " tets but a star of " +
                       std::to_string(star.size()));
        }
        std::vector<Label> labels;
        for (const TetId t : star) labels.push_back(c.label(t));
        if (c.on_box(v)) labels.push_back(0);
        std::sort(labels.begin(), labels.end());
        const auto distinct =
            static_cast<unsigned>(std::unique(labels.begin(), labels.end()) - labels.begin());
        if (c.phases(v) != std::min(distinct, 3U))
            faults.add(vertex + " has an outdated count of phases");
        if ((listed[v] != 0) != (distinct > 1))
            faults.add(vertex + " is wrongly in the interface list or missing in it");
        if (distinct < 2) continue;
        local.build(v);
        if (!local.regular()) {
            ++report.irregular_vertices;
            faults.add(vertex + " is irregular");
        }
    }
    const Vec3 size = c.box().size();
    const double box = size.x() * size.y() * size.z();
    if (std::abs(report.volume - box) > 1e-9 * box)
        faults.add("the tets' volumes do not add up to the box");
    return report;
}

InterfaceCounts count_interface(const Complex& c) {
    InterfaceCounts counts;
    std::vector<std::array<VertexId, 2>> edges;
    std::vector<VertexId> parent(c.vertex_slots());
    std::vector<char> used(c.vertex_slots(), 0);
    for (VertexId v = 0; v < parent.size(); ++v) parent[v] = v;
    const auto root = [&](VertexId v) {
        while (parent[v] != v) v = parent[v] = parent[parent[v]];
        return v;
    };
    for (TetId t = 0; t < c.tet_slots(); ++t) {
        if (!c.tet_alive(t)) continue;
        for (unsigned f = 0; f < 4; ++f) {
            const std::uint32_t code = c.across(t, f);
            if (!c.interface_face(t, f) || (code != none && neighbour_tet(code) < t)) continue;
            ++counts.faces;
            for (unsigned k = 0; k < 3; ++k) {
                const VertexId a = c.tet(t).v[face_vertices[f][k]],
                               b = c.tet(t).v[face_vertices[f][(k + 1) % 3]];
                edges.push_back({std::min(a, b), std::max(a, b)});
                used[a] = 1;
                parent[root(a)] = root(b);
            }
        }
    }
    std::sort(edges.begin(), edges.end());
    counts.edges =
        static_cast<std::size_t>(std::unique(edges.begin(), edges.end()) - edges.begin());
    for (VertexId v = 0; v < used.size(); ++v) {
        if (used[v] == 0) continue;
        ++counts.vertices;
        if (root(v) == v) ++counts.shells;
    }
    return counts;
}

double labelled_volume(const Complex& c) {
    double sum = 0.0;
    for (TetId t = 0; t < c.tet_slots(); ++t) {
        if (c.tet_alive(t) && c.label(t) > 0) sum += c.volume(t);
    }
    return sum;
}

}  // namespace dsc::mesh
