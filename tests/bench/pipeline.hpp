#pragma once
// The real pipeline under a stopwatch: the kernel with the strategies of the built plugins, phase
// by phase.

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <dsc/cloud/target.hpp>
#include <dsc/hooks/improvement.hpp>
#include <dsc/host/host.hpp>
#include <dsc/kernel/deformer.hpp>
#include <dsc/run/experiment.hpp>
#include <dsc/run/simulation.hpp>
#include <dsc/surface/surface_view.hpp>

namespace dsc::bench {

/// The plugins that this build made.
class Plugins {
public:
    Plugins();
    const host::Host& host() const { return host_; }
    /// A file of configs/ with overrides. If DSC_DATA is not set, it is empty: override
    /// the cloud then.
    run::LoadedExperiment load(const std::string& file,
                               const std::vector<std::string>& overrides) const;

private:
    host::Host host_;
};

/// `{type: TYPE, key: value, ...}` from "key=value" words, the values written as in YAML.
config::StrategyConfig strategy(const std::string& type, std::span<const std::string> parameters);

/// The labelled complex that an initial mesh strategy makes.
mesh::Complex initial_complex(const Plugins& plugins, const config::StrategyConfig& initial_mesh,
                              const cloud::TargetCloud* cloud = nullptr);

/// CPU seconds by phase. A step of the Deformer is one piece of CPU time: move and improve share it
/// as its own wall times do.
struct Phases {
    double velocity = 0.0;  ///< the view of the interface and the velocity with its curvature
    double move = 0.0;
    double improve = 0.0;
    double refine = 0.0;
    double sum() const { return velocity + move + improve + refine; }
    Phases& operator+=(const Phases& other);
};

struct StepCost {
    Phases seconds;
    std::size_t interface_vertices = 0;  ///< that the step started with
    std::size_t tets = 0;                ///< that it ended with
    unsigned rounds = 0;
    std::size_t events = 0;
    std::uint64_t tried = 0;      ///< operations
    std::uint64_t committed = 0;  ///< operations
    double dropped_motion = 0.0;
};

/// A complex with the strategy that repairs it, moved by whoever calls.
class Body {
public:
    using Displacement = std::function<void(const hooks::StepContext&, std::span<Vec3>)>;

    Body(mesh::Complex complex, std::unique_ptr<hooks::Improvement> improvement,
         const cloud::TargetCloud* cloud = nullptr, Workers* workers = nullptr);

    /// One step; `displace` fills the displacements of the view's vertices.
    StepCost step(const Displacement& displace);
    /// A step in which nothing moves.
    StepCost idle();
    /// From here on the Deformer's part of each step lies inside measured().
    void count_deformer() { counting_ = true; }
    const surface::SurfaceView& view() const { return view_; }
    const kernel::Deformer& deformer() const { return deformer_; }
    hooks::StepContext context() const;
    /// Splits what the policy asks for; returns the CPU seconds.
    double refine(hooks::RefinementPolicy& policy, hooks::VelocityField* velocity);

private:
    void refresh();

    std::unique_ptr<hooks::Improvement> improvement_;
    const cloud::TargetCloud* cloud_;
    Workers* workers_;
    kernel::Deformer deformer_;
    kernel::RepairPolicy policy_;
    surface::SurfaceView view_;
    surface::ViewMemory view_memory_;
    std::vector<Vec3> displacements_;
    const hooks::StepContext* context_ = nullptr;  // of the step under way
    bool counting_ = false;
};

/// An experiment as `dsc run` runs it, without files and figures.
class Protocol {
public:
    Protocol(const Plugins& plugins, const run::LoadedExperiment& loaded);

    using OnStep = std::function<void(std::uint64_t step, const StepCost&)>;
    /// Runs the schedule up to and including step `last`; may be called again with a later one.
    /// Refinements count with the step after them, the first one's with the first.
    void run_to(std::uint64_t last, const OnStep& on_step = {});
    std::uint64_t steps() const { return steps_; }
    StepCost step();
    /// The first refinement of the schedule, once more.
    double refine_again();
    const Body& body() const { return *body_; }
    Body& body() { return *body_; }
    const cloud::TargetCloud& cloud() const { return *cloud_; }

private:
    double refine(hooks::RefinementPolicy& policy) {
        return body_->refine(policy, strategies_.velocity.get());
    }

    run::Experiment experiment_;
    std::optional<cloud::TargetCloud> cloud_;
    run::Strategies strategies_;
    std::unique_ptr<Body> body_;
    std::uint64_t steps_ = 0;  // of the schedule
    std::uint64_t done_ = 0;
    std::size_t item_ = 0;
    std::uint32_t in_item_ = 0;
};

/// The path of configs/thesis/NAME.yaml.
std::string thesis_file(const std::string& name);
/// That file: on $DSC_DATA/NAME.obj where `data` says so, else on 5000 points of the built-in
/// teapot. The thesis' 1,202 are evenly spread; as many random ones leave gaps in which holes open.
run::LoadedExperiment thesis(const Plugins& plugins, const std::string& name, bool data);

}  // namespace dsc::bench
