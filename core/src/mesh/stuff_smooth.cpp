#include "mesh/stuff_smooth.hpp"

#include <algorithm>

#include <dsc/base/error.hpp>
#include <dsc/geometry/quality.hpp>

namespace dsc::mesh::stuffing {
namespace {

constexpr unsigned halvings = 3;

class Mover {
public:
    Mover(Stuffed& stuffed, std::span<const char> on_interface, double least)
        : mesh_(stuffed.mesh), stars_(mesh_.tets, on_interface), least_(least) {}

    // Whether the whole way could be gone.
    bool move(std::uint32_t v, const Vec3& target) {
        const Vec3 start = mesh_.points[v];
        const auto star = stars_.of(v);
        bounds_.clear();
        for (const std::uint32_t t : star) bounds_.push_back(std::min(least_, quality(mesh_.tets[t])));
        double share = 1.0;
        for (unsigned i = 0; i <= halvings; ++i, share *= 0.5) {
            mesh_.points[v] = start + share * (target - start);
            bool good = true;
            for (std::size_t k = 0; k < star.size() && good; ++k) good = quality(mesh_.tets[star[k]]) >= bounds_[k];
            if (good) return i == 0;
        }
        mesh_.points[v] = start;
        return false;
    }

private:
    double quality(const Corners& t) const {
        const auto& p = mesh_.points;
        return geometry::tet_quality(p[t[0]], p[t[1]], p[t[2]], p[t[3]]);
    }

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

}  // namespace dsc::mesh::stuffing
