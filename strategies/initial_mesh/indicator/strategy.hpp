#pragma once
// Initial mesh `indicator`: inside and outside are determined from the cloud alone, before anything is deformed.

#include <dsc/hooks/initial_mesh.hpp>
#include <dsc/plugin/plugin.hpp>
#include <optional>

#include "labels.hpp"

namespace dsc::strategies {

/// A graded lattice whose vertices are labelled by the winding field of the oriented cloud [Barill2018; Lin2024], a filter that
/// admits only handles whose body and hole are certain, islands and cavities by policy, and an interface that has exactly the
/// labels' topology [LabelleShewchuk2007].
class Indicator final : public hooks::InitialMesh {
public:
    enum class Retry { automatic, never };
    struct Params : LabelOptions {
        cloud::Detail detail = cloud::Detail::medium;
        std::optional<std::uint64_t> vertices;  ///< of the interface; empty: the budget that follows from the number of points
        double start = 1.0;                     ///< interface vertices of the initial mesh, in budgets
        std::uint32_t smoothing = 3;
        Retry retry = Retry::automatic;
    };
    static void declare(config::ParamSchema<Params>& schema);

    Indicator(const Params& params, const plugin::Setup& setup);

    /// Throws ConfigError "indicator.no_cloud", "lattice.size", GeometryError "indicator.no_samples", "indicator.nothing_inside",
    /// CancelledError.
    mesh::TetMesh build(const hooks::InitialMeshContext& context) override;
    hooks::Figures figures() const override { return figures_; }
    hooks::Warnings warnings() const override { return warnings_; }
    hooks::Figures seconds() const override { return seconds_; }

private:
    std::size_t most_vertices(std::size_t points) const;

    Params params_;
    hooks::Figures figures_;
    hooks::Figures seconds_;
    hooks::Warnings warnings_;
};

}  // namespace dsc::strategies
