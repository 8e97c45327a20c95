#include "labels.hpp"

#include <algorithm>

#include <dsc/base/error.hpp>
#include <dsc/cloud/search.hpp>
#include <dsc/cloud/winding_field.hpp>
#include <dsc/generate/graded_lattice.hpp>

#include "witness.hpp"

namespace dsc::indicator {
namespace {

/// Smoothing length of the field, in widths of the samples.
constexpr double smoothing = 0.5;
/// The finest cells have the size for samples at this quantile of the widths.
constexpr double finest_quantile = 0.05;
/// A cell with both labels is split while it is larger than this fraction of its distance to the
/// cloud.
constexpr double cell_per_distance = 0.35;
/// Cells may be larger than wanted by this factor, because sizes are powers of two.
constexpr double slack = 1.2;
constexpr unsigned most_rounds = 8;

std::vector<cloud::SurfaceSample> used_samples(const cloud::Orientation& orientation) {
    std::vector<cloud::SurfaceSample> used;
    used.reserve(orientation.samples.size());
    for (const cloud::SurfaceSample& sample : orientation.samples) {
        if (sample.width > 0.0 && sample.area != Vec3::Zero()) used.push_back(sample);
    }
    if (used.empty()) {
        throw GeometryError(
            "indicator.no_samples", generator_name,
            "no point of the cloud has a normal, so inside and outside cannot be distinguished",
            "check the cloud, or use another initial mesh");
    }
    return used;
}

double width_quantile(std::span<const cloud::SurfaceSample> samples, double at) {
    std::vector<double> widths;
    widths.reserve(samples.size());
    for (const cloud::SurfaceSample& sample : samples) widths.push_back(sample.width);
    const auto n = static_cast<std::ptrdiff_t>(at * static_cast<double>(widths.size() - 1));
    std::nth_element(widths.begin(), widths.begin() + n, widths.end());
    return widths[static_cast<std::size_t>(n)];
}

generate::GradedLattice make_lattice(std::span<const cloud::SurfaceSample> samples,
                                     const LabelOptions& options, double half_box) {
    generate::LatticeOptions lattice;
    lattice.box = half_box;
    const double most = 2.0 * half_box / generate::most_graded_cells * 1.01;
    lattice.cell = std::max(options.cell * width_quantile(samples, finest_quantile), most);
    std::vector<generate::CellSize> sizes;
    sizes.reserve(samples.size());
    for (const cloud::SurfaceSample& sample : samples)
        sizes.push_back({sample.position, slack * options.cell * sample.width});
    return {lattice, sizes, generator_name};
}

/// The values of vertices from `first` on: the winding number minus 1/2, never 0.
void evaluate(const cloud::WindingField& field, const generate::GradedLattice& lattice,
              std::size_t first, std::vector<double>& values, Workers* workers) {
    const std::span<const Vec3> points = lattice.points();
    values.resize(points.size());
    const auto fresh = std::span(values).subspan(first);
    field.evaluate(points.subspan(first), {}, fresh, workers);
    for (double& value : fresh) {
        value -= 0.5;
        if (value == 0.0) value = -1e-9;
    }
}

/// Splits cells with both labels that are too large for the samples there, until there are none.
unsigned refine(generate::GradedLattice& lattice, std::span<const cloud::SurfaceSample> samples,
                const cloud::NearestSearch& search, const cloud::WindingField& field,
                const LabelOptions& options, std::vector<double>& values, Workers* workers) {
    const auto too_large = [&](const generate::GradedLattice::Leaf& leaf) {
        if (!generate::has_mixed_signs(leaf, values)) return false;
        const cloud::Neighbour near = search.nearest(lattice.points()[leaf.vertices[8]]);
        return leaf.edge > slack * std::max(options.cell * samples[near.index].width,
                                            cell_per_distance * near.distance);
    };
    for (unsigned round = 0; round < most_rounds; ++round) {
        const std::size_t before = lattice.split_where(too_large);
        if (before == lattice.points().size()) return round;
        evaluate(field, lattice, before, values, workers);
    }
    return most_rounds;
}

/// Filters the values. Samples may confirm loops if weak values are rare: where they are not, the
/// normals of the samples are as doubtful as the values.
generate::TopologyFilterReport filter_loops(Labels& labels,
                                            std::span<const cloud::SurfaceSample> samples,
                                            const cloud::NearestSearch& search,
                                            const LabelOptions& options) {
    const auto& points = labels.lattice.points;
    const auto& tets = labels.lattice.tets;
    const std::vector<double> unfiltered = labels.values;
    const generate::LoopWitness witness =
        tangent_plane_witness(samples, search, points, unfiltered);
    generate::TopologyFilterReport report =
        generate::filter_topology(points, tets, labels.values, options.certain, witness);
    const auto most = static_cast<std::size_t>(most_changed * static_cast<double>(labels.samples));
    if (report.confirmed.empty() || report.refused <= most) return report;
    labels.values = unfiltered;
    return generate::filter_topology(points, tets, labels.values, options.certain);
}

/// Keeps only those cells small that the interface needs.
void coarsen(const generate::GradedLattice& lattice, Labels& labels, Workers* workers,
             const CancelToken* cancel) {
    std::vector<std::uint32_t> origins;
    const generate::GradedLattice coarse = lattice.coarsened(labels.values, origins);
    std::vector<double> values;
    values.reserve(origins.size());
    for (const std::uint32_t v : origins) values.push_back(labels.values[v]);
    labels.values = std::move(values);
    labels.lattice.points.assign(coarse.points().begin(), coarse.points().end());
    labels.lattice.tets = coarse.tets(workers, cancel);
    labels.lattice.labels.assign(labels.lattice.tets.size(), 0);
}

/// The vertex near each sample.
std::vector<std::uint32_t> vertices_near(const generate::GradedLattice& lattice,
                                         std::span<const Vec3> places) {
    std::vector<std::uint32_t> vertices;
    vertices.reserve(places.size());
    for (const Vec3& p : places) vertices.push_back(lattice.vertex_near(p));
    return vertices;
}

}  // namespace

std::size_t Labels::settled() const {
    std::size_t sum = 0;
    for (const generate::LabelComponent& component : components)
        sum += component.kept ? 0 : component.vertices;
    return sum;
}

double Labels::changed_share() const {
    return samples == 0
               ? 0.0
               : static_cast<double>(filter.refused + settled()) / static_cast<double>(samples);
}

double Labels::weak_share() const {
    std::size_t confirmed = 0;
    for (const generate::RefusedCluster& cluster : filter.confirmed)
        confirmed += cluster.vertices.size();
    return changed_share() +
           (samples == 0 ? 0.0 : static_cast<double>(confirmed) / static_cast<double>(samples));
}

Labels label_lattice(const cloud::Orientation& orientation, const LabelOptions& options,
                     double half_box, Workers* workers, const CancelToken* cancel) {
    const std::vector<cloud::SurfaceSample> samples = used_samples(orientation);
    std::vector<Vec3> places;
    places.reserve(samples.size());
    for (const cloud::SurfaceSample& sample : samples) places.push_back(sample.position);
    const cloud::NearestSearch search(places);
    const cloud::WindingField field = cloud::winding_field(samples, smoothing);
    generate::GradedLattice lattice = make_lattice(samples, options, half_box);
    Labels out;
    evaluate(field, lattice, 0, out.values, workers);
    out.rounds = refine(lattice, samples, search, field, options, out.values, workers);
    out.samples = orientation.samples.size();
    out.width = width_quantile(samples, 0.5);

    out.lattice.points.assign(lattice.points().begin(), lattice.points().end());
    out.lattice.tets = lattice.tets(workers, cancel);
    out.lattice.labels.assign(out.lattice.tets.size(), 0);
    const auto& points = out.lattice.points;
    const auto& tets = out.lattice.tets;
    out.filter = filter_loops(out, samples, search, options);
    const std::vector<std::uint32_t> near = vertices_near(lattice, places);
    generate::ComponentOptions settle;
    settle.cavities = options.cavities;
    settle.remove_islands = options.remove_islands;
    settle.width = out.width;
    settle.least_volume = options.least_volume;
    settle.certain = options.certain;
    out.components = generate::settle_components(points, tets, out.values, lattice.volumes(),
                                                 {places, near}, settle);
    coarsen(lattice, out, workers, cancel);
    out.counts = generate::count_topology(points, tets, out.values);
    if (out.counts.components == 0) {
        throw GeometryError("indicator.nothing_inside", generator_name,
                            "the points enclose nothing: no place has a winding number above 1/2",
                            "check that the cloud is the surface of a solid and dense enough");
    }
    return out;
}

}  // namespace dsc::indicator
