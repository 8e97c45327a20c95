// Names the figures of an evaluation.
#include "dsc/surface/truth_figures.hpp"

namespace dsc::surface {

std::vector<std::pair<std::string, double>> truth_figures(const Evaluation& evaluation) {
    return {{"diagonal", evaluation.diagonal},
            {"accuracy_percent", 100.0 * evaluation.accuracy},
            {"completeness_percent", 100.0 * evaluation.completeness},
            {"chamfer_percent", 100.0 * evaluation.chamfer},
            {"hausdorff_percent", 100.0 * evaluation.hausdorff},
            {"hausdorff99_percent", 100.0 * evaluation.hausdorff99},
            {"f_score_0.5_percent", evaluation.f_score_05},
            {"f_score_1_percent", evaluation.f_score_1},
            {"normal_consistency", evaluation.normal_consistency}};
}

}  // namespace dsc::surface
