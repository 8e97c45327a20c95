#pragma once
// Hook `observer`: reads the state after each step, adds figures to metrics.csv and summary.json,
// changes nothing.

#include <dsc/hooks/context.hpp>
#include <dsc/hooks/figures.hpp>

namespace dsc::hooks {

/// Figures of the last completed step, which an observer gets with it. They are values that an
/// observer may keep.
struct StepFigures {
    /// Number of the step, from 1. [1; -]
    std::uint64_t step = 0;
    /// Number of vertices of the interface. [1; -]
    std::size_t interface_vertices = 0;
    /// Number of tets, inside and outside. [1; -]
    std::size_t tets = 0;
    /// Volume of all labels above 0. [1; n^3]
    double volume = 0.0;
    /// Least quality of a tet. [1; -]
    double min_tet_quality = 0.0;
};

/// Reads and measures; it cannot change the run.
class Observer : public Strategy {
public:
    ~Observer() override;
    /// Whether the calls need StepContext::faces_of_points.
    virtual bool needs_faces_of_points() const { return false; }
    /// Whether the calls need StepContext::support.
    virtual bool needs_support() const { return false; }
    /// Called with the state before the first step. [step]
    virtual void begin(const StepContext& context) = 0;
    /// Called after each step. Returns figures for the step's row of metrics.csv. [step]
    virtual Figures step(const StepContext& context, const StepFigures& figures) = 0;
    /// Called after the last step. Returns figures for summary.json. [step]
    virtual Figures end(const StepContext& context) = 0;
};

}  // namespace dsc::hooks
