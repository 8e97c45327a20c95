// Initial mesh `indicator`: inside and outside are determined from the cloud alone, before anything
// is deformed.
//
// A graded lattice whose vertices are labelled by the winding field of the oriented cloud
// [Barill2018; Lin2024], a filter that admits only handles whose body and hole are certain, islands
// and cavities by policy, and an interface that has exactly the labels' topology
// [LabelleShewchuk2007].
#include <algorithm>
#include <array>
#include <cmath>
#include <ctime>
#include <optional>

#include <dsc/base/version.hpp>
#include <dsc/cloud/orientation.hpp>
#include <dsc/cloud/statistics.hpp>
#include <dsc/generate/isosurface.hpp>
#include <dsc/hooks/initial_mesh.hpp>
#include <dsc/plugin/plugin.hpp>

#include "confidence.hpp"
#include "labels.hpp"

namespace {

namespace indicator = dsc::indicator;

/// If the labels are doubtful, the cloud is oriented again: all points take part in the first
/// stage, with more iterations; the last attempt also has more iterations in the second stage.
const std::array<dsc::cloud::OrientOptions, 2> retries = {
    {{.all_points = true, .coarse_iterations = 60, .fine_iterations = 12},
     {.all_points = true, .coarse_iterations = 60, .fine_iterations = 40}}};

/// CPU seconds of this process since the last call.
class Lap {
public:
    double operator()() {
        const std::clock_t now = std::clock();
        const double seconds = static_cast<double>(now - last_) / CLOCKS_PER_SEC;
        last_ = now;
        return seconds;
    }

private:
    std::clock_t last_ = std::clock();
};

const dsc::cloud::TargetCloud& cloud_of(const dsc::hooks::InitialMeshContext& context) {
    if (context.cloud == nullptr) {
        throw dsc::ConfigError("indicator.no_cloud", indicator::generator_name,
                               "the experiment has no cloud", "add input: {cloud: {file: ...}}");
    }
    return *context.cloud;
}

class Indicator final : public dsc::hooks::InitialMesh {
public:
    enum class Retry { automatic, never };
    /// The parameters that an experiment may set; the values here are the defaults.
    struct Params : indicator::LabelOptions {
        dsc::cloud::Detail detail = dsc::cloud::Detail::medium;
        std::optional<std::uint64_t> vertices;  ///< of the interface; empty: the budget that
                                                ///< follows from the number of points
        double start = 1.0;  ///< interface vertices of the initial mesh, in budgets
        std::uint32_t smoothing = 3;
        Retry retry = Retry::automatic;
    };
    static void declare(dsc::config::ParamSchema<Params>& schema) {
        schema
            .choice("detail", &Params::detail,
                    {{"low", dsc::cloud::Detail::low},
                     {"medium", dsc::cloud::Detail::medium},
                     {"high", dsc::cloud::Detail::high}})
            .doc("Level of detail: half, all or twice the budget of vertices that follows from the "
                 "number of points. The budget is 2 per point up to 3,000 points, 1 per point at "
                 "20,000 points, with linear interpolation between; above that it grows with the "
                 "root of the number of points.");
        schema.integer("vertices", &Params::vertices)
            .range(100, 10000000, "vertices")
            .doc("Budget of interface vertices; replaces the budget from the number of points and "
                 "`detail`.");
        schema.real("start", &Params::start)
            .range(0.1, 2, "budgets")
            .doc("Largest number of vertices of the initial interface, as a fraction of the "
                 "budget.");
        schema.real("cell", static_cast<double Params::*>(&indicator::LabelOptions::cell))
            .range(0.3, 4, "spacings")
            .doc("Edge length of the lattice cells at the points, up to a factor of 1.2. Cells "
                 "twice as large lose thin parts and gaps.");
        schema.real("certain", static_cast<double Params::*>(&indicator::LabelOptions::certain))
            .range(0, 0.5, "dimensionless")
            .open_low()
            .open_high()
            .doc("Difference of the winding number from 1/2 from which a label is certain. A "
                 "handle is kept only if its body and its hole are certain everywhere along it, or "
                 "if the samples round it confirm it.");
        schema
            .boolean("remove_islands",
                     static_cast<bool Params::*>(&indicator::LabelOptions::remove_islands))
            .doc("Whether bodies smaller than `least_volume` are removed; the largest body is "
                 "always kept.");
        schema
            .choice("cavities",
                    static_cast<dsc::generate::CavityPolicy Params::*>(
                        &indicator::LabelOptions::cavities),
                    {{"auto", dsc::generate::CavityPolicy::automatic},
                     {"keep", dsc::generate::CavityPolicy::keep},
                     {"fill", dsc::generate::CavityPolicy::fill}})
            .doc("Enclosed cavities: 'auto' keeps those that are certainly empty and have at least "
                 "12 points on their wall, 'keep' keeps all above `least_volume`, 'fill' fills "
                 "all.");
        schema
            .real("least_volume",
                  static_cast<double Params::*>(&indicator::LabelOptions::least_volume))
            .at_least(0, "spacings^3")
            .doc("Volume below which islands are removed and cavities are filled.");
        schema.integer("smoothing", &Params::smoothing)
            .range(0, 100, "sweeps")
            .doc("Number of sweeps that smooth the interface at the end.");
        schema
            .choice("retry", &Params::retry, {{"auto", Retry::automatic}, {"never", Retry::never}})
            .doc("Further attempts if the labels are doubtful: 'auto' orients the cloud up to two "
                 "more times, with all points in the first stage and more iterations. This takes "
                 "longer. It keeps the labels that the filters changed least.");
    }

