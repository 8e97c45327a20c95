#pragma once
// Refinement `remesh`: keeps the edges of the interface at their target length, its triangles nearly equilateral, and its
// creases.

#include <dsc/hooks/refinement_policy.hpp>
#include <dsc/plugin/plugin.hpp>

#include "edge_mesh.hpp"
#include "edits.hpp"
#include "sizing.hpp"

namespace dsc::strategies {

/// Sweeps of splits, collapses, flips and tangential steps [Botsch2004], spread over the passes of a refinement. Many sweeps in the
/// first refinement, two in early ones, only flips in the last third of the run.
class Remesh final : public hooks::RefinementPolicy {
public:
    struct Params {
        cloud::Detail detail = cloud::Detail::medium;
        std::uint64_t vertices = 0;
        double edge_length = 0.0;
        bool thin_parts = true;
    };
    static void declare(config::ParamSchema<Params>& schema);

    Remesh(const Params& params, const plugin::Setup& setup);

    bool owns_sizing() const override { return true; }
    unsigned passes() const override { return hooks::refinement_passes; }
    std::optional<repair::CreaseRule> keep_creases() const override;
    void refine(const hooks::RefinementContext& context, hooks::RefinementRequests& out) override;
    void save(std::ostream& out) const override;
    void load(std::istream& in) override;

private:
    /// The kind of requests of a pass; each pass also requests flips.
    enum class Stage : std::uint8_t { sizes, collapses, moves, flips };

    void begin(const hooks::StepContext& step);
    void plan(const hooks::StepContext& step);
    remesh::Lengths set_lengths(const hooks::StepContext& step, hooks::RefinementRequests& out);
    bool ask(Stage stage, const remesh::Lengths& lengths, hooks::RefinementRequests& out);
    bool keeps() const;

    Params params_;
    // Saved.
    std::uint64_t refinements_ = 0;  // number of refinements begun
    std::uint64_t step_ = 0;         // step of the last refinement
    std::uint64_t last_step_ = 0;    // last step of the run
    std::uint64_t too_many_ = 0;     // number of refinements after which there were more vertices than allowed
    double allowed_ = 0.0;           // allowed vertices after the last refinement; 0: no limit

    // State of the current refinement.
    std::vector<Stage> stages_;
    std::size_t next_stage_ = 0;
    double flatness_ = 0.0;

    // Kept between calls to reuse their memory.
    remesh::EdgeMesh mesh_;
    remesh::Edits edits_;
    remesh::Sizing sizing_;
};

}  // namespace dsc::strategies
