// Moves the vertices of a new interface and improves the free vertices near it.
#include "generate/stuff_smooth.hpp"

#include <algorithm>
#include <utility>

#include <dsc/base/error.hpp>
#include <dsc/geometry/quality.hpp>

namespace dsc::generate::stuffing {
namespace {

constexpr unsigned halvings = 3;
constexpr double bad = 0.35;  // quality below which a tet's free vertices are moved

double quality(const mesh::TetMesh& mesh, const Corners& t) {
    const auto& p = mesh.points;
    return geometry::tet_quality(p[t[0]], p[t[1]], p[t[2]], p[t[3]]);
}

class Mover {
public:
    Mover(Stuffed& stuffed, std::span<const char> on_interface, double least)
        : mesh_(stuffed.mesh), stars_(mesh_.tets, on_interface), least_(least) {}

    // Moves the vertex; returns whether it reached its target.
    bool move(std::uint32_t v, const Vec3& target) {
        const Vec3 start = mesh_.points[v];
        double share = 1.0;
        for (unsigned i = 0; i <= halvings; ++i, share *= 0.5) {
            mesh_.points[v] = start + share * (target - start);
            const auto star = stars_.of(v);
            const auto good = [&](std::uint32_t t) {
                return good_after_move(v, start, mesh_.tets[t]);
            };
            if (std::all_of(star.begin(), star.end(), good)) return i == 0;
        }
        mesh_.points[v] = start;
        return false;
    }

private:
    bool good_after_move(std::uint32_t v, const Vec3& start, const Corners& tet) {
        const double now = quality(mesh_, tet);
        if (now >= least_) return true;
        const Vec3 moved = std::exchange(mesh_.points[v], start);
        const double before = quality(mesh_, tet);
        mesh_.points[v] = moved;
        return now >= before;
    }

    mesh::TetMesh& mesh_;
    StarTable stars_;
    double least_;
};

void move_all(Mover& mover, std::span<const Snapped> snapped, StuffReport& report) {
    for (const Snapped& s : snapped) {
        if (!mover.move(s.vertex, s.target)) ++report.clipped_moves;
    }
}

// Returns the least quality of all tets.
double find_bad_tets(const mesh::TetMesh& mesh, Workers* workers, std::vector<std::uint32_t>& out) {
    constexpr std::size_t block = 16384;
    struct Found {
        double least = 1.0;
        std::vector<std::uint32_t> tets;
    };
    std::vector<Found> found(mesh.tets.size() / block + 1);
    for_blocks(workers, mesh.tets.size(), block, [&](std::size_t begin, std::size_t end) {
        Found& own = found[begin / block];
        for (std::size_t t = begin; t < end; ++t) {
            const double q = quality(mesh, mesh.tets[t]);
            own.least = std::min(own.least, q);
            if (q < bad) own.tets.push_back(static_cast<std::uint32_t>(t));
        }
    });
    out.clear();
    double least = 1.0;
    for (const Found& part : found) {
        least = std::min(least, part.least);
        out.insert(out.end(), part.tets.begin(), part.tets.end());
    }
    return least;
}

double least_of(const mesh::TetMesh& mesh, std::span<const std::uint32_t> star, double bound) {
    double least = 1.0;
    for (const std::uint32_t t : star) {
        least = std::min(least, quality(mesh, mesh.tets[t]));
        if (least <= bound) break;
    }
    return least;
}

void improve(mesh::TetMesh& mesh, std::uint32_t v, std::span<const std::uint32_t> star) {
    const double before = least_of(mesh, star, -1.0);
    if (before >= bad) return;
    // Every neighbour counts once per tet that contains it.
    const Vec3 start = mesh.points[v];
    Vec3 way = Vec3::Zero();
    for (const std::uint32_t t : star) {
        for (const std::uint32_t w : mesh.tets[t]) way += mesh.points[w] - start;
    }
    way /= 3.0 * static_cast<double>(star.size());
    double share = 1.0;
    for (unsigned i = 0; i <= halvings; ++i, share *= 0.5) {
        mesh.points[v] = start + share * way;
        if (least_of(mesh, star, before) > before) return;
    }
    mesh.points[v] = start;
}

}  // namespace

void move_to_targets(Stuffed& stuffed, std::span<const Snapped> snapped,
                     const StuffOptions& options, StuffReport& report) {
    std::vector<char> marks(stuffed.mesh.points.size(), 0);
    for (const Snapped& s : snapped) marks[s.vertex] = 1;
    Mover mover(stuffed, marks, options.least_quality);
    move_all(mover, snapped, report);
}

void smooth_interface(Stuffed& stuffed, std::span<const Snapped> snapped,
                      const StuffOptions& options, StuffReport& report, const CancelToken* cancel) {
    const std::size_t points = stuffed.mesh.points.size();
    std::vector<char> on_interface(points, 0);
    std::vector<std::uint32_t> degree(points, 0);
    for (const Face& f : stuffed.faces) {
        for (const std::uint32_t v : f) {
            on_interface[v] = 1;
            ++degree[v];
        }
    }
    Mover mover(stuffed, on_interface, options.least_quality);
    move_all(mover, snapped, report);
    std::vector<Vec3> sums(points);
    for (unsigned sweep = 0; sweep < options.smoothing_sweeps; ++sweep) {
        if (cancel != nullptr && cancel->cancelled())
            throw CancelledError("the run was stopped while it made its initial mesh");
        std::fill(sums.begin(), sums.end(), Vec3::Zero());
        // Each neighbour is in two faces.
        const auto& p = stuffed.mesh.points;
        for (const auto& [a, b, c] : stuffed.faces) {
            sums[a] += p[b] + p[c];
            sums[b] += p[c] + p[a];
            sums[c] += p[a] + p[b];
        }
        for (std::uint32_t v = 0; v < points; ++v) {
            if (on_interface[v] == 0) continue;
            const Vec3 target = 0.5 * p[v] + sums[v] * (0.25 / degree[v]);
            if (!mover.move(v, target)) ++report.clipped_moves;
        }
    }
}

double improve_free_vertices(Stuffed& stuffed, Workers* workers) {
    mesh::TetMesh& mesh = stuffed.mesh;
    std::vector<std::uint32_t> bad_tets;
    const double before = find_bad_tets(mesh, workers, bad_tets);
    if (bad_tets.empty()) return before;
    std::vector<char> marks(mesh.points.size(), 0);
    for (const std::uint32_t t : bad_tets) {
        for (const std::uint32_t v : mesh.tets[t]) marks[v] = 1;
    }
    for (const Face& f : stuffed.faces) {
        for (const std::uint32_t v : f) marks[v] = 0;
    }
    std::vector<std::uint32_t> free;
    const Box3 box = bounding_box(mesh.points);
    for (std::uint32_t v = 0; v < marks.size(); ++v) {
        if (marks[v] != 0 && lies_on(box, mesh.points[v])) marks[v] = 0;
        if (marks[v] != 0) free.push_back(v);
    }
    const StarTable stars(mesh.tets, marks);
    for (const std::uint32_t v : free) improve(mesh, v, stars.of(v));
    // All other tets have at least the quality `bad`.
    double least = 1.0;
    for (const std::uint32_t t : bad_tets) least = std::min(least, quality(mesh, mesh.tets[t]));
    for (const std::uint32_t v : free) least = std::min(least, least_of(mesh, stars.of(v), -1.0));
    return least < bad ? least : find_bad_tets(mesh, workers, bad_tets);
}

}  // namespace dsc::generate::stuffing
