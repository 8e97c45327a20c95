// The winding field: sums over clusters [Barill2018] of order 0, for groups of neighbouring
// targets.
#include "dsc/cloud/winding_field.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>

#include <dsc/base/error.hpp>

#include "checks.hpp"
#include "winding_kernels.hpp"
#include "winding_tree.hpp"

namespace dsc::cloud {

namespace {

constexpr std::size_t source_leaf = 16;
constexpr std::size_t target_leaf = 48;
constexpr std::size_t leaves_per_block = 16;

// Least smoothing length, in units of the box: it keeps the sums finite where a target coincides
// with a source, and is below the resolution of the coordinates.
constexpr float least_half_square = 1e-15F;

/// The conversion of positions to floats.
struct Frame {
    Vec3 centre = Vec3::Zero();
    double scale = 1.0;

    std::array<float, 3> place(const Vec3& p) const {
        const Vec3 q = (p - centre) * scale;
        return {static_cast<float>(q.x()), static_cast<float>(q.y()), static_cast<float>(q.z())};
    }
    float half_square(double length) const {
        const double scaled = length * scale;
        return std::max(static_cast<float>(0.5 * scaled * scaled), least_half_square);
    }
};

std::vector<std::array<float, 3>> placed(const Frame& frame, std::span<const Vec3> points) {
    std::vector<std::array<float, 3>> result(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) result[i] = frame.place(points[i]);
    return result;
}

Frame frame_of(std::span<const Vec3> positions) {
    if (positions.empty())
        throw GeometryError("cloud.empty", "winding field", "no positions",
                            "at least one is needed");
    require_searchable(positions, "winding field");
    const Box3 box = bounding_box(positions);
    const double diagonal = box.diagonal();
    return {box.centre(), diagonal > 0.0 ? 1.0 / diagonal : 1.0};
}

ClusterTree tree_of(const Frame& frame, std::span<const Vec3> positions,
                    std::span<const double> weights) {
    // Weights are divided by the largest weight, so that they fit into floats.
    double largest = 0.0;
    for (const double weight : weights) largest = std::max(largest, weight);
    std::vector<float> relative(weights.size(), 1.0F);
    if (largest > 0.0)
        for (std::size_t i = 0; i < weights.size(); ++i)
            relative[i] = std::max(static_cast<float>(weights[i] / largest), 1e-6F);
    return {placed(frame, positions), relative, source_leaf};
}

/// The sources of a group of targets: clusters, and ranges of single points.
struct Interactions {
    std::vector<std::uint32_t> clusters;
    std::vector<std::array<std::uint32_t, 2>> ranges;
};

void collect(const ClusterTree& tree, const ClusterNode& targets, float opening,
             std::vector<std::uint32_t>& stack, Interactions& found) {
    found.clusters.clear();
    found.ranges.clear();
    stack.assign(1, 0U);
    while (!stack.empty()) {
        const std::uint32_t index = stack.back();
        stack.pop_back();
        const ClusterNode& node = tree.nodes()[index];
        const float dx = node.centre[0] - targets.centre[0];
        const float dy = node.centre[1] - targets.centre[1];
        const float dz = node.centre[2] - targets.centre[2];
        if (far_enough(node, targets, std::sqrt(dx * dx + dy * dy + dz * dz), opening)) {
            found.clusters.push_back(index);
        } else if (node.leaf()) {
            if (!found.ranges.empty() && found.ranges.back()[1] == node.begin)
                found.ranges.back()[1] = node.end;
            else
                found.ranges.push_back({node.begin, node.end});
        } else {
            stack.push_back(node.second);
            stack.push_back(index + 1);
        }
    }
}

/// Strengths of all sources in the order of the tree, and their sums per cluster.
struct Strengths {
    std::array<std::vector<float>, 3> points;
    std::vector<std::array<float, 3>> clusters;

    explicit Strengths(const ClusterTree& tree)
        : clusters(tree.nodes().size(), std::array<float, 3>{}) {
        for (std::vector<float>& component : points) component.assign(tree.order().size(), 0.0F);
    }
    void add_up(const ClusterTree& tree) {
        for (std::size_t n = clusters.size(); n-- > 0;) {
            const ClusterNode& node = tree.nodes()[n];
            for (std::size_t k = 0; k < 3; ++k) {
                float sum = 0.0F;
                if (node.leaf())
                    for (std::size_t i = node.begin; i < node.end; ++i) sum += points[k][i];
                else
                    sum = clusters[n + 1][k] + clusters[node.second][k];
                clusters[n][k] = sum;
            }
        }
    }
};

}  // namespace

struct WindingField::State {
    State(std::span<const Vec3> positions, std::span<const double> weights, double wanted_opening)
        : frame(frame_of(positions)),
          tree(tree_of(frame, positions, weights)),
          opening(static_cast<float>(wanted_opening)),
          half_squares(positions.size(), least_half_square),
          cluster_half_squares(tree.nodes().size(), least_half_square),
          vectors(tree),
          scalars(tree) {}

