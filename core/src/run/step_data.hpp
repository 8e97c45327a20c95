#pragma once
// What the strategies of a run can read: the view of the interface with its history, the nearest
// points, the numbers per vertex, and the contexts made of them.

#include <cstdint>
#include <vector>

#include <dsc/hooks/context.hpp>
#include <dsc/kernel/deformer.hpp>
#include <dsc/mesh/volume_view.hpp>
#include <dsc/surface/surface_view.hpp>

#include "nearest_points.hpp"
#include "vertex_history.hpp"

namespace dsc::run {

/// What a strategy asks for in addition to the data that every context contains.
struct Needs {
    bool faces_of_points = false;
    bool support = false;
    bool volume = false;
};

/// The parts of a context that stay the same during a run.
struct ContextBase {
    std::uint64_t seed = 0;
    const cloud::TargetCloud* cloud = nullptr;
};

/// Belongs to one deformer, which must outlive it, as must the workers.
class StepData {
public:
    StepData(const kernel::Deformer& deformer, const ContextBase& base, Workers& workers);

    /// Reads the complex again; call it after every change of it. [step]
    void refresh();
    /// Reads only the numbers per vertex again. [step]
    void refresh_fields();

    const surface::SurfaceView& view() const { return view_; }
    std::span<const cloud::Neighbour> nearest() const { return nearest_.all(); }
    VertexHistory& history() { return history_; }

    /// The context of a call, without a token: it never says that the run shall stop. Data that is
    /// only made on request is made once per view. [step]
    hooks::StepContext context(std::uint64_t step, std::uint64_t planned_steps,
                               const Needs& needs = {});

private:
    void add(const Needs& needs, hooks::StepContext& context);

    const kernel::Deformer& deformer_;
    ContextBase base_;
    Workers& workers_;
    surface::SurfaceView view_;
    surface::ViewMemory view_memory_;
    VertexHistory history_;
    NearestPoints nearest_;
    mesh::VolumeView volume_;
    std::vector<double> lengths_;   // per vertex of the view; empty if L is the same everywhere
    hooks::Attributes attributes_;  // of the view's vertices
    std::vector<surface::FacePoint> faces_of_points_;  // empty until they are needed
    std::vector<double> support_;                      // empty until it is needed
};

}  // namespace dsc::run
