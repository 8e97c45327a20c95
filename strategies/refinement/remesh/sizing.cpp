#include "sizing.hpp"

#include <algorithm>
#include <cmath>

namespace dsc::remesh {
namespace {

constexpr double faces_of_budget = 1.1547;  // 2 / sqrt 3: squared edge times vertices of regular triangles, by area
constexpr double filled_part = 0.95;        // of the budget
constexpr double even_spread = 3.0;         // quantiles of the point width further apart make local lengths
constexpr double widest = 4.0;              // local point widths beyond so many medians, or below their inverse, are cut off
constexpr double slope = 0.3;               // by which lengths may grow along an edge
constexpr unsigned smoothing_rounds = 3;
constexpr std::size_t vertex_block = 512;

double area_of(const surface::SurfaceView& view) {
    double area = 0.0;
    for (const double a : view.face_areas) area += a;
    return area;
}

}  // namespace

double noise_factor(const cloud::Statistics& statistics) {
    double s = statistics.noise_ratio;
    if (s < 0.3 && statistics.spread < even_spread) s = 0.3 * std::max(0.0, s - 0.12) / 0.18;
    return std::min(2.0, 1.0 + 1.5 * s);
}

double Sizing::budget(const Wish& wish, const cloud::TargetCloud* cloud) {
    if (wish.vertices > 0) return static_cast<double>(wish.vertices);
    return cloud != nullptr ? cloud::vertex_budget(cloud->size()) : 0.0;
}

// Vertices that regular triangles of these lengths have on this surface.
double Sizing::count(const EdgeMesh& mesh) const {
    const surface::SurfaceView& view = *mesh.view;
    double sum = 0.0;
    for (std::size_t f = 0; f < view.face_count(); ++f) {
        for (const std::uint32_t v : view.faces[f]) sum += view.face_areas[f] / 3.0 / (each_[v] * each_[v]);
    }
    return faces_of_budget * sum;
}

// The mean over neighbours, in the logarithm.
void Sizing::smooth(const EdgeMesh& mesh) {
    for (double& x : each_) x = std::log(x);
    for (unsigned round = 0; round < smoothing_rounds; ++round) {
        next_ = each_;
        weights_.assign(each_.size(), 1.0);
        for (const surface::ViewEdge& edge : mesh.edges) {
            const auto& [a, b] = edge.vertices;
            next_[a] += each_[b];
            next_[b] += each_[a];
            weights_[a] += 1.0;
            weights_[b] += 1.0;
        }
        for (std::size_t v = 0; v < each_.size(); ++v) each_[v] = next_[v] / weights_[v];
    }
    for (double& x : each_) x = std::exp(x);
}

// No length exceeds a neighbour's by more than `slope` times the distance.
void Sizing::grade(const EdgeMesh& mesh) {
    const auto limit = [&](const surface::ViewEdge& edge, double length) {
        const auto& [a, b] = edge.vertices;
        const double step = slope * length;
        bool changed = false;
        for (const auto& [low, high] : {std::pair{a, b}, std::pair{b, a}}) {
            if (each_[high] <= each_[low] + step) continue;
            each_[high] = each_[low] + step;
            changed = true;
        }
        return changed;
    };
    // Forwards and backwards in turn: few rounds reach far.
    for (unsigned round = 0; round < 32; ++round) {
        bool changed = false;
        for (std::size_t i = 0; i < mesh.edges.size(); ++i) {
            const std::size_t e = round % 2 == 0 ? i : mesh.edges.size() - 1 - i;
            changed = limit(mesh.edges[e], mesh.lengths[e]) || changed;
        }
        if (!changed) break;
    }
}

void Sizing::follow_widths(const hooks::StepContext& context, const EdgeMesh& mesh, double vertices, double scale) {
    const surface::SurfaceView& view = *mesh.view;
    const cloud::Statistics& statistics = context.cloud->statistics(context.workers);
    const double low = statistics.width / widest, high = statistics.width * widest;
    each_.resize(view.vertex_count());
    for_blocks(context.workers, each_.size(), vertex_block, [&](std::size_t begin, std::size_t end) {
        for (std::size_t v = begin; v < end; ++v) {
            const std::uint32_t point = context.cloud->search().nearest(view.positions[v]).index;
            each_[v] = std::clamp(statistics.point_width[point], low, high);
        }
    });
    smooth(mesh);
    // The slope is judged on the lengths, which are known up to their scale after it: twice is enough.
    for (int turn = 0; turn < 2; ++turn) {
        const double wanted = std::sqrt(count(mesh) / vertices);
        for (double& x : each_) x *= wanted;
        grade(mesh);
    }
    const double wanted = std::sqrt(count(mesh) / vertices);
    for (double& x : each_) x *= wanted * scale;
}

Lengths Sizing::lengths(const hooks::StepContext& context, const EdgeMesh& mesh, const Wish& wish, double factor) {
    if (wish.edge_length > 0.0) return {wish.edge_length};
    const double vertices = filled_part * budget(wish, context.cloud);
    if (!(vertices > 0.0)) return {context.target_length};
    if (context.cloud == nullptr) return {factor * std::sqrt(faces_of_budget * area_of(*mesh.view) / vertices)};
    const cloud::Statistics& statistics = context.cloud->statistics(context.workers);
    const double scale = factor * noise_factor(statistics);
    if (statistics.spread >= even_spread) {
        follow_widths(context, mesh, vertices, scale);
        return {0.0, each_};
    }
    return {scale * std::sqrt(faces_of_budget * statistics.area / vertices)};
}

}  // namespace dsc::remesh
