// Analyses a triangle mesh: edges, shells, fans, borders, defects.
#include "dsc/surface/analysis.hpp"

#include <algorithm>
#include <numeric>

#include <dsc/base/union_find.hpp>
#include <dsc/geometry/quality.hpp>
#include <dsc/surface/intersections.hpp>

namespace dsc::surface {
namespace {

/// Side k of face f is half-edge 3 f + k, from its corner k to its corner k + 1.
struct HalfEdge {
    std::uint32_t low, high;  ///< points of the edge
    std::uint32_t id;
};

struct Edge {
    std::size_t begin, end;  ///< its half-edges in the sorted list
    std::size_t ascending;   ///< number of half-edges from low to high
    std::size_t count() const { return end - begin; }
    std::size_t descending() const { return count() - ascending; }
    bool manifold() const { return ascending <= 1 && descending() <= 1; }
};

std::uint32_t next_corner(std::uint32_t corner) {
    return corner % 3 == 2 ? corner - 2 : corner + 1;
}

struct Connectivity {
    std::vector<std::array<std::uint32_t, 3>> faces;  ///< the faces that are analysed
    std::vector<HalfEdge> half_edges;
    std::vector<Edge> edges;

    std::uint32_t point(std::size_t corner) const { return faces[corner / 3][corner % 3]; }
    bool ascends(const HalfEdge& h) const { return point(h.id) == h.low; }

    void build_edges() {
        half_edges.reserve(3 * faces.size());
        for (std::uint32_t c = 0; c < 3 * faces.size(); ++c) {
            const std::uint32_t a = point(c), b = point(next_corner(c));
            half_edges.push_back({std::min(a, b), std::max(a, b), c});
        }
        std::sort(half_edges.begin(), half_edges.end(), [](const HalfEdge& x, const HalfEdge& y) {
            return std::tie(x.low, x.high, x.id) < std::tie(y.low, y.high, y.id);
        });
        for (std::size_t i = 0; i < half_edges.size();) {
            Edge edge{i, i, 0};
            while (edge.end < half_edges.size() && half_edges[edge.end].low == half_edges[i].low &&
                   half_edges[edge.end].high == half_edges[i].high) {
                if (ascends(half_edges[edge.end])) ++edge.ascending;
                ++edge.end;
            }
            edges.push_back(edge);
            i = edge.end;
        }
    }
    /// Corner of the half-edge at one of its points.
    std::uint32_t corner_at(const HalfEdge& h, std::uint32_t p) const {
        return point(h.id) == p ? h.id : next_corner(h.id);
    }
};

Connectivity select_faces(const TriangleMesh& mesh, SurfaceReport& report) {
    Connectivity out;
    out.faces.reserve(mesh.faces.size());
    for (const auto& f : mesh.faces) {
        const bool valid = std::all_of(f.begin(), f.end(), [&](std::uint32_t v) {
            return v < mesh.points.size() && mesh.points[v].allFinite();
        });
        if (!valid) {
            ++report.invalid_faces;
            continue;
        }
        const bool repeats = f[0] == f[1] || f[1] == f[2] || f[2] == f[0];
        if (repeats || is_degenerate(mesh.points[f[0]], mesh.points[f[1]], mesh.points[f[2]]))
            ++report.degenerate_faces;
        if (!repeats) out.faces.push_back(f);
    }
    report.faces = out.faces.size();
    return out;
}

void count_points(const TriangleMesh& mesh, const Connectivity& c, SurfaceReport& report) {
    std::vector<bool> seen(mesh.points.size(), false);
    std::vector<std::array<double, 3>> places;
    for (const auto& f : c.faces) {
        for (const std::uint32_t v : f) {
            if (seen[v]) continue;
            seen[v] = true;
            report.box.extend(mesh.points[v]);
            places.push_back({mesh.points[v].x(), mesh.points[v].y(), mesh.points[v].z()});
        }
    }
    report.vertices = places.size();
    report.unused_points = mesh.points.size() - places.size();
    std::sort(places.begin(), places.end());
    for (std::size_t i = 1; i < places.size(); ++i) {
        if (places[i] == places[i - 1]) ++report.duplicate_points;
    }
}

void count_duplicate_faces(const Connectivity& c, SurfaceReport& report) {
    auto sorted = c.faces;
    for (auto& f : sorted) std::sort(f.begin(), f.end());
    std::sort(sorted.begin(), sorted.end());
    for (std::size_t i = 1; i < sorted.size(); ++i) {
        if (sorted[i] == sorted[i - 1]) ++report.duplicate_faces;
    }
}

void count_edges(const TriangleMesh& mesh, const Connectivity& c, SurfaceReport& report) {
    report.edges = c.edges.size();
    double sum = 0.0;
    for (const Edge& edge : c.edges) {
        if (edge.count() == 1) ++report.boundary_edges;
        if (edge.count() > 2) ++report.nonmanifold_edges;
        if (edge.ascending > 1) ++report.misoriented_edges;
        if (edge.descending() > 1) ++report.misoriented_edges;
        const HalfEdge& h = c.half_edges[edge.begin];
        const double length = (mesh.points[h.high] - mesh.points[h.low]).norm();
        sum += length;
        report.edge_min = &edge == &c.edges.front() ? length : std::min(report.edge_min, length);
        report.edge_max = std::max(report.edge_max, length);
    }
    if (!c.edges.empty()) report.edge_mean = sum / static_cast<double>(c.edges.size());
}

/// Faces joined through edges form shells; corners joined through edges at one point form fans.
struct Pieces {
    UnionFind shells;
    UnionFind fans;

