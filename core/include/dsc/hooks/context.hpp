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
#include <dsc/mesh/volume_view.hpp>
#include <dsc/surface/face_points.hpp>
#include <dsc/surface/surface_view.hpp>

namespace dsc::hooks {

/// Half-open range of view vertices.
struct Range {
    std::size_t begin = 0;
    std::size_t end = 0;
    std::size_t size() const { return end - begin; }
};

/// What a call of a strategy can read, in normalised units. All references, pointers and spans are
/// valid until the call returns; a velocity or curvature may keep them from prepare() until its
/// last evaluate(), sample() or publish() call of the step.
struct StepContext {
    /// Number of the step. Steps count from 1; 0 is the state before the first step. The calls of a
    /// velocity, its curvature and the improvement get the step that is being made; observers and
    /// refinements get the last completed step.
    std::uint64_t step = 0;
    const surface::SurfaceView& surface;  ///< the interface before the step that is being made, or
                                          ///< after the last completed step
    const cloud::TargetCloud* cloud = nullptr;  ///< null when the experiment has no input cloud
    std::span<const cloud::Neighbour> nearest = {};  ///< nearest cloud point of each view vertex;
                                                     ///< empty without a cloud and in tests; see
                                                     ///< nearest_point()
    double target_length = 0.0;                      ///< L, the wanted length of an interface edge
    Box3 box;                                        ///< box that the tets fill
    cloud::Transform to_normalised{};     ///< from the units of the input to normalised units; the
                                          ///< identity without input
    std::uint64_t seed = 0;               ///< of the experiment; use random()
    std::uint64_t instance = 0;           ///< stream id of this strategy's place in the experiment
    const CancelToken* cancel = nullptr;  ///< see cancelled()
    Workers* workers = nullptr;  ///< for own loops outside evaluate() (dsc::for_blocks); null: one
                                 ///< thread
    std::uint64_t planned_steps = 0;  ///< last step of the run, from the velocity or the schedule;
                                      ///< 0: unknown
    std::span<const double> target_lengths = {};  ///< target length of each view vertex; empty
                                                  ///< where it is L everywhere
    /// For each point of the cloud the nearest place on the surface. Filled in the calls of a
    /// velocity, refinement or observer whose needs_faces_of_points() returns true; it may be
    /// empty in all other calls, and it is empty without a cloud or a face.
    std::span<const surface::FacePoint> faces_of_points = {};
    /// Support of each view vertex: the part of its area, 0 to 1, for which the cloud has points
    /// (dsc/hooks/support.hpp). Filled in the calls of a velocity, refinement or observer whose
    /// needs_support() returns true; it may be empty in all other calls, and it is empty
    /// without a cloud or a face.
    std::span<const double> support = {};
    /// The labelled tets. Filled in the calls of observers and refinements; null in all other
    /// calls, and in tests that have only a surface.
    const mesh::VolumeView* volume = nullptr;
    std::span<const Attribute> attributes = {};  ///< numbers per vertex that strategies have
                                                 ///< published, updated to this surface

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
    /// Whether the run shall stop; long loops ask now and then and return early. [parallel]
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
