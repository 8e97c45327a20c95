#pragma once
// What the host passes to a strategy. Everything is in normalised units; the box is [-1.5, 1.5]^3
// unless an initial mesh sets another one. The inverse of `to_normalised` converts back to the
// units of the input.

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

/// What a call of a strategy can read, in normalised units. References, pointers and spans are
/// valid until the call returns; a velocity or curvature may use those of its last prepare() until
/// the end of the step, which is the last evaluate(), sample() or publish().
struct StepContext {
    /// Number of the step. Steps count from 1; 0 is the state before the first step. The calls of a
    /// step (advance, prepare, evaluate, publish, propose, select, and the calls of a curvature)
    /// get the step that is being made. Observers and refinements, and prepare() for a refinement,
    /// get the last completed step. [1; -]
    std::uint64_t step = 0;
    /// The interface: before its motion in the calls of a step, and as it is now for observers and
    /// refinements. [-; -]
    const surface::SurfaceView& surface;
    /// The points. Null when the experiment has no input cloud. [-; -]
    const cloud::TargetCloud* cloud = nullptr;
    /// Nearest point of the cloud for each vertex. Empty without a cloud, and in tests; there
    /// nearest_point() searches the cloud. [V; index and n]
    std::span<const cloud::Neighbour> nearest = {};
    /// L, the wanted length of an interface edge. [1; n]
    double target_length = 0.0;
    /// The box that the tets fill. [-; n]
    Box3 box;
    /// Converts from the units of the input to normalised units; without input it is the identity.
    /// Its inverse converts back. [-; -]
    cloud::Transform to_normalised{};
    /// Seed of the experiment; use random(). [1; -]
    std::uint64_t seed = 0;
    /// Stream id of this strategy's place in the experiment; random() uses it. [1; -]
    std::uint64_t instance = 0;
    /// Says whether the run shall stop; see cancelled(). May be null, and is null in the calls of
    /// improvements and observers. [-; -]
    const CancelToken* cancel = nullptr;
    /// Threads for loops of the strategy outside evaluate(), with dsc::for_blocks(). Null: one
    /// thread. [-; -]
    Workers* workers = nullptr;
    /// Last step of the run, from the velocity or the schedule; 0 if it is unknown. [1; -]
    std::uint64_t planned_steps = 0;
    /// Target length of each vertex. Empty where it is L everywhere. [V; n]
    std::span<const double> target_lengths = {};
    /// Nearest place on the surface for each point of the cloud. Filled in the calls of a velocity,
    /// refinement or observer whose needs_faces_of_points() returns true; it may be empty in all
    /// other calls. Empty without a cloud or a face. [P; -]
    std::span<const surface::FacePoint> faces_of_points = {};
    /// Support of each vertex: the part of its area, 0 to 1, for which the cloud has points
    /// (dsc/hooks/support.hpp). Filled in the calls of a velocity, refinement or observer whose
    /// needs_support() returns true; it may be empty in all other calls. Empty without a cloud or a
    /// face. [V; -]
    std::span<const double> support = {};
    /// The labelled tets. Filled in the calls of observers and refinements. Null in all other
    /// calls, and in tests that have only a surface. [-; -]
    const mesh::VolumeView* volume = nullptr;
    /// What strategies have published, updated to this surface: V values per attribute. [-; -]
    std::span<const Attribute> attributes = {};

    /// The point of the cloud nearest to a vertex, from `nearest` or by a search. There must be a
    /// cloud. [-; index and n] [parallel]
    cloud::Neighbour nearest_point(std::size_t vertex) const {
        return nearest.empty() ? cloud->search().nearest(surface.positions[vertex])
                               : nearest[vertex];
    }
    /// The target length at a vertex. [1; n] [parallel]
    double target_length_at(std::size_t vertex) const {
        return target_lengths.empty() ? target_length : target_lengths[vertex];
    }
    /// The random stream of one element, such as a birth id, in this step. It does not depend on
    /// the order of calls or the number of threads. [-; -] [parallel]
    RandomStream random(std::uint64_t element) const {
        return RandomStream(RandomKey{seed, instance, step, element});
    }
    /// Whether the run shall stop: on request, or because its time budget is over. A long loop
    /// should call this function repeatedly. When it returns true, the loop may return early with
    /// any answer: all answers of the step, or of the pass of a refinement, are discarded, and the
    /// run stops in the state before them. It is always false in the calls of improvements and
    /// observers, because their step is always completed. [1; -] [parallel]
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
