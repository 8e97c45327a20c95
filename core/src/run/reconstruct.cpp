#include <algorithm>
#include <cmath>
#include <dsc/cloud/filter.hpp>
#include <dsc/cloud/normalize.hpp>
#include <dsc/cloud/search.hpp>
#include <dsc/run/reconstruct.hpp>

namespace dsc::run {
namespace {

using config::ConfigNode;

/// Half-extent of the normalised cloud, in the box of half-width 1.5.
constexpr double scale = 0.9;
/// Mean edge of the interface of a grid, in cell widths, once it has settled on a cloud.
constexpr double edges_per_cell = 1.24;
/// By which a split of all faces above the average area shortens the mean edge.
constexpr double split_ratio = 0.82;
/// Edges shorter than this many point spacings add nothing: there is no point for most of the vertices.
constexpr double least_edge = 0.75;
/// Clouds with fewer points keep all of them: too few to tell an outlier.
constexpr std::size_t filtered_from = 100;

/// What a level of detail means for the thesis' pipeline.
struct Plan {
    int cells;             ///< of the start grid along the box
    int most_refinements;  ///< each gives about 1.5 times as many vertices
    int first_steps;       ///< until the cube has shrunk onto the cloud
    int further_steps;     ///< after each refinement
};

Plan plan_of(Detail detail) {
    switch (detail) {
        case Detail::low: return {24, 2, 40, 25};
        case Detail::medium: return {30, 4, 40, 25};
        case Detail::high: return {40, 5, 50, 25};
    }
    return {30, 4, 40, 25};
}

/// Typical distance of neighbouring points, sqrt(area / points), in normalised units. In a patch of uniform density the
/// mean distance to the fourth neighbour is 1.03 (a regular grid: 1) to 1.09 (random points) of it.
double spacing(const cloud::Cloud& cloud) {
    const cloud::NearestSearch search(cloud.points);
    const std::size_t count = cloud.points.size(), probes = std::min<std::size_t>(count, 2000);
    std::vector<double> distances;
    std::vector<cloud::Neighbour> neighbours;
    for (std::size_t i = 0; i < probes; ++i) {
        search.k_nearest(cloud.points[i * count / probes], 5, neighbours);
        distances.push_back(neighbours.back().distance);
    }
    std::nth_element(distances.begin(), distances.begin() + static_cast<std::ptrdiff_t>(probes / 2), distances.end());
    const double half_extent = 0.5 * bounding_box(cloud.points).size().maxCoeff();
    return distances[probes / 2] / 1.06 * scale / half_extent;
}

/// As many as the level allows, as long as the edges stay longer than the points' spacing.
int refinements(const Plan& plan, double point_spacing) {
    double edge = edges_per_cell * 3.0 / plan.cells;
    int count = 0;
    while (count < plan.most_refinements && split_ratio * edge >= least_edge * point_spacing) {
        edge *= split_ratio;
        ++count;
    }
    return std::max(count, 1);
}

ConfigNode filters(std::size_t points) {
    std::vector<ConfigNode> list = {ConfigNode::map({{"type", "duplicates"}})};
    // The second pass sees the spread without the far outliers, which hide the near ones from the first.
    for (int pass = 0; points >= filtered_from && pass < 2; ++pass) {
        list.push_back(ConfigNode::map({{"type", "statistical_outliers"}, {"neighbours", 16}, {"deviations", 4.0}}));
    }
    return ConfigNode::list(std::move(list));
}

}  // namespace

std::optional<Detail> detail_from_name(std::string_view name) {
    if (name == "low") return Detail::low;
    if (name == "medium") return Detail::medium;
    if (name == "high") return Detail::high;
    return std::nullopt;
}

ConfigNode derive_experiment(const std::string& file, const cloud::Cloud& cloud, Detail detail) {
    cloud::require_volume(cloud.points, cloud.source.empty() ? file : cloud.source);
    const cloud::Cloud distinct = cloud::remove_duplicates(cloud).cloud;
    const Plan plan = plan_of(detail);
    std::vector<ConfigNode> schedule = {ConfigNode::map({{"steps", plan.first_steps}})};
    for (int i = refinements(plan, spacing(distinct)); i > 0; --i) {
        schedule.push_back(ConfigNode::map({{"refine", ConfigNode::map({{"type", "average_area"}})}}));
        schedule.push_back(ConfigNode::map({{"steps", plan.further_steps}}));
    }
    return ConfigNode::map(
        {{"dsc", 1},
         {"name", "reconstruct"},
         {"input", ConfigNode::map({{"cloud", ConfigNode::map({{"file", file}, {"filters", filters(distinct.points.size())}})},
                                    {"normalize", ConfigNode::map({{"scale", scale}})}})},
         {"initial_mesh", ConfigNode::map({{"type", "grid"}, {"cells", plan.cells}})},
         {"velocity", ConfigNode::map({{"type", "point_cloud"}})},
         {"improvement", ConfigNode::map({{"type", "dsc"}})},
         {"schedule", ConfigNode::list(std::move(schedule))}});
}

}  // namespace dsc::run
