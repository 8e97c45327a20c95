// Exact search for intersecting faces: an R-tree finds candidates, predicates decide.
#include "dsc/surface/intersections.hpp"

#include <dsc/base/workers.hpp>
#include <dsc/geometry/predicates.hpp>
#include <dsc/surface/measure.hpp>

// Boost.Geometry 1.74 includes a header that Boost itself calls deprecated.
#define BOOST_ALLOW_DEPRECATED_HEADERS
#include <algorithm>
#include <iterator>
#include <utility>

#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point.hpp>
#include <boost/geometry/index/rtree.hpp>

namespace dsc::surface {
namespace {

using geometry::orient2d;
using geometry::orient3d;
using Triangle = std::array<Vec3, 3>;

/// Two coordinate axes; the projection along the third.
struct Plane {
    int u, v;
};
constexpr std::array<Plane, 3> planes = {{{0, 1}, {1, 2}, {2, 0}}};

int side(const Vec3& a, const Vec3& b, const Vec3& c, Plane plane) {
    return orient2d(a, b, c, plane.u, plane.v);
}

/// A projection in which the triangle keeps an area; it exists for every triangle that is not
/// degenerate.
Plane good_plane(const Triangle& t) {
    for (const Plane plane : planes) {
        if (side(t[0], t[1], t[2], plane) != 0) return plane;
    }
    return planes[0];
}

/// For p on the line ab in the projection: whether it lies between a and b.
bool between(const Vec3& p, const Vec3& a, const Vec3& b, Plane plane) {
    const auto within = [&](int axis) {
        return std::min(a[axis], b[axis]) <= p[axis] && p[axis] <= std::max(a[axis], b[axis]);
    };
    return within(plane.u) && within(plane.v);
}

bool segments_meet(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, Plane plane) {
    const int abc = side(a, b, c, plane), abd = side(a, b, d, plane);
    const int cda = side(c, d, a, plane), cdb = side(c, d, b, plane);
    if (abc * abd < 0 && cda * cdb < 0) return true;
    return (abc == 0 && between(c, a, b, plane)) || (abd == 0 && between(d, a, b, plane)) ||
           (cda == 0 && between(a, c, d, plane)) || (cdb == 0 && between(b, c, d, plane));
}

bool same_side_or_zero(int a, int b, int c) {
    return (a >= 0 && b >= 0 && c >= 0) || (a <= 0 && b <= 0 && c <= 0);
}

bool point_in_triangle(const Vec3& p, const Triangle& t, Plane plane) {
    return same_side_or_zero(side(t[0], t[1], p, plane), side(t[1], t[2], p, plane),
                             side(t[2], t[0], p, plane));
}

/// Segment in the plane of the triangle.
bool coplanar_segment_meets(const Vec3& a, const Vec3& b, const Triangle& t) {
    const Plane plane = good_plane(t);
    return point_in_triangle(a, t, plane) || segments_meet(a, b, t[0], t[1], plane) ||
           segments_meet(a, b, t[1], t[2], plane) || segments_meet(a, b, t[2], t[0], plane);
}

/// Closed segment against closed triangle; sa and sb say on which side of the triangle's plane its
/// ends lie.
bool segment_meets(const Vec3& a, const Vec3& b, int sa, int sb, const Triangle& t) {
    if (sa * sb > 0) return false;
    if (sa == 0 && sb == 0) return coplanar_segment_meets(a, b, t);
    // The segment meets the plane in one point. This point is in the triangle if the line ab passes
    // the three edges on the same side.
    return same_side_or_zero(orient3d(a, b, t[0], t[1]), orient3d(a, b, t[1], t[2]),
                             orient3d(a, b, t[2], t[0]));
}

bool segment_meets(const Vec3& a, const Vec3& b, const Triangle& t) {
    return segment_meets(a, b, orient3d(t[0], t[1], t[2], a), orient3d(t[0], t[1], t[2], b), t);
}

std::array<int, 3> sides_of(const Triangle& plane, const Triangle& t) {
    return {orient3d(plane[0], plane[1], plane[2], t[0]),
            orient3d(plane[0], plane[1], plane[2], t[1]),
            orient3d(plane[0], plane[1], plane[2], t[2])};
}

bool strictly_one_side(const std::array<int, 3>& s) {
    return s[0] != 0 && s[0] == s[1] && s[1] == s[2];
}

bool any_edge_meets(const Triangle& p, const std::array<int, 3>& sides, const Triangle& q) {
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t j = (i + 1) % 3;
        if (segment_meets(p[i], p[j], sides[i], sides[j], q)) return true;
    }
    return false;
}

/// Triangles (v, a, b) and (v, c, d) have a common point besides v exactly if the edge opposite v
/// of one meets the other, because the ray from v through that point leaves one of the two first.
bool meet_beyond_vertex(const Triangle& p, const Triangle& q) {
    const int sc = orient3d(p[0], p[1], p[2], q[1]), sd = orient3d(p[0], p[1], p[2], q[2]);
    if (sc * sd > 0) return false;
    return segment_meets(q[1], q[2], sc, sd, p) || segment_meets(p[1], p[2], q);
}

/// Triangles (a, b, c) and (a, b, d) overlap beyond ab exactly if they are coplanar and c and d are
/// on the same side of ab.
bool meet_beyond_edge(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    if (orient3d(a, b, c, d) != 0) return false;
    const Plane plane = good_plane({a, b, c});
    return side(a, b, c, plane) == side(a, b, d, plane);
}

using Face = std::array<std::uint32_t, 3>;

/// The face, rotated so that its first `shared` points are those that the other face contains.
struct Turned {
    Face face;
    std::size_t shared;
};

Turned turn(const Face& face, const Face& other) {
    std::array<bool, 3> has{};
    for (std::size_t i = 0; i < 3; ++i)
        has[i] = std::find(other.begin(), other.end(), face[i]) != other.end();
    Turned out{{}, 0};
    for (std::size_t i = 0; i < 3; ++i) {
        if (has[i]) out.face[out.shared++] = face[i];
    }
    std::size_t k = out.shared;
    for (std::size_t i = 0; i < 3; ++i) {
        if (!has[i]) out.face[k++] = face[i];
    }
    return out;
}

bool faces_intersect(const std::vector<Vec3>& x, const Face& f, const Face& g) {
    const Turned p = turn(f, g), q = turn(g, f);
    const auto corners = [&](const Face& t) { return Triangle{x[t[0]], x[t[1]], x[t[2]]}; };
    switch (p.shared) {
        case 0: return triangles_intersect(corners(f), corners(g));
        case 1: return meet_beyond_vertex(corners(p.face), corners(q.face));
        case 2: return meet_beyond_edge(x[p.face[0]], x[p.face[1]], x[p.face[2]], x[q.face[2]]);
        default: return true;
    }
}

namespace bg = boost::geometry;
using BoostPoint = bg::model::point<double, 3, bg::cs::cartesian>;
using BoostBox = bg::model::box<BoostPoint>;
using Entry = std::pair<BoostBox, std::uint32_t>;
using FaceTree = bg::index::rtree<Entry, bg::index::quadratic<16>>;

BoostBox box_of(const std::vector<Vec3>& x, const Face& f) {
    const Vec3 low = x[f[0]].cwiseMin(x[f[1]]).cwiseMin(x[f[2]]);
    const Vec3 high = x[f[0]].cwiseMax(x[f[1]]).cwiseMax(x[f[2]]);
    return {BoostPoint(low.x(), low.y(), low.z()), BoostPoint(high.x(), high.y(), high.z())};
}

struct BlockResult {
    std::size_t count = 0;
    std::vector<std::array<std::uint32_t, 2>> pairs;
};

BlockResult search_block(const TriangleMesh& mesh, const FaceTree& tree,
                         const std::vector<bool>& flat, std::size_t begin, std::size_t end,
                         std::size_t keep) {
    BlockResult out;
    std::vector<Entry> near;
    std::vector<std::uint32_t> partners;
    for (std::size_t i = begin; i < end; ++i) {
        if (flat[i]) continue;
        const auto f = static_cast<std::uint32_t>(i);
        near.clear();
        tree.query(bg::index::intersects(box_of(mesh.points, mesh.faces[f])),
                   std::back_inserter(near));
        partners.clear();
        for (const Entry& entry : near) {
            const std::uint32_t g = entry.second;
            if (g > f && faces_intersect(mesh.points, mesh.faces[f], mesh.faces[g]))
                partners.push_back(g);
        }
        std::sort(partners.begin(), partners.end());
        out.count += partners.size();
        for (const std::uint32_t g : partners) {
            if (out.pairs.size() < keep) out.pairs.push_back({f, g});
        }
    }
    return out;
}

}  // namespace

