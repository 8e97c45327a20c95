#include "shapes.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include <dsc/geometry/quality.hpp>

#include "quantised.hpp"

namespace dsc::improvement {
namespace {

using mesh::VertexId;
using repair::CollapseMode;
using repair::Operation;
using repair::Request;

std::array<std::uint32_t, 3> births_of(const mesh::Complex& c, VertexId a, VertexId b,
                                       VertexId third = mesh::none) {
    std::array<std::uint32_t, 3> births = {c.birth(a), c.birth(b),
                                           third == mesh::none ? UINT32_MAX : c.birth(third)};
    std::sort(births.begin(), births.end());
    return births;
}

// The sides of a face; side k is opposite corner k.
struct Face {
    std::array<VertexId, 3> v;
    std::array<double, 3> length2;
    double area;
    double quality;

    unsigned shortest() const {
        return static_cast<unsigned>(std::min_element(length2.begin(), length2.end()) -
                                     length2.begin());
    }
    unsigned longest() const {
        return static_cast<unsigned>(std::max_element(length2.begin(), length2.end()) -
                                     length2.begin());
    }
    std::array<VertexId, 2> side(unsigned k) const { return {v[(k + 1) % 3], v[(k + 2) % 3]}; }
    bool blunt(unsigned corner) const {
        return length2[corner] > length2[(corner + 1) % 3] + length2[(corner + 2) % 3];
    }
};

Face face_of(const mesh::Complex& c, mesh::TetId t, unsigned f) {
    Face face{};
    std::array<Vec3, 3> p;
    for (unsigned k = 0; k < 3; ++k) {
        face.v[k] = c.tet(t).v[mesh::face_vertices[f][k]];
        p[k] = c.position(face.v[k]);
    }
    for (unsigned k = 0; k < 3; ++k)
        face.length2[k] = (p[(k + 1) % 3] - p[(k + 2) % 3]).squaredNorm();
    face.area = 0.5 * (p[1] - p[0]).cross(p[2] - p[0]).norm();
    double sharpest = 0.0;
    for (unsigned k = 0; k < 3; ++k) {
        const double b2 = face.length2[(k + 1) % 3], c2 = face.length2[(k + 2) % 3];
        const double scale = 2.0 * std::sqrt(b2 * c2);
        sharpest =
            scale > 0.0 ? std::max(sharpest, std::abs(b2 + c2 - face.length2[k]) / scale) : 1.0;
    }
    face.quality = std::max(0.0, 1.0 - sharpest);
    return face;
}

}  // namespace

bool ShapeLimits::any() const {
    return std::max({degenerate_edge_quality, min_edge_quality, degenerate_face_quality,
                     min_face_quality, min_face_area, max_face_area, max_tet_volume}) > 0.0;
}

void ShapeProposals::note_edges(const repair::RepairRound& round, mesh::TetId t) {
    const mesh::Complex& c = round.complex;
    for (const auto& ends : mesh::edge_vertices) {
        const VertexId a = c.tet(t).v[ends[0]], b = c.tet(t).v[ends[1]];
        if (!round.size_edits && c.on_interface(a) && c.on_interface(b)) continue;
        const double length = (c.position(a) - c.position(b)).norm() / round.length_at(a, b);
        if (length >= std::max(limits_.degenerate_edge_quality, limits_.min_edge_quality)) continue;
        const Kind kind =
            length < limits_.degenerate_edge_quality ? Kind::degenerate_edge : Kind::low_edge;
        entries_.push_back({kind, quantised(length), births_of(c, a, b), t, {a, b}, mesh::none});
    }
}

void ShapeProposals::note_faces(const repair::RepairRound& round, mesh::TetId t) {
    const mesh::Complex& c = round.complex;
    const double target = round.length_of(t);
    const double unit = 0.25 * std::sqrt(3.0) * target * target;
    const double worst = std::max(limits_.degenerate_face_quality, limits_.min_face_quality);
    for (unsigned f = 0; f < 4; ++f) {
        const Face face = face_of(c, t, f);
        const auto note = [&](Kind kind, double key, unsigned side, VertexId opposite) {
            entries_.push_back({kind, quantised(key), births_of(c, face.v[0], face.v[1], face.v[2]),
                                t, face.side(side), opposite});
        };
        if (face.quality < worst) {
            const unsigned longest = face.longest();
            const bool cap = face.blunt(longest);
            note(face.quality < limits_.degenerate_face_quality ? Kind::degenerate_face
                                                                : Kind::low_face,
                 face.quality, cap ? longest : face.shortest(), cap ? face.v[longest] : mesh::none);
        }
        // Of the two tets at an interface face, the one with the larger label handles it.
        if (!round.size_edits || c.label(t) <= c.label_across(t, f)) continue;
        const double area = face.area / unit;
        if (area < limits_.min_face_area) note(Kind::small_face, area, face.shortest(), mesh::none);
        if (limits_.max_face_area > 0.0 && area > limits_.max_face_area)
            note(Kind::large_face, -area, face.longest(), mesh::none);
    }
}

void ShapeProposals::note_tet(const repair::RepairRound& round, mesh::TetId t) {
    if (!(limits_.max_tet_volume > 0.0)) return;
    const mesh::Complex& c = round.complex;
    const double volume = c.volume(t) / geometry::regular_tet_volume(round.length_of(t));
    if (volume <= limits_.max_tet_volume) return;
    std::array<VertexId, 2> longest{};
    double longest2 = -1.0;
    for (const auto& ends : mesh::edge_vertices) {
        const VertexId a = c.tet(t).v[ends[0]], b = c.tet(t).v[ends[1]];
        const double length2 = (c.position(a) - c.position(b)).squaredNorm();
        if (length2 > longest2) {
            longest2 = length2;
            longest = {a, b};
        }
    }
    if (!round.size_edits && c.on_interface(longest[0]) && c.on_interface(longest[1])) return;
    entries_.push_back({Kind::large_tet, quantised(-volume), births_of(c, longest[0], longest[1]),
                        t, longest, mesh::none});
}

void ShapeProposals::request(const repair::RepairRound& round, const Entry& entry,
                             const ShapeBounds& bounds, std::vector<Request>& out) {
    Request request;
    request.tet = entry.tet;
    request.birth_date = round.complex.birth_date(entry.tet);
    request.vertices = {entry.edge[0], entry.edge[1], mesh::none};
    const bool pays = entry.kind == Kind::degenerate_edge || entry.kind == Kind::degenerate_face ||
                      entry.kind == Kind::small_face;
    request.mode = pays ? CollapseMode::bounded : CollapseMode::safe;
    request.accept_above = pays ? bounds.degenerate : bounds.low;
    if (entry.kind == Kind::large_face || entry.kind == Kind::large_tet) {
        request.operation = Operation::edge_split;
        out.push_back(request);
        return;
    }
    if (entry.opposite == mesh::none) {
        request.operation = Operation::edge_collapse;
        out.push_back(request);
        return;
    }
    // A cap is removed with its longest edge.
    const bool interface =
        round.complex.on_interface(entry.edge[0]) && round.complex.on_interface(entry.edge[1]);
    request.operation = Operation::edge_removal;
    out.push_back(request);
    if (!interface) return;
    request.operation = Operation::interface_flip;
    out.push_back(request);
}

void ShapeProposals::write(const repair::RepairRound& round, const ShapeBounds& bounds,
                           std::vector<Request>& out) {
    if (!limits_.any()) return;
    entries_.clear();
    const bool edges = limits_.degenerate_edge_quality > 0.0 || limits_.min_edge_quality > 0.0;
    const bool faces = limits_.degenerate_face_quality > 0.0 || limits_.min_face_quality > 0.0 ||
                       limits_.min_face_area > 0.0 || limits_.max_face_area > 0.0;
    for (const mesh::TetId t : round.dirty) {
        if (edges) note_edges(round, t);
        if (faces) note_faces(round, t);
        note_tet(round, t);
    }
    // By measure, then by birth; of the tets around one simplex the first in the order of the slots
    // makes the request.
    std::sort(entries_.begin(), entries_.end(), [](const Entry& x, const Entry& y) {
        return std::tie(x.kind, x.key, x.births, x.tet) < std::tie(y.kind, y.key, y.births, y.tet);
    });
    const Entry* last = nullptr;
    for (const Entry& entry : entries_) {
        if (last != nullptr && last->kind == entry.kind && last->births == entry.births) continue;
        request(round, entry, bounds, out);
        last = &entry;
    }
}

}  // namespace dsc::improvement