    /// Collects the sources of a group.
    void gather(const Interactions& found, const Strengths& strengths,
                WindingSources& sources) const {
        std::size_t count = found.clusters.size();
        for (const auto& range : found.ranges) count += range[1] - range[0];
        sources.resize(count);
        std::array<float*, winding_quantities> to{};
        for (std::size_t q = 0; q < to.size(); ++q) to[q] = sources.column(q);
        std::size_t at = 0;
        for (const std::uint32_t index : found.clusters) {
            const std::array<float, 3>& centre = tree.nodes()[index].centre;
            const std::array<float, 3>& strength = strengths.clusters[index];
            for (std::size_t k = 0; k < 3; ++k) {
                to[k][at] = centre[k];
                to[4 + k][at] = strength[k];
            }
            to[3][at] = cluster_half_squares[index];
            ++at;
        }
        const std::array<const float*, winding_quantities> from{
            tree.coordinates(0).data(), tree.coordinates(1).data(), tree.coordinates(2).data(),
            half_squares.data(),        strengths.points[0].data(), strengths.points[1].data(),
            strengths.points[2].data()};
        for (const auto& range : found.ranges) {
            for (std::size_t q = 0; q < from.size(); ++q)
                std::copy(from[q] + range[0], from[q] + range[1], to[q] + at);
            at += range[1] - range[0];
        }
    }

    void require_lists(Workers* workers) {
        if (!lists.empty()) return;
        std::vector<Interactions> built(tree.leaves().size());
        for_blocks(workers, built.size(), leaves_per_block,
                   [&](std::size_t begin, std::size_t end) {
                       std::vector<std::uint32_t> stack;
                       for (std::size_t n = begin; n < end; ++n)
                           collect(tree, tree.nodes()[tree.leaves()[n]], opening, stack, built[n]);
                   });
        lists = std::move(built);
    }

    /// Calls write(index of the position, sources, target) for all positions.
    template <class Write>
    void at_positions(const Strengths& strengths, Workers* workers, const Write& write) {
        require_lists(workers);
        for_blocks(workers, lists.size(), leaves_per_block,
                   [&](std::size_t begin, std::size_t end) {
                       WindingSources sources;
                       for (std::size_t n = begin; n < end; ++n) {
                           gather(lists[n], strengths, sources);
                           const ClusterNode& leaf = tree.nodes()[tree.leaves()[n]];
                           for (std::size_t i = leaf.begin; i < leaf.end; ++i)
                               write(tree.order()[i], sources,
                                     WindingTarget{tree.coordinates(0)[i], tree.coordinates(1)[i],
                                                   tree.coordinates(2)[i], half_squares[i]});
                       }
                   });
    }

    /// Calls write(index of the point, sources, target) for points elsewhere.
    template <class Write>
    void at_points(std::span<const Vec3> points, std::span<const double> smoothing,
                   Workers* workers, const Write& write) const {
        if (points.empty()) return;
        require_searchable(points, "winding field");
        const ClusterTree targets(placed(frame, points), {}, target_leaf);
        for_blocks(
            workers, targets.leaves().size(), leaves_per_block,
            [&](std::size_t begin, std::size_t end) {
                std::vector<std::uint32_t> stack;
                Interactions found;
                WindingSources sources;
                for (std::size_t n = begin; n < end; ++n) {
                    const ClusterNode& leaf = targets.nodes()[targets.leaves()[n]];
                    collect(tree, leaf, opening, stack, found);
                    gather(found, vectors, sources);
                    for (std::size_t i = leaf.begin; i < leaf.end; ++i) {
                        const std::uint32_t index = targets.order()[i];
                        write(index, sources,
                              WindingTarget{
                                  targets.coordinates(0)[i], targets.coordinates(1)[i],
                                  targets.coordinates(2)[i],
                                  smoothing.empty() ? 0.0F : frame.half_square(smoothing[index])});
                    }
                }
            });
    }

    static double number(float sum) { return static_cast<double>(sum) / (4.0 * std::numbers::pi); }
    static Vec3 vector(const std::array<float, 3>& sum, double factor) {
        return Vec3(static_cast<double>(sum[0]), static_cast<double>(sum[1]),
                    static_cast<double>(sum[2])) *
               (factor / (4.0 * std::numbers::pi));
    }