bool is_degenerate(const Vec3& a, const Vec3& b, const Vec3& c) {
    return std::all_of(planes.begin(), planes.end(),
                       [&](Plane plane) { return side(a, b, c, plane) == 0; });
}

bool triangles_intersect(const std::array<Vec3, 3>& p, const std::array<Vec3, 3>& q) {
    const auto q_sides = sides_of(p, q);
    if (strictly_one_side(q_sides)) return false;
    const auto p_sides = sides_of(q, p);
    if (strictly_one_side(p_sides)) return false;
    if (any_edge_meets(q, q_sides, p) || any_edge_meets(p, p_sides, q)) return true;
    return false;
}

IntersectionReport self_intersections(const TriangleMesh& mesh, std::size_t keep,
                                      Workers* workers) {
    require_sound(mesh);
    IntersectionReport report;
    std::vector<bool> flat(mesh.faces.size(), false);
    std::vector<Entry> entries;
    entries.reserve(mesh.faces.size());
    for (std::size_t i = 0; i < mesh.faces.size(); ++i) {
        const Face& f = mesh.faces[i];
        flat[i] = is_degenerate(mesh.points[f[0]], mesh.points[f[1]], mesh.points[f[2]]);
        if (flat[i])
            ++report.degenerate_faces;
        else
            entries.emplace_back(box_of(mesh.points, f), static_cast<std::uint32_t>(i));
    }
    const FaceTree tree(entries);
    constexpr std::size_t block = 2048;
    std::vector<BlockResult> results(block_count(mesh.faces.size(), block));
    const auto search = [&](std::size_t begin, std::size_t end) {
        results[begin / block] = search_block(mesh, tree, flat, begin, end, keep);
    };
    Workers alone;
    (workers != nullptr ? *workers : alone).for_blocks(mesh.faces.size(), block, search);
    for (const BlockResult& result : results) {
        report.count += result.count;
        for (const auto& pair : result.pairs) {
            if (report.pairs.size() < keep) report.pairs.push_back(pair);
        }
    }
    return report;
}

}  // namespace dsc::surface