    Indicator(const Params& params, const dsc::plugin::Setup&) : params_(params) {}

    /// Throws ConfigError "indicator.no_cloud", "lattice.size", GeometryError
    /// "indicator.no_samples", "indicator.nothing_inside", CancelledError.
    dsc::mesh::TetMesh build(const dsc::hooks::InitialMeshContext& context) override {
        const dsc::cloud::TargetCloud& cloud = cloud_of(context);
        figures_.clear();
        seconds_.clear();
        warnings_.clear();
        Lap lap;
        const double half_box = dsc::cloud::simulation_box().high.x();
        dsc::cloud::Orientation orientation = cloud.orientation();
        if (orientation.empty())
            orientation =
                dsc::cloud::orient_points(cloud.points(), {}, context.workers, context.cancel)
                    .orientation;
        indicator::Labels labels = indicator::label_lattice(orientation, params_, half_box,
                                                            context.workers, context.cancel);
        unsigned attempts = 1, taken = 1;
        for (dsc::cloud::OrientOptions finer : retries) {
            if (params_.retry == Retry::never || !indicator::doubtful(labels, orientation)) break;
            finer.backing = orientation.backing;
            dsc::cloud::Orientation again =
                dsc::cloud::orient_points(cloud.points(), finer, context.workers, context.cancel)
                    .orientation;
            indicator::Labels other =
                indicator::label_lattice(again, params_, half_box, context.workers, context.cancel);
            ++attempts;
            if (other.weak_share() > labels.weak_share()) continue;
            taken = attempts;
            labels = std::move(other);
            orientation = std::move(again);
        }
        seconds_.emplace_back("labels", lap());

        dsc::generate::StuffOptions options;
        options.most_interface_vertices = most_vertices(cloud.size());
        options.smoothing_sweeps = params_.smoothing;
        dsc::generate::StuffReport report;
        dsc::mesh::TetMesh mesh = dsc::generate::stuff_interface(
            labels.lattice, labels.values, options, &report, context.workers, context.cancel,
            indicator::generator_name);
        seconds_.emplace_back("cut", lap());

        const indicator::StartSurface start =
            indicator::measure_start(mesh, orientation, cloud.statistics(context.workers).area);
        warnings_ = indicator::warnings_of(labels, orientation, start);
        indicator::add_figures(labels, orientation, start, figures_);
        figures_.emplace_back("attempts", attempts);
        figures_.emplace_back("attempt_taken", taken);
        figures_.emplace_back("interface_vertices", static_cast<double>(report.interface_vertices));
        figures_.emplace_back("tets", static_cast<double>(mesh.tets.size()));
        figures_.emplace_back("least_quality", report.least_quality);
        seconds_.emplace_back("confidence", lap());
        return mesh;
    }

    dsc::hooks::Figures figures() const override { return figures_; }
    dsc::hooks::Warnings warnings() const override { return warnings_; }
    dsc::hooks::Figures seconds() const override { return seconds_; }

private:
    std::size_t most_vertices(std::size_t points) const {
        const double budget = params_.vertices ? static_cast<double>(*params_.vertices)
                                               : dsc::cloud::vertex_budget(points, params_.detail);
        return static_cast<std::size_t>(std::floor(std::max(4.0, params_.start * budget)));
    }

    Params params_;
    dsc::hooks::Figures figures_;
    dsc::hooks::Figures seconds_;
    dsc::hooks::Warnings warnings_;
};

}  // namespace

DSC_PLUGIN("indicator", DSC_VERSION, "BSD-3-Clause",
           "Start with inside and outside determined from the cloud alone") {
    registrar.add<Indicator>("indicator", "a graded lattice labelled by the winding field of the "
                                          "oriented cloud, with a controlled topology");
}
