// Prepares a cloud for its orientation: unique points, cells, neighbours, planes.
#include "samples.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <dsc/base/median.hpp>
#include <dsc/cloud/orientation.hpp>
#include <dsc/geometry/order.hpp>

#include "cells.hpp"
#include "local_shape.hpp"

namespace dsc::cloud {

namespace {

constexpr std::size_t neighbours_each = 16;
constexpr double wanted_cells = 20000.0;
constexpr double first_cell_edge = 0.01;
constexpr int cell_rounds = 4;
constexpr double noisy_cells = 0.4;  // noise of the means, in widths, above which larger cells are
                                     // used
constexpr double noise_per_cell = 3.0;  // edge of these larger cells, in noise scales

/// Samples without repeated points, in lexicographic order.
void make_unique(std::span<const Vec3> points, ScaledSamples& out) {
    std::vector<std::uint32_t> order(points.size());
    std::iota(order.begin(), order.end(), 0U);
    const auto less = [&](std::uint32_t i, std::uint32_t j) {
        return geometry::lexicographically_before(points[i], points[j]) ||
               (points[i] == points[j] && i < j);
    };
    if (!std::is_sorted(order.begin(), order.end(), less))
        std::sort(order.begin(), order.end(), less);
    out.of_point.resize(points.size());
    for (std::size_t n = 0; n < order.size(); ++n) {
        if (n == 0 || points[order[n]] != points[order[n - 1]]) {
            out.first_point.push_back(order[n]);
            out.counts.push_back(0);
        }
        out.of_point[order[n]] = static_cast<std::uint32_t>(out.first_point.size() - 1);
        ++out.counts.back();
    }
    const Box3 box = bounding_box(points);
    out.centre = box.centre();
    out.diagonal = box.diagonal();
    out.positions.reserve(out.first_point.size());
    for (const std::uint32_t i : out.first_point)
        out.positions.push_back((points[i] - out.centre) / out.diagonal);
}

void measure(ScaledSamples& samples, Workers* workers) {
    samples.neighbours = find_neighbours(samples.positions, neighbours_each, workers);
    samples.widths = label_widths(samples.neighbours, workers);
    samples.width = median_of(samples.widths);
    samples.noise = quadric_noise(samples.positions, samples.neighbours, workers);
}

/// The edge of cells with which about 20,000 cells contain points.
double cell_edge(std::span<const Vec3> positions) {
    double edge = first_cell_edge;
    for (int round = 0; round < cell_rounds; ++round)
        edge = std::max(
            edge * std::sqrt(static_cast<double>(count_cells(positions, edge)) / wanted_cells),
            least_cell_edge);
    return edge;
}

/// Replaces the samples, which are different points, by the means of their cells.
void cluster(const ScaledSamples& unique, double edge, ScaledSamples& out) {
    const Cells cells = cells_of(unique.positions, edge);
    out.positions = means_of(cells, unique.positions);
    out.first_point.assign(cells.counts.size(), 0);
    out.counts.assign(cells.counts.size(), 0);
    for (std::size_t u = unique.size(); u-- > 0;) {
        out.first_point[cells.of_point[u]] = unique.first_point[u];
        out.counts[cells.of_point[u]] += unique.counts[u];
    }
    out.of_point.resize(unique.of_point.size());
    for (std::size_t i = 0; i < out.of_point.size(); ++i)
        out.of_point[i] = cells.of_point[unique.of_point[i]];
}

ScaledSamples clustered_samples(const ScaledSamples& unique, Workers* workers) {
    ScaledSamples out;
    out.centre = unique.centre;
    out.diagonal = unique.diagonal;
    out.clustered = true;
    const double edge = cell_edge(unique.positions);
    cluster(unique, edge, out);
    measure(out, workers);
    // The means are still noisy: use cells that are large enough to average the noise.
    const double wider = noise_per_cell * out.noise;
    if (out.noise > noisy_cells * out.width && wider > edge) {
        cluster(unique, wider, out);
        measure(out, workers);
    }
    return out;
}

}  // namespace

ScaledSamples scaled_samples(std::span<const Vec3> points, Workers* workers) {
    ScaledSamples samples;
    make_unique(points, samples);
    if (samples.size() > most_samples)
        samples = clustered_samples(samples, workers);
    else
        measure(samples, workers);
    samples.normals = plane_normals(samples.positions, samples.neighbours, workers);
    return samples;
}

}  // namespace dsc::cloud