    explicit Pieces(const Connectivity& c) : shells(c.faces.size()), fans(3 * c.faces.size()) {
        for (const Edge& edge : c.edges) {
            const HalfEdge& first = c.half_edges[edge.begin];
            for (std::size_t i = edge.begin + 1; i < edge.end; ++i) {
                const HalfEdge& other = c.half_edges[i];
                shells.join(first.id / 3, other.id / 3);
                fans.join(c.corner_at(first, first.low), c.corner_at(other, first.low));
                fans.join(c.corner_at(first, first.high), c.corner_at(other, first.high));
            }
        }
    }
};

void count_nonmanifold_vertices(std::size_t points, const Connectivity& c, Pieces& pieces,
                                SurfaceReport& report) {
    std::vector<std::uint32_t> fans(points, 0);
    for (std::uint32_t corner = 0; corner < 3 * c.faces.size(); ++corner) {
        if (pieces.fans.find(corner) == corner && ++fans[c.point(corner)] == 2)
            ++report.nonmanifold_vertices;
    }
}

/// Joins boundary edges through the fans at their ends; in a manifold shell every piece is one
/// loop.
void count_boundary_loops(const Connectivity& c, Pieces& pieces,
                          const std::vector<std::size_t>& shell_of,
                          std::vector<ShellReport>& shells) {
    UnionFind loops(3 * c.faces.size());
    std::vector<std::uint32_t> ends;
    for (const Edge& edge : c.edges) {
        if (edge.count() != 1) continue;
        const std::uint32_t id = c.half_edges[edge.begin].id;
        const std::uint32_t a = pieces.fans.find(id), b = pieces.fans.find(next_corner(id));
        loops.join(a, b);
        ends.push_back(a);
        ends.push_back(b);
    }
    std::sort(ends.begin(), ends.end());
    ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
    for (const std::uint32_t fan : ends) {
        if (loops.find(fan) == fan) ++shells[shell_of[fan / 3]].boundary_loops;
    }
}

void report_shells(const TriangleMesh& mesh, const Connectivity& c, Pieces& pieces,
                   SurfaceReport& report) {
    std::vector<std::size_t> shell_of(c.faces.size());
    auto& shells = report.shell_reports;
    const Vec3 centre = report.box.centre();
    for (std::uint32_t f = 0; f < c.faces.size(); ++f) {
        if (pieces.shells.find(f) == f) {
            shell_of[f] = shells.size();
            shells.emplace_back();
            shells.back().closed = shells.back().manifold = true;
        } else {
            shell_of[f] = shell_of[pieces.shells.find(f)];
        }
        ShellReport& shell = shells[shell_of[f]];
        const Vec3 p = mesh.points[c.faces[f][0]], q = mesh.points[c.faces[f][1]],
                   r = mesh.points[c.faces[f][2]];
        ++shell.faces;
        shell.area += geometry::triangle_area(p, q, r);
        shell.volume += (p - centre).dot((q - centre).cross(r - centre)) / 6.0;
        for (std::uint32_t k = 3 * f; k < 3 * f + 3; ++k) {
            if (pieces.fans.find(k) == k) ++shell.vertices;
        }
    }
    for (const Edge& edge : c.edges) {
        ShellReport& shell = shells[shell_of[c.half_edges[edge.begin].id / 3]];
        ++shell.edges;
        shell.closed = shell.closed && edge.ascending == edge.descending();
        shell.manifold = shell.manifold && edge.manifold();
    }
    count_boundary_loops(c, pieces, shell_of, shells);
}

void sum_shells(SurfaceReport& report) {
    report.shells = report.shell_reports.size();
    for (ShellReport& shell : report.shell_reports) {
        shell.euler =
            static_cast<long>(shell.vertices + shell.faces) - static_cast<long>(shell.edges);
        if (!shell.manifold) shell.boundary_loops = 0;
        if (!shell.closed) shell.volume = 0.0;
        if (shell.manifold)
            shell.genus = (2 - shell.euler - static_cast<long>(shell.boundary_loops)) / 2;
        report.area += shell.area;
        report.volume += shell.volume;
        report.genus += shell.genus;
        if (shell.volume > 0.0) ++report.components;
        if (shell.volume < 0.0) ++report.cavities;
    }
    report.euler =
        static_cast<long>(report.vertices + report.faces) - static_cast<long>(report.edges);
}

}  // namespace

SurfaceReport analyse(const TriangleMesh& mesh) {
    SurfaceReport report;
    Connectivity c = select_faces(mesh, report);
    c.build_edges();
    count_points(mesh, c, report);
    count_duplicate_faces(c, report);
    count_edges(mesh, c, report);
    Pieces pieces(c);
    count_nonmanifold_vertices(mesh.points.size(), c, pieces, report);
    report_shells(mesh, c, pieces, report);
    sum_shells(report);
    return report;
}

}  // namespace dsc::surface
