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
/// The start mesh of a sparse cloud has edges of this many point spacings, but no fewer cells than these.
constexpr double coarse_edge = 0.5;
constexpr double least_cells = 16;
/// Point spacings within which no sheet is pierced.
constexpr double support_spacings = 0.8;
/// Point spacings from the nearest point beyond which the surface is carved inwards.
constexpr double carved_beyond = 4.0;
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
        case Detail::low:
            return {24, 2, 40, 25};
        case Detail::medium:
            return {30, 4, 40, 25};
        case Detail::high:
            return {40, 5, 50, 25};
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
    std::nth_element(distances.begin(), distances.begin() + static_cast<std::ptrdiff_t>(probes / 2),
                     distances.end());
    const double half_extent = 0.5 * bounding_box(cloud.points).size().maxCoeff();
    return distances[probes / 2] / 1.06 * scale / half_extent;
}

/// The plan fitted to a cloud.
struct Fitted {
    int cells;
    int refinements;
    double support;  ///< of topology changes, in mean edges
};

/// A start mesh no finer than a sparse cloud deserves, as many refinements as the level allows and the points carry. No
/// sheet is pierced nearer to a point than the points' spacing: between the points of a sparse cloud there is surface.
Fitted fit(const Plan& plan, double point_spacing) {
    Fitted fitted{};
    const double finest = edges_per_cell * 3.0 / (coarse_edge * point_spacing);
    fitted.cells = static_cast<int>(std::clamp<double>(std::round(finest), least_cells, plan.cells));
    double edge = edges_per_cell * 3.0 / fitted.cells;
    while (fitted.refinements < plan.most_refinements && split_ratio * edge >= least_edge * point_spacing) {
        edge *= split_ratio;
        ++fitted.refinements;
    }
    fitted.support = std::clamp(support_spacings * point_spacing / edge, 0.5, 10.0);
    return fitted;
}

ConfigNode filters(std::size_t points) {
    std::vector<ConfigNode> list = {ConfigNode::map({{"type", "duplicates"}})};
    // The second pass sees the spread without the far outliers, which hide the near ones from the first.
    for (int pass = 0; points >= filtered_from && pass < 2; ++pass) {
        list.push_back(
            ConfigNode::map({{"type", "statistical_outliers"}, {"neighbours", 16}, {"deviations", 4.0}}));
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
    const Fitted fitted = fit(plan, spacing(distinct));
    std::vector<ConfigNode> schedule = {ConfigNode::map({{"steps", plan.first_steps}})};
    for (int i = 0; i < fitted.refinements; ++i) {
        schedule.push_back(ConfigNode::map({{"refine", ConfigNode::map({{"type", "average_area"}})}}));
        schedule.push_back(ConfigNode::map({{"steps", plan.further_steps}}));
    }
    return ConfigNode::map(
        {{"dsc", 1},
         {"name", "reconstruct"},
         {"input",
          ConfigNode::map(
              {{"cloud", ConfigNode::map({{"file", file}, {"filters", filters(distinct.points.size())}})},
               {"normalize", ConfigNode::map({{"scale", scale}})}})},
         {"initial_mesh", ConfigNode::map({{"type", "grid"}, {"cells", fitted.cells}})},
         {"velocity", ConfigNode::map({{"type", "point_cloud"},
                          {"unsupported", ConfigNode::map({{"beyond", carved_beyond}})}})},
         {"improvement",
          ConfigNode::map({{"type", "dsc"}, {"topology", ConfigNode::map({{"support", fitted.support}})}})},
         {"schedule", ConfigNode::list(std::move(schedule))}});
}

}  // namespace dsc::run
