#pragma once
// What the vertices of a view have done before: where each was at the start of the last step,
// whether it arrived, and how old it is.

#include <cstdint>
#include <span>
#include <vector>

#include <dsc/base/state.hpp>
#include <dsc/surface/surface_view.hpp>

namespace dsc::run {

/// Belongs to one run. Vertices are known by their birth ids, which are never used again.
class VertexHistory {
public:
    /// All vertices with a birth below `next_birth` that are not known yet belong to the step
    /// `steps`. Call it whenever vertices may have been made. [step]
    void note_births(std::uint32_t next_birth, std::uint64_t steps);
    /// Keeps the positions of the view's vertices, from which the step starts. [step]
    void begin_step(const surface::SurfaceView& view);
    /// Keeps the births of the vertices that did not reach their destination; a birth may occur
    /// twice. [step]
    void end_step(std::span<const std::uint32_t> not_arrived);

    /// Sets previous_positions, arrived and age of the view after `steps` completed steps. [step]
    void apply(std::uint64_t steps, surface::SurfaceView& view) const;

    void save(StateWriter& out) const;
    /// Throws IoError "state.damaged".
    void load(StateReader& in);

private:
    // Vertices with a birth from the end of the last entry up to `end` were made in `step`.
    struct Generation {
        std::uint64_t step;
        std::uint32_t end;
        std::uint32_t unused = 0;  // so that all bytes of a checkpoint are defined
    };
    std::vector<Generation> generations_;     // ascending
    std::vector<std::uint32_t> births_;       // ascending
    std::vector<Vec3> positions_;             // of these vertices, at the start of the last step
    std::vector<std::uint32_t> not_arrived_;  // ascending, each once
};

}  // namespace dsc::run
