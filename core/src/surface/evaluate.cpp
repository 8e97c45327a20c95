// Compares surfaces with surfaces and clouds.
#include <algorithm>
#include <cmath>
#include <numeric>

#include <dsc/base/error.hpp>
#include <dsc/base/workers.hpp>
#include <dsc/geometry/quality.hpp>
#include <dsc/surface/distance.hpp>
#include <dsc/surface/measure.hpp>

namespace dsc::surface {
namespace {

/// Calls nearest(i) for every i of [0, count), over fixed blocks.
template <class Nearest>
std::vector<NearestHit> all_nearest(std::size_t count, Workers* workers, Nearest&& nearest) {
    std::vector<NearestHit> hits(count);
    Workers alone;
    (workers != nullptr ? *workers : alone)
        .for_blocks(count, 1024, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) hits[i] = nearest(i);
        });
    return hits;
}

double mean(const std::vector<double>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// Quantile with linear interpolation between order statistics, as the default of numpy.
double quantile(std::vector<double> values, double q) {
    const double place = q * static_cast<double>(values.size() - 1);
    const auto below = static_cast<std::ptrdiff_t>(place);
    std::nth_element(values.begin(), values.begin() + below, values.end());
    const double low = values[static_cast<std::size_t>(below)];
    const double part = place - static_cast<double>(below);
    if (part <= 0.0) return low;
    return low + part * (*std::min_element(values.begin() + below + 1, values.end()) - low);
}

double share_below(const std::vector<double>& values, double limit) {
    const auto n = std::count_if(values.begin(), values.end(), [&](double d) { return d < limit; });
    return static_cast<double>(n) / static_cast<double>(values.size());
}

/// One direction of the comparison: samples of one surface against the other.
struct OneWay {
    std::vector<double> distances;  // fractions of the diagonal
    double normal_consistency = 0.0;
};

OneWay compare(const TriangleMesh& from, const TriangleMesh& to, double diagonal,
               const EvaluateOptions& options, std::uint64_t instance) {
    const SurfaceSamples samples =
        sample_surface(from, options.samples, RandomKey{options.seed, instance, 0, 0});
    const TriangleTree tree(to);
    const auto hits = all_nearest(samples.points.size(), options.workers,
                                  [&](std::size_t i) { return tree.nearest(samples.points[i]); });
    const auto from_normals = face_normals(from), to_normals = face_normals(to);
    OneWay out;
    out.distances.reserve(hits.size());
    double agreement = 0.0;
    for (std::size_t i = 0; i < hits.size(); ++i) {
        out.distances.push_back(hits[i].distance / diagonal);
        agreement += std::abs(from_normals[samples.faces[i]].dot(to_normals[hits[i].index]));
    }
    out.normal_consistency = agreement / static_cast<double>(hits.size());
    return out;
}

double f_score(const OneWay& a, const OneWay& b, double limit) {
    const double precision = share_below(a.distances, limit),
                 recall = share_below(b.distances, limit);
    return precision + recall > 0.0 ? 2.0 * precision * recall / (precision + recall) : 0.0;
}

DistanceFigures figures_of(const std::vector<NearestHit>& hits) {
    DistanceFigures out{0.0, hits.front().distance, 0.0};
    for (const NearestHit& hit : hits) {
        out.mean += hit.distance;
        out.min = std::min(out.min, hit.distance);
        out.max = std::max(out.max, hit.distance);
    }
    out.mean /= static_cast<double>(hits.size());
    return out;
}

}  // namespace

SurfaceSamples sample_surface(const TriangleMesh& mesh, std::size_t count, RandomKey key) {
    require_sound(mesh);
    std::vector<double> cumulative;
    cumulative.reserve(mesh.faces.size());
    double total = 0.0;
    for (const auto& [a, b, c] : mesh.faces) {
        total += geometry::triangle_area(mesh.points[a], mesh.points[b], mesh.points[c]);
        cumulative.push_back(total);
    }
    if (!(total > 0.0) || !std::isfinite(total)) {
        throw GeometryError("surface.empty", "surface", "the mesh has no area to sample",
                            "provide at least one face that is not degenerate");
    }
    const auto last = std::lower_bound(cumulative.begin(), cumulative.end(), total);
    SurfaceSamples out;
    out.points.reserve(count);
    out.faces.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
        key.element = i;
        RandomStream random(key);
        const auto found = std::min(
            std::upper_bound(cumulative.begin(), cumulative.end(), random.uniform() * total), last);
        const auto face = static_cast<std::size_t>(found - cumulative.begin());
        const Vec3 &a = mesh.points[mesh.faces[face][0]], &b = mesh.points[mesh.faces[face][1]],
                   &c = mesh.points[mesh.faces[face][2]];
        const double r = std::sqrt(random.uniform()), s = random.uniform();
        out.points.push_back((1.0 - r) * a + r * (1.0 - s) * b + r * s * c);
        out.faces.push_back(static_cast<std::uint32_t>(face));
    }
    return out;
}

Evaluation evaluate(const TriangleMesh& recon, const TriangleMesh& truth,
                    const EvaluateOptions& options) {
    if (options.samples == 0)
        throw UsageError("evaluate.samples", "samples", "0 samples are requested",
                         "request at least 1");
    require_sound(truth);
    Evaluation out;
    out.diagonal = used_box(truth).diagonal();
    const OneWay there = compare(recon, truth, out.diagonal, options, stream_id("evaluate.recon"));
    const OneWay back = compare(truth, recon, out.diagonal, options, stream_id("evaluate.truth"));
    out.accuracy = mean(there.distances);
    out.completeness = mean(back.distances);
    out.chamfer = 0.5 * (out.accuracy + out.completeness);
    out.hausdorff = std::max(*std::max_element(there.distances.begin(), there.distances.end()),
                             *std::max_element(back.distances.begin(), back.distances.end()));
    out.hausdorff99 = std::max(quantile(there.distances, 0.99), quantile(back.distances, 0.99));
    out.f_score_05 = f_score(there, back, 0.005);
    out.f_score_1 = f_score(there, back, 0.01);
    out.normal_consistency = 0.5 * (there.normal_consistency + back.normal_consistency);
    return out;
}

CloudDistances cloud_distances(const TriangleMesh& surface, std::span<const Vec3> cloud,
                               Workers* workers) {
    const TriangleTree faces(surface);
    const PointTree points(cloud);
    std::vector<bool> used(surface.points.size(), false);
    for (const auto& face : surface.faces) {
        for (const std::uint32_t v : face) used[v] = true;
    }
    CloudDistances out;
    for (std::uint32_t v = 0; v < surface.points.size(); ++v) {
        if (used[v]) out.vertices.push_back(v);
    }
    out.of_vertices = all_nearest(out.vertices.size(), workers, [&](std::size_t i) {
        return points.nearest(surface.points[out.vertices[i]]);
    });
    out.of_points =
        all_nearest(cloud.size(), workers, [&](std::size_t i) { return faces.nearest(cloud[i]); });
    return out;
}

CloudEvaluation evaluate_cloud(const CloudDistances& distances) {
    return {figures_of(distances.of_vertices), figures_of(distances.of_points)};
}

CloudEvaluation evaluate_cloud(const TriangleMesh& surface, std::span<const Vec3> cloud,
                               Workers* workers) {
    return evaluate_cloud(cloud_distances(surface, cloud, workers));
}

}  // namespace dsc::surface
