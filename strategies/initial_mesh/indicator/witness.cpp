// Votes of the nearest samples about refused vertices.
#include "witness.hpp"

#include <cmath>

namespace dsc::indicator {
namespace {

/// Number of samples that vote about a vertex.
constexpr std::size_t voters = 8;
/// A cluster with fewer vertices, or with weaker values, is as likely to be an error of the field
/// as a part of the solid.
constexpr std::size_t least_vertices = 6;
constexpr double least_level = 0.08;
/// Least share of the votes for the labels before the filter.
constexpr double agreement = 0.65;

}  // namespace

generate::LoopWitness tangent_plane_witness(std::span<const cloud::SurfaceSample> samples,
                                            const cloud::NearestSearch& search,
                                            std::span<const Vec3> points,
                                            std::span<const double> values) {
    return [=, &search](const generate::RefusedCluster& cluster) {
        if (cluster.vertices.size() < least_vertices || cluster.level < least_level) return false;
        // The strongest vertices are those in the middle of the handle or tunnel, so they count
        // most.
        double votes = 0.0, all = 0.0;
        std::vector<cloud::Neighbour> near;
        for (const std::uint32_t v : cluster.vertices) {
            search.k_nearest(points[v], voters, near);
            const double weight = std::abs(values[v]);
            for (const cloud::Neighbour& n : near) {
                const bool inside =
                    samples[n.index].area.dot(points[v] - samples[n.index].position) < 0.0;
                if (inside == cluster.was_inside) votes += weight;
                all += weight;
            }
        }
        return votes >= agreement * all;
    };
}

}  // namespace dsc::indicator
