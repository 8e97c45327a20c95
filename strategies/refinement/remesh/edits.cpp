#include "edits.hpp"

#include <algorithm>

#include <dsc/geometry/quality.hpp>

namespace dsc::remesh {
namespace {

constexpr unsigned collapse_attempts = 3, flip_attempts = 2;  // within one refinement
constexpr double least_move = 0.02;                           // of the target length
constexpr double least_overlap = 1e-6;  // flip only if the sum of cotangents is below minus this:
                                        // the edge of a square stays

double cotangent(const Vec3& at, const Vec3& p, const Vec3& q) {
    const Vec3 u = p - at, v = q - at;
    return u.dot(v) / std::max(u.cross(v).norm(), 1e-300);
}

}  // namespace

void Edits::start_refinement() {
    tried_collapses_.clear();
    tried_flips_.clear();
}

void Edits::start_pass(const EdgeMesh& mesh) {
    blocked_.assign(mesh.view->vertex_count(), 0);
    used_.assign(mesh.view->face_count(), 0);
}

std::uint64_t Edits::births_of(const EdgeMesh& mesh, std::uint32_t edge) {
    const auto& [a, b] = mesh.edges[edge].vertices;  // in the order of their births, as all
                                                     // vertices of a view
    return std::uint64_t{mesh.view->births[a]} << 32U | mesh.view->births[b];
}

unsigned Edits::attempts_at(const std::vector<Tried>& tried, std::uint64_t births) {
    const auto found = std::lower_bound(tried.begin(), tried.end(), Tried{births, 0});
    return found != tried.end() && found->births == births ? found->attempts : 0U;
}

void Edits::note_asked(std::vector<Tried>& tried) const {
    const std::size_t known = tried.size();
    for (const Tried& one : asked_) {
        const auto end = tried.begin() + static_cast<std::ptrdiff_t>(known);
        const auto found = std::lower_bound(tried.begin(), end, one);
        if (found != end && found->births == one.births) {
            found->attempts = one.attempts;
        } else {
            tried.push_back(one);
        }
    }
    std::sort(tried.begin(), tried.end());
}

void Edits::split(const EdgeMesh& mesh, const Lengths& lengths,
                  std::vector<std::array<std::uint32_t, 2>>& out) {
    candidates_.clear();
    for (std::uint32_t e = 0; e < mesh.edges.size(); ++e) {
        const auto& [a, b] = mesh.edges[e].vertices;
        const double ratio = mesh.lengths[e] / lengths.along(a, b);
        if (ratio > split_above) candidates_.push_back({ratio, e});
    }
    std::sort(candidates_.begin(), candidates_.end(), [](const Candidate& x, const Candidate& y) {
        return x.key != y.key ? x.key > y.key : x.edge < y.edge;
    });
    for (const Candidate& c : candidates_) {
        const surface::ViewEdge& edge = mesh.edges[c.edge];
        out.push_back(edge.vertices);
        for (unsigned side = 0; side < std::min(edge.face_count, 2U); ++side) {
            blocked_[mesh.opposite(c.edge, side)] = 1;
            used_[edge.faces[side]] = 1;
        }
        for (const std::uint32_t v : edge.vertices) blocked_[v] = 1;
    }
}

void Edits::ring_of(const EdgeMesh& mesh, std::uint32_t vertex,
                    std::vector<std::uint32_t>& out) const {
    out.clear();
    for (const std::uint32_t f : mesh.view->faces_of(vertex)) {
        for (const std::uint32_t v : mesh.view->faces[f]) {
            if (v != vertex) out.push_back(v);
        }
    }
    std::sort(out.begin(), out.end());
    out.erase(std::unique(out.begin(), out.end()), out.end());
}

void Edits::block_ring(const EdgeMesh& mesh, std::uint32_t vertex) {
    for (const std::uint32_t f : mesh.view->faces_of(vertex)) {
        for (const std::uint32_t v : mesh.view->faces[f]) blocked_[v] = 1;
        used_[f] = 1;
    }
}

// Chooses the end that stays and its place; false if creases forbid the collapse.
bool Edits::place_of(const EdgeMesh& mesh, std::size_t edge, unsigned attempt, bool keep_creases,
                     hooks::CollapseRequest& request) const {
    const auto& [a, b] = mesh.edges[edge].vertices;
    const bool crease_a = mesh.creases[a] > 0, crease_b = mesh.creases[b] > 0;
    const auto stays_at = [&](std::uint32_t kept, std::uint32_t removed) {
        request = {kept, removed, mesh.place(kept)};
        return true;
    };
    if (crease_a != crease_b) return crease_a ? stays_at(a, b) : stays_at(b, a);
    if (keep_creases && crease_a) {
        // Both ends are on a crease: only a collapse along it is allowed, and a vertex where the
        // crease ends or bends stays.
        if (!mesh.is_crease(edge)) return false;
        const bool corner_a = mesh.creases[a] != 2, corner_b = mesh.creases[b] != 2;
        if (corner_a && corner_b) return false;
        if (corner_a || corner_b) return corner_a ? stays_at(a, b) : stays_at(b, a);
    }
    if (attempt > 0) return attempt == 1 ? stays_at(a, b) : stays_at(b, a);
    request = {a, b, 0.5 * (mesh.place(a) + mesh.place(b))};
    return true;
}

// Whether a face of `vertex` that remains after the collapse with `other` turns too far.
bool Edits::turns(const EdgeMesh& mesh, std::uint32_t vertex, std::uint32_t other,
                  const Vec3& place) const {
    const surface::SurfaceView& view = *mesh.view;
    for (const std::uint32_t f : view.faces_of(vertex)) {
        const auto& face = view.faces[f];
        std::array<const Vec3*, 3> x{};
        bool stays = true;
        for (std::size_t k = 0; k < 3; ++k) {
            x[k] = face[k] == vertex ? &place : &view.positions[face[k]];
            stays = stays && face[k] != other;
        }
        if (!stays) continue;
        if (geometry::triangle_normal(*x[0], *x[1], *x[2]).dot(view.face_normals[f]) < turn_cosine)
            return true;
    }
    return false;
}

// Requires the link condition [Dey1999], no new edge that would be split again, and no face that
// turns too far.
bool Edits::fits(const EdgeMesh& mesh, const Lengths& lengths, const hooks::CollapseRequest& r) {
    ring_of(mesh, r.kept, near_a_);
    ring_of(mesh, r.removed, near_b_);
    if (near_a_.size() + near_b_.size() < 7) return false;
    std::size_t common = 0;
    auto y = near_b_.begin();
    for (const std::uint32_t x : near_a_) {
        while (y != near_b_.end() && *y < x) ++y;
        if (y != near_b_.end() && *y == x) ++common;
    }
    if (common != 2) return false;
    const double kept_length = lengths.at(r.kept);
    for (const auto* ring : {&near_a_, &near_b_}) {
        for (const std::uint32_t v : *ring) {
            if (v == r.kept || v == r.removed) continue;
            if ((mesh.place(v) - r.place).norm() >
                split_above * 0.5 * (kept_length + lengths.at(v)))
                return false;
        }
    }
    return !turns(mesh, r.kept, r.removed, r.place) && !turns(mesh, r.removed, r.kept, r.place);
}

void Edits::collapse(const EdgeMesh& mesh, const Lengths& lengths, bool keep_creases,
                     std::vector<hooks::CollapseRequest>& out) {
    candidates_.clear();
    for (std::uint32_t e = 0; e < mesh.edges.size(); ++e) {
        const auto& [a, b] = mesh.edges[e].vertices;
        const double ratio = mesh.lengths[e] / lengths.along(a, b);
        if (ratio < collapse_below && mesh.fixed[a] == 0 && mesh.fixed[b] == 0)
            candidates_.push_back({ratio, e});
    }
    std::sort(candidates_.begin(), candidates_.end());
    asked_.clear();
    for (const Candidate& c : candidates_) {
        const auto& [a, b] = mesh.edges[c.edge].vertices;
        if (blocked_[a] != 0 || blocked_[b] != 0) continue;
        // An attempt that this surface does not allow is skipped.
        hooks::CollapseRequest request;
        bool found = false;
        const std::uint64_t births = births_of(mesh, c.edge);
        unsigned attempt = attempts_at(tried_collapses_, births);
        for (; attempt < collapse_attempts && !found; ++attempt) {
            found = place_of(mesh, c.edge, attempt, keep_creases, request) &&
                    fits(mesh, lengths, request);
        }
        if (!found) continue;
        out.push_back(request);
        asked_.push_back({births, attempt});
        block_ring(mesh, a);
        block_ring(mesh, b);
    }
    note_asked(tried_collapses_);
}

void Edits::flip(const EdgeMesh& mesh, double flatness, std::vector<hooks::FlipRequest>& out) {
    candidates_.clear();
    for (std::uint32_t e = 0; e < mesh.edges.size(); ++e) {
        const surface::ViewEdge& edge = mesh.edges[e];
        if (edge.face_count != 2 || mesh.cosines[e] < flatness) continue;
        const Vec3 &a = mesh.place(edge.vertices[0]), &b = mesh.place(edge.vertices[1]);
        // The sum of two angles is above pi if the sum of their cotangents is below 0.
        const double sum = cotangent(mesh.place(mesh.opposite(e, 0)), a, b) +
                           cotangent(mesh.place(mesh.opposite(e, 1)), a, b);
        if (sum < -least_overlap) candidates_.push_back({sum, e});
    }
    std::sort(candidates_.begin(), candidates_.end());
    asked_.clear();
    for (const Candidate& c : candidates_) {
        if (!may_flip(mesh, c.edge)) continue;
        const surface::ViewEdge& edge = mesh.edges[c.edge];
        out.push_back({edge.vertices, flatness});
        const std::uint64_t births = births_of(mesh, c.edge);
        asked_.push_back({births, attempts_at(tried_flips_, births) + 1});
        used_[edge.faces[0]] = used_[edge.faces[1]] = 1;
    }
    note_asked(tried_flips_);
}

bool Edits::may_flip(const EdgeMesh& mesh, std::uint32_t e) {
    const surface::SurfaceView& view = *mesh.view;
    const surface::ViewEdge& edge = mesh.edges[e];
    if (used_[edge.faces[0]] != 0 || used_[edge.faces[1]] != 0) return false;
    if (attempts_at(tried_flips_, births_of(mesh, e)) >= flip_attempts) return false;
    const std::uint32_t p = mesh.opposite(e, 0), q = mesh.opposite(e, 1);
    const auto& [a, b] = edge.vertices;
    if (view.faces_of(a).size() < 4 || view.faces_of(b).size() < 4) return false;
    ring_of(mesh, p, near_a_);
    if (std::binary_search(near_a_.begin(), near_a_.end(), q)) return false;
    // Both new faces must have the orientation of the old ones.
    const Vec3 normal = view.face_normals[edge.faces[0]] + view.face_normals[edge.faces[1]];
    const Vec3 &pa = mesh.place(a), &pb = mesh.place(b), &pp = mesh.place(p), &pq = mesh.place(q);
    const Vec3 first = (pq - pp).cross(pa - pp), second = (pb - pp).cross(pq - pp);
    return first.dot(normal) * second.dot(normal) > 0.0;
}

void Edits::move(const EdgeMesh& mesh, const Lengths& lengths,
                 std::vector<hooks::MoveRequest>& out) {
    const surface::SurfaceView& view = *mesh.view;
    for (std::uint32_t v = 0; v < view.vertex_count(); ++v) {
        if (mesh.fixed[v] != 0 || mesh.creases[v] > 0) continue;
        Vec3 sum = Vec3::Zero(), normal = Vec3::Zero();
        double area = 0.0;
        for (const std::uint32_t f : view.faces_of(v)) {
            const auto& [a, b, c] = view.faces[f];
            sum += view.face_areas[f] / 3.0 *
                   (view.positions[a] + view.positions[b] + view.positions[c]);
            normal += view.face_areas[f] * view.face_normals[f];
            area += view.face_areas[f];
        }
        const double length = normal.norm();
        if (!(area > 0.0) || !(length > 0.0)) continue;
        normal /= length;
        Vec3 way = 0.5 * (sum / area - view.positions[v]);
        way -= way.dot(normal) * normal;
        if (way.norm() < least_move * lengths.at(v)) continue;
        out.push_back({v, view.positions[v] + way});
    }
}

}  // namespace dsc::remesh
