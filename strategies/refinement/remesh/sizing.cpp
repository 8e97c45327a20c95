#include "sizing.hpp"

#include <algorithm>
#include <cmath>

#include <dsc/surface/thickness.hpp>

namespace dsc::remesh {
namespace {

constexpr double faces_of_budget = 1.1547;  // 2 / sqrt 3: squared edge times vertices over area,
                                            // for regular triangles
constexpr double filled_part = 0.95;        // fraction of the budget that is used
constexpr double widest = 4.0;  // local spacings are limited to the median times this and the
                                // median over this
constexpr double slope = 0.3;   // growth of lengths along an edge
constexpr unsigned smoothing_rounds = 3;
constexpr std::size_t vertex_block = 512;
constexpr double edges_across = 2.0;     // least thickness over edge length, for a thin part
constexpr double shortest = 0.5;         // spacings: edges in thin parts are not shorter than this
constexpr double most_for_thin = 1.5;    // times the budget, because of thin parts
constexpr double opposite_cosine = 0.7;  // faces whose normals differ by more are not the two sides
                                         // of a thin part
constexpr unsigned median_rounds = 3;

double area_of(const surface::SurfaceView& view) {
    double area = 0.0;
    for (const double a : view.face_areas) area += a;
    return area;
}

}  // namespace

double noise_factor(const cloud::Statistics& statistics) {
    const double s =
        statistics.even() ? cloud::certain_noise(statistics.noise_ratio) : statistics.noise_ratio;
    return std::min(2.0, 1.0 + 1.5 * s);
}

double Sizing::budget(const Wish& wish, const cloud::TargetCloud* cloud) {
    if (wish.vertices > 0) return static_cast<double>(wish.vertices);
    return cloud != nullptr ? cloud::vertex_budget(cloud->size(), wish.detail) : 0.0;
}

// Number of vertices of regular triangles with these lengths on this surface.
double Sizing::count(const EdgeMesh& mesh) const {
    const surface::SurfaceView& view = *mesh.view;
    double sum = 0.0;
    for (std::size_t f = 0; f < view.face_count(); ++f) {
        for (const std::uint32_t v : view.faces[f])
            sum += view.face_areas[f] / 3.0 / (each_[v] * each_[v]);
    }
    return faces_of_budget * sum;
}

// Averages the logarithms over neighbours.
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

// Limits each length to that of a neighbour plus `slope` times the distance.
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
    // Alternates between forwards and backwards, so that a few rounds are enough.
    for (unsigned round = 0; round < 32; ++round) {
        bool changed = false;
        for (std::size_t i = 0; i < mesh.edges.size(); ++i) {
            const std::size_t e = round % 2 == 0 ? i : mesh.edges.size() - 1 - i;
            changed = limit(mesh.edges[e], mesh.lengths[e]) || changed;
        }
        if (!changed) break;
    }
}

void Sizing::follow_widths(const hooks::StepContext& context, const EdgeMesh& mesh, double vertices,
                           double scale) {
    const surface::SurfaceView& view = *mesh.view;
    const cloud::Statistics& statistics = context.cloud->statistics(context.workers);
    const double low = statistics.width / widest, high = statistics.width * widest;
    each_.resize(view.vertex_count());
    for_blocks(
        context.workers, each_.size(), vertex_block, [&](std::size_t begin, std::size_t end) {
            for (std::size_t v = begin; v < end; ++v) {
                each_[v] =
                    std::clamp(statistics.point_width[context.nearest_point(v).index], low, high);
            }
        });
    smooth(mesh);
    // The slope limit needs the scale of the lengths, which changes afterwards: two repetitions are
    // enough.
    for (int turn = 0; turn < 2; ++turn) {
        const double wanted = std::sqrt(count(mesh) / vertices);
        for (double& x : each_) x *= wanted;
        grade(mesh);
    }
    const double wanted = std::sqrt(count(mesh) / vertices);
    for (double& x : each_) x *= wanted * scale;
}

// Replaces each value by the median of the values of the vertex and its neighbours.
void Sizing::median_of_rings(const EdgeMesh& mesh, std::vector<double>& values) {
    for (unsigned round = 0; round < median_rounds; ++round) {
        next_ = values;
        for (std::uint32_t v = 0; v < values.size(); ++v) {
            ring_.assign(1, values[v]);
            for (const std::uint32_t f : mesh.view->faces_of(v)) {
                // The corner after v in each face: on a closed surface, this gives every neighbour
                // once.
                const auto& face = mesh.view->faces[f];
                for (std::size_t k = 0; k < 3; ++k) {
                    if (face[k] == v) ring_.push_back(values[face[(k + 1) % 3]]);
                }
            }
            const auto middle = ring_.begin() + static_cast<std::ptrdiff_t>(ring_.size() / 2);
            std::nth_element(ring_.begin(), middle, ring_.end());
            next_[v] = *middle;
        }
        values.swap(next_);
    }
}

// Reduces lengths to half of the thickness; less if this would need too many vertices. False if
// nothing is thin.
bool Sizing::shorten_thin_parts(const hooks::StepContext& context, const EdgeMesh& mesh) {
    const double longest = *std::max_element(each_.begin(), each_.end());
    surface::measure_thickness(*mesh.view, edges_across * longest, opposite_cosine, thickness_,
                               context.workers);
    median_of_rings(mesh, thickness_);
    const double least = shortest * context.cloud->statistics().width;
    usual_ = each_;
    const double usual_count = count(mesh);
    const auto shorten = [&](double relief) {
        bool thin = false;
        for (std::size_t v = 0; v < each_.size(); ++v) {
            const double wanted = std::max(relief * thickness_[v] / edges_across, least);
            each_[v] = std::min(usual_[v], wanted);
            thin = thin || wanted < usual_[v];
        }
        if (thin) grade(mesh);
        allowance_ = count(mesh) / usual_count;
        return thin;
    };
    if (!shorten(1.0)) return false;
    if (allowance_ <= most_for_thin) return true;
    double low = 1.0, high = longest / least;
    for (int i = 0; i < 12; ++i) {
        const double relief = 0.5 * (low + high);
        shorten(relief);
        (allowance_ <= most_for_thin ? high : low) = relief;
    }
    return shorten(high);
}

void Sizing::even_lengths(const hooks::StepContext& context, const EdgeMesh& mesh, double vertices,
                          double scale) {
    each_.assign(mesh.view->vertex_count(),
                 scale * std::sqrt(faces_of_budget * context.cloud->statistics().area / vertices));
}

Lengths Sizing::lengths(const hooks::StepContext& context, const EdgeMesh& mesh, const Wish& wish,
                        double factor) {
    allowance_ = 1.0;
    if (wish.edge_length > 0.0) return {wish.edge_length};
    const double vertices = filled_part * budget(wish, context.cloud);
    if (!(vertices > 0.0)) return {context.target_length};
    if (context.cloud == nullptr)
        return {factor * std::sqrt(faces_of_budget * area_of(*mesh.view) / vertices)};
    const cloud::Statistics& statistics = context.cloud->statistics(context.workers);
    const double scale = factor * noise_factor(statistics);
    const bool even = statistics.even();
    even ? even_lengths(context, mesh, vertices, scale)
         : follow_widths(context, mesh, vertices, scale);
    const bool thin = wish.thin_parts && !each_.empty() && shorten_thin_parts(context, mesh);
    if (even && !thin && !each_.empty()) return {each_.front()};
    return {0.0, each_};
}

}  // namespace dsc::remesh
