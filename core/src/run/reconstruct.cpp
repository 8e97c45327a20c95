#include <dsc/cloud/normalize.hpp>
#include <dsc/run/reconstruct.hpp>

namespace dsc::run {
namespace {

using config::ConfigNode;

/// What a level of detail means for the thesis' pipeline.
struct Plan {
    int cells;          ///< of the start grid along the box
    int refinements;    ///< each splits the faces above the average area: about 1.6 times as many vertices
    int first_steps;    ///< until the cube has shrunk onto the cloud
    int further_steps;  ///< after each refinement
};

Plan plan_of(Detail detail) {
    switch (detail) {
        case Detail::low: return {24, 1, 40, 30};
        case Detail::medium: return {30, 3, 40, 30};
        case Detail::high: return {40, 4, 50, 30};
    }
    return {30, 3, 40, 30};
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
    const Plan plan = plan_of(detail);
    std::vector<ConfigNode> schedule = {ConfigNode::map({{"steps", plan.first_steps}})};
    for (int i = 0; i < plan.refinements; ++i) {
        schedule.push_back(ConfigNode::map({{"refine", ConfigNode::map({{"type", "average_area"}})}}));
        schedule.push_back(ConfigNode::map({{"steps", plan.further_steps}}));
    }
    const ConfigNode filters = ConfigNode::list({ConfigNode::map({{"type", "duplicates"}})});
    return ConfigNode::map(
        {{"dsc", 1},
         {"name", "reconstruct"},
         {"input", ConfigNode::map({{"cloud", ConfigNode::map({{"file", file}, {"filters", filters}})},
                                    {"normalize", ConfigNode::map({{"scale", 0.9}})}})},
         {"initial_mesh", ConfigNode::map({{"type", "grid"}, {"cells", plan.cells}})},
         {"velocity", ConfigNode::map({{"type", "point_cloud"}})},
         {"improvement", ConfigNode::map({{"type", "dsc"}})},
         {"schedule", ConfigNode::list(std::move(schedule))}});
}

}  // namespace dsc::run
