#include "local_widths.hpp"

namespace dsc::strategies::fit {
namespace {

constexpr std::size_t width_block = 1024;  // vertices
constexpr unsigned width_rounds = 3;       // rounds of averages over rings

/// Points that coincide with others have no width: then the median of the cloud is used, or a
/// target length if there is none.
double width_at(const hooks::StepContext& context, const cloud::Statistics& statistics,
                std::uint32_t point) {
    if (statistics.point_width[point] > 0.0) return statistics.point_width[point];
    if (statistics.width > 0.0) return statistics.width;
    return context.target_length > 0.0 ? context.target_length : 1.0;
}

}  // namespace

void measure_gaps(const hooks::StepContext& context, std::vector<double>& gaps) {
    const cloud::Statistics& statistics = context.cloud->statistics(context.workers);
    gaps.resize(context.surface.vertex_count());
    for_blocks(context.workers, gaps.size(), width_block, [&](std::size_t begin, std::size_t end) {
        for (std::size_t v = begin; v < end; ++v) {
            const cloud::Neighbour near = context.nearest_point(v);
            gaps[v] = near.distance / width_at(context, statistics, near.index);
        }
    });
}

void measure_widths(const hooks::StepContext& context, const SurfaceLinks& links,
                    const Scales& scales, std::vector<double>& widths) {
    widths.assign(context.surface.vertex_count(), scales.width);
    if (scales.even) return;
    const cloud::Statistics& statistics = context.cloud->statistics(context.workers);
    for_blocks(context.workers, widths.size(), width_block,
               [&](std::size_t begin, std::size_t end) {
                   for (std::size_t v = begin; v < end; ++v)
                       widths[v] = width_at(context, statistics, context.nearest_point(v).index);
               });
    std::vector<double> before;
    for (unsigned round = 0; round < width_rounds; ++round) {
        before = widths;
        for_blocks(context.workers, widths.size(), width_block,
                   [&](std::size_t begin, std::size_t end) {
                       for (std::size_t v = begin; v < end; ++v) {
                           double sum = before[v];
                           for (const std::uint32_t w : links.neighbours_of(v)) sum += before[w];
                           widths[v] = sum / static_cast<double>(1 + links.neighbours_of(v).size());
                       }
                   });
    }
}

}  // namespace dsc::strategies::fit
