#pragma once
// What the host passes to a strategy. Everything is in normalised units; the box is [-1.5, 1.5]^3
// unless an initial mesh sets another one. The inverse of `to_normalised` leads back to the units
// of the input.

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

/// Constant during one step.
struct StepContext {
    std::uint64_t step = 0;
    const surface::SurfaceView& surface;
    const cloud::TargetCloud* cloud = nullptr;  ///< null when the experiment has no input cloud
    std::span<const cloud::Neighbour> nearest = {};  ///< nearest cloud point of each view vertex;
                                                     ///< empty if not searched yet
    double target_length = 0.0;                      ///< L
    Box3 box;
    cloud::Transform to_normalised{};  ///< from the units of the input to normalised units; the
                                       ///< identity without input
    std::uint64_t seed = 0;
    std::uint64_t instance = 0;  ///< stream id of this strategy's place in the experiment
    const CancelToken* cancel = nullptr;
    Workers* workers = nullptr;  ///< for own loops outside evaluate() (dsc::for_blocks); null: one
                                 ///< thread
    std::uint64_t planned_steps = 0;  ///< last step of the run, from the velocity or the schedule;
                                      ///< 0: unknown
    std::span<const double> target_lengths = {};  ///< target length of each view vertex; empty
                                                  ///< where it is L everywhere
    /// For each point of the cloud the nearest place on the surface. It is filled in the step calls
    /// of a velocity with needs_faces_of_points(), and empty in all other calls and without a
    /// cloud.
    std::span<const surface::FacePoint> faces_of_points = {};
    std::span<const Attribute> attributes = {};  ///< what strategies have published, transferred to
                                                 ///< this surface

    /// The point of the cloud nearest to a view vertex, from `nearest` or by a search. There must
    /// be a cloud. [parallel]
    cloud::Neighbour nearest_point(std::size_t vertex) const {
        return nearest.empty() ? cloud->search().nearest(surface.positions[vertex])
                               : nearest[vertex];
    }
    /// The target length at a view vertex. [parallel]
    double target_length_at(std::size_t vertex) const {
        return target_lengths.empty() ? target_length : target_lengths[vertex];
    }

    /// The random stream of one element (a birth id) in this step. It does not depend on the order
    /// of calls or the number of threads. [parallel]
    RandomStream random(std::uint64_t element) const {
        return RandomStream(RandomKey{seed, instance, step, element});
    }
    bool cancelled() const { return cancel != nullptr && cancel->cancelled(); }
};

/// Base of all strategies: state that must survive a checkpoint. By default there is no such state.
class Strategy {
public:
    Strategy() = default;
    virtual ~Strategy();
    Strategy(const Strategy&) = delete;
    Strategy& operator=(const Strategy&) = delete;

    /// Writes everything that evaluate() depends on, except parameters and context. [step]
    virtual void save(std::ostream& out) const;
    /// Reads the state back. Throws on damaged input. [step]
    virtual void load(std::istream& in);
};

}  // namespace dsc::hooks
