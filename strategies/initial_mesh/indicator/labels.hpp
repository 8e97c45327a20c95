#pragma once
// From an oriented cloud to labelled lattice vertices: field, further splits, topology filter,
// islands and cavities.

#include <vector>

#include <dsc/base/progress.hpp>
#include <dsc/base/workers.hpp>
#include <dsc/cloud/cloud.hpp>
#include <dsc/generate/label_components.hpp>
#include <dsc/generate/topology_filter.hpp>
#include <dsc/mesh/tet_mesh.hpp>

namespace dsc::indicator {

/// The name of this strategy in messages.
inline constexpr const char* generator_name = "initial mesh 'indicator'";

/// Changed vertices per sample above which the topology is doubtful.
inline constexpr double most_changed = 0.004;

/// Constants of the labelling; lengths are in widths of the samples (cloud::SurfaceSample::width).
struct LabelOptions {
    double cell = 1.0;     ///< edge of the cells at the samples, from this to 1.2 times this
    double certain = 0.2;  ///< distance of the field from its value at the surface from which a
                           ///< label is certain
    bool remove_islands = true;
    generate::CavityPolicy cavities = generate::CavityPolicy::automatic;
    double least_volume = 30.0;  ///< of islands and cavities that are kept, in cubed widths
};

/// A lattice and a value per vertex, above 0 inside: the winding number minus 1/2, unless the
/// filters changed it.
struct Labels {
    mesh::TetMesh lattice;  ///< without labels of tets
    std::vector<double> values;
    generate::TopologyFilterReport filter;
    std::vector<generate::LabelComponent> components;
    generate::TopologyCounts counts;  ///< of the returned labels
    std::size_t samples = 0;          ///< number of samples of the field
    double width = 0.0;               ///< median width of the samples
    unsigned rounds = 0;              ///< rounds of further splits

    /// Vertices of islands and cavities that were not kept.
    std::size_t settled() const;
    /// Refused and changed vertices per sample: the share of the cloud whose topology was decided
    /// by the filters, not by the field.
    double changed_share() const;
    /// The same with the vertices of confirmed places, where the field alone was too weak to
    /// decide.
    double weak_share() const;
};

/// Labels the box of half-width `half_box` round the origin, or a slightly larger one. The
/// orientation is in normalised units and has samples. Throws ConfigError "lattice.size",
/// GeometryError "indicator.nothing_inside", CancelledError. [setup]
Labels label_lattice(const cloud::Orientation& orientation, const LabelOptions& options,
                     double half_box, Workers* workers, const CancelToken* cancel);

}  // namespace dsc::indicator