    Frame frame;
    ClusterTree tree;
    float opening;
    std::vector<float> half_squares;          ///< per position, in the tree's order
    std::vector<float> cluster_half_squares;  ///< their means per cluster
    Strengths vectors;
    Strengths scalars;                ///< the argument of `adjoint`, in the first component
    std::vector<Interactions> lists;  ///< per leaf; empty until needed
};

WindingField::WindingField(std::span<const Vec3> positions, std::span<const double> weights,
                           double opening)
    : state_(std::make_unique<State>(positions, weights, opening)) {}
WindingField::~WindingField() = default;
WindingField::WindingField(WindingField&&) noexcept = default;
WindingField& WindingField::operator=(WindingField&&) noexcept = default;

std::size_t WindingField::size() const noexcept { return state_->tree.order().size(); }

void WindingField::set_smoothing(std::span<const double> lengths) {
    const ClusterTree& tree = state_->tree;
    for (std::size_t i = 0; i < tree.order().size(); ++i)
        state_->half_squares[i] = state_->frame.half_square(lengths[tree.order()[i]]);
    std::vector<double> sums(tree.nodes().size());
    for (std::size_t n = tree.nodes().size(); n-- > 0;) {
        const ClusterNode& node = tree.nodes()[n];
        double sum = 0.0;
        if (node.leaf())
            for (std::size_t i = node.begin; i < node.end; ++i)
                sum += static_cast<double>(state_->half_squares[i]);
        else
            sum = sums[n + 1] + sums[node.second];
        sums[n] = sum;
        state_->cluster_half_squares[n] =
            static_cast<float>(sum / static_cast<double>(node.size()));
    }
}

void WindingField::set_vectors(std::span<const Vec3> vectors) {
    const ClusterTree& tree = state_->tree;
    const double squared = state_->frame.scale * state_->frame.scale;
    for (std::size_t i = 0; i < tree.order().size(); ++i) {
        const Vec3 scaled = vectors[tree.order()[i]] * squared;
        for (std::size_t k = 0; k < 3; ++k)
            state_->vectors.points[k][i] = static_cast<float>(scaled[static_cast<Eigen::Index>(k)]);
    }
    state_->vectors.add_up(tree);
}

void WindingField::winding(std::span<double> w, Workers* workers) {
    state_->at_positions(
        state_->vectors, workers,
        [&](std::uint32_t index, const WindingSources& sources, const WindingTarget& target) {
            w[index] = State::number(sum_winding(sources, target));
        });
}

void WindingField::gradient(std::span<Vec3> g, Workers* workers) {
    const double factor = state_->frame.scale;
    state_->at_positions(
        state_->vectors, workers,
        [&](std::uint32_t index, const WindingSources& sources, const WindingTarget& target) {
            g[index] = State::vector(sum_gradient(sources, target), factor);
        });
}

void WindingField::adjoint(std::span<const double> r, std::span<Vec3> g, Workers* workers) {
    const ClusterTree& tree = state_->tree;
    for (std::size_t i = 0; i < tree.order().size(); ++i)
        state_->scalars.points[0][i] = static_cast<float>(r[tree.order()[i]]);
    state_->scalars.add_up(tree);
    const double factor = state_->frame.scale * state_->frame.scale;
    state_->at_positions(
        state_->scalars, workers,
        [&](std::uint32_t index, const WindingSources& sources, const WindingTarget& target) {
            g[index] = State::vector(sum_adjoint(sources, target), factor);
        });
}

void WindingField::evaluate(std::span<const Vec3> points, std::span<const double> smoothing,
                            std::span<double> w, Workers* workers) const {
    state_->at_points(
        points, smoothing, workers,
        [&](std::uint32_t index, const WindingSources& sources, const WindingTarget& target) {
            w[index] = State::number(sum_winding(sources, target));
        });
}

void WindingField::evaluate_gradient(std::span<const Vec3> points,
                                     std::span<const double> smoothing, std::span<Vec3> g,
                                     Workers* workers) const {
    const double factor = state_->frame.scale;
    state_->at_points(
        points, smoothing, workers,
        [&](std::uint32_t index, const WindingSources& sources, const WindingTarget& target) {
            g[index] = State::vector(sum_gradient(sources, target), factor);
        });
}

WindingField winding_field(std::span<const SurfaceSample> samples, double smoothing) {
    std::vector<Vec3> positions, vectors;
    std::vector<double> weights, lengths;
    for (const SurfaceSample& sample : samples) {
        positions.push_back(sample.position);
        vectors.push_back(sample.area);
        weights.push_back(sample.width * sample.width);
        lengths.push_back(smoothing * sample.width);
    }
    WindingField field(positions, weights);
    field.set_smoothing(lengths);
    field.set_vectors(vectors);
    return field;
}

}  // namespace dsc::cloud
