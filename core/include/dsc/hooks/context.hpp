#pragma once
// What the host tells a strategy. Everything is in normalised units (the box is [-1.5, 1.5]^3 unless an initial mesh says
// otherwise); `to_input` leads back to the units of the input.

#include <cstdint>
#include <iosfwd>
#include <span>

#include <dsc/base/progress.hpp>
#include <dsc/base/random.hpp>
#include <dsc/base/workers.hpp>
#include <dsc/cloud/normalize.hpp>
#include <dsc/cloud/target.hpp>
#include <dsc/geometry/vec.hpp>
#include <dsc/hooks/attributes.hpp>
#include <dsc/surface/face_points.hpp>
#include <dsc/surface/surface_view.hpp>

namespace dsc::hooks {

/// Half-open range of view vertices.
struct Range {
    std::size_t begin = 0;
    std::size_t end = 0;
    std::size_t size() const { return end - begin; }
};

/// Constant for the length of one step.
struct StepContext {
    std::uint64_t step = 0;
    const surface::SurfaceView& surface;
    const cloud::TargetCloud* cloud = nullptr;  ///< null when the experiment has no input cloud
    std::span<const cloud::Neighbour> nearest = {};  ///< cloud point nearest to each view vertex; empty where nobody has looked yet
    double target_length = 0.0;                 ///< L
    Box3 box;
    cloud::Transform to_normalised;             ///< input to normalised units; the identity without input
    std::uint64_t seed = 0;
    std::uint64_t instance = 0;                 ///< stream id of this strategy's place in the experiment
    const CancelToken* cancel = nullptr;
    Workers* workers = nullptr;                 ///< for a strategy's own loops outside evaluate() (dsc::for_blocks); null: one thread
    std::uint64_t planned_steps = 0;            ///< number of the run's last step: as the velocity tells, else that of the schedule; 0: unknown
    std::span<const double> target_lengths = {};  ///< target length of each view vertex; empty where it is L everywhere
    /// For each point of the cloud the nearest place of the surface; filled in the step calls of a velocity that
    /// needs_faces_of_points(), empty elsewhere and without a cloud.
    std::span<const surface::FacePoint> faces_of_points = {};
    std::span<const Attribute> attributes = {};   ///< what strategies have published, carried to this surface

    /// The point of the cloud, which must be there, nearest to a view vertex: from `nearest`, or searched. [parallel]
    cloud::Neighbour nearest_point(std::size_t vertex) const {
        return nearest.empty() ? cloud->search().nearest(surface.positions[vertex]) : nearest[vertex];
    }
    /// The target length at a view vertex. [parallel]
    double target_length_at(std::size_t vertex) const { return target_lengths.empty() ? target_length : target_lengths[vertex]; }

    /// The random stream of one element (a birth id) in this step. Order and thread count do not matter. [parallel]
    RandomStream random(std::uint64_t element) const { return RandomStream(RandomKey{seed, instance, step, element}); }
    bool cancelled() const { return cancel != nullptr && cancel->cancelled(); }
};

/// Base of all strategies: state that must survive a checkpoint. Empty by default.
class Strategy {
public:
    Strategy() = default;
    virtual ~Strategy();
    Strategy(const Strategy&) = delete;
    Strategy& operator=(const Strategy&) = delete;

    /// Writes whatever evaluate() depends on beyond parameters and context. [step]
    virtual void save(std::ostream& out) const;
    /// Reads it back; throws on damaged input. [step]
    virtual void load(std::istream& in);
};

}  // namespace dsc::hooks
