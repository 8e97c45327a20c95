#include "mesh/stuff_smooth.hpp"

#include <algorithm>

#include <dsc/base/error.hpp>
#include <dsc/geometry/quality.hpp>

namespace dsc::mesh::stuffing {
namespace {

constexpr unsigned halvings = 3;
constexpr double bad = 0.2;  // quality below which a tet's free vertices are moved
constexpr unsigned improvements = 3;

double quality(const TetMesh& mesh, const Corners& t) {
    const auto& p = mesh.points;
    return geometry::tet_quality(p[t[0]], p[t[1]], p[t[2]], p[t[3]]);
}

class Mover {
public:
    Mover(Stuffed& stuffed, std::span<const char> on_interface, double least)
        : mesh_(stuffed.mesh), stars_(mesh_.tets, on_interface), least_(least) {}

    // Whether the whole way could be gone.
    bool move(std::uint32_t v, const Vec3& target) {
        const Vec3 start = mesh_.points[v];
        const auto star = stars_.of(v);
        bounds_.clear();
        for (const std::uint32_t t : star) bounds_.push_back(std::min(least_, quality(mesh_, mesh_.tets[t])));
        double share = 1.0;
        for (unsigned i = 0; i <= halvings; ++i, share *= 0.5) {
            mesh_.points[v] = start + share * (target - start);
            bool good = true;
            for (std::size_t k = 0; k < star.size() && good; ++k) good = quality(mesh_, mesh_.tets[star[k]]) >= bounds_[k];
            if (good) return i == 0;
        }
        mesh_.points[v] = start;
        return false;
    }

private:
    TetMesh& mesh_;
    StarTable stars_;
    double least_;
    std::vector<double> bounds_;
};

}  // namespace

void move_to_targets(Stuffed& stuffed, std::span<const Snapped> snapped, const StuffOptions& options, StuffReport& report) {
    std::vector<char> marks(stuffed.mesh.points.size(), 0);
    for (const Snapped& s : snapped) marks[s.vertex] = 1;
    Mover mover(stuffed, marks, options.least_quality);
    for (const Snapped& s : snapped) {
        if (!mover.move(s.vertex, s.target)) ++report.clipped_moves;
    }
}

void smooth_interface(Stuffed& stuffed, const StuffOptions& options, StuffReport& report, const CancelToken* cancel) {
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
    std::vector<Vec3> sums(points);
    for (unsigned sweep = 0; sweep < options.smoothing_sweeps; ++sweep) {
        if (cancel != nullptr && cancel->cancelled()) throw CancelledError("the initial mesh was not finished");
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

void improve_free_vertices(Stuffed& stuffed, Workers* workers) {
    TetMesh& mesh = stuffed.mesh;
    constexpr std::size_t block = 16384;
    std::vector<std::vector<std::uint32_t>> found(mesh.tets.size() / block + 1);
    for_blocks(workers, mesh.tets.size(), block, [&](std::size_t begin, std::size_t end) {
        for (std::size_t t = begin; t < end; ++t) {
            if (quality(mesh, mesh.tets[t]) < bad) found[begin / block].push_back(static_cast<std::uint32_t>(t));
        }
    });
    std::vector<char> marks(mesh.points.size(), 0);
    for (const auto& tets : found) {
        for (const std::uint32_t t : tets) {
            for (const std::uint32_t v : mesh.tets[t]) marks[v] = 1;
        }
    }
    for (const Face& f : stuffed.faces) {
        for (const std::uint32_t v : f) marks[v] = 0;
    }
    std::vector<std::uint32_t> free;
    const Box3 box = bounding_box(mesh.points);
    for (std::uint32_t v = 0; v < marks.size(); ++v) {
        const auto p = mesh.points[v].array();
        if ((p <= box.low.array()).any() || (p >= box.high.array()).any()) marks[v] = 0;
        if (marks[v] != 0) free.push_back(v);
    }
    if (free.empty()) return;
    const StarTable stars(mesh.tets, marks);
    const auto least_of = [&](std::span<const std::uint32_t> star, double bound) {
        double least = 1.0;
        for (const std::uint32_t t : star) {
            least = std::min(least, quality(mesh, mesh.tets[t]));
            if (least <= bound) break;
        }
        return least;
    };
    for (unsigned round = 0; round < improvements; ++round) {
        for (const std::uint32_t v : free) {
            const auto star = stars.of(v);
            const double before = least_of(star, -1.0);
            if (before >= bad) continue;
            // Every neighbour counts once per tet in which it is.
            Vec3 sum = Vec3::Zero();
            for (const std::uint32_t t : star) {
                for (const std::uint32_t w : mesh.tets[t]) sum += mesh.points[w];
            }
            const Vec3 start = mesh.points[v], target = (sum / static_cast<double>(star.size()) - start) / 3.0;
            double share = 1.0;
            bool better = false;
            for (unsigned i = 0; i <= halvings && !better; ++i, share *= 0.5) {
                mesh.points[v] = start + share * (target - start);
                better = least_of(star, before) > before;
            }
            if (!better) mesh.points[v] = start;
        }
    }
}

double least_quality(const TetMesh& mesh, Workers* workers) {
    constexpr std::size_t block = 16384;
    std::vector<double> least(mesh.tets.size() / block + 1, 1.0);
    for_blocks(workers, mesh.tets.size(), block, [&](std::size_t begin, std::size_t end) {
        double& own = least[begin / block];
        for (std::size_t t = begin; t < end; ++t) own = std::min(own, quality(mesh, mesh.tets[t]));
    });
    return *std::min_element(least.begin(), least.end());
}

}  // namespace dsc::mesh::stuffing
