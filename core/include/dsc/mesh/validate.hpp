#pragma once
// Checks a complex by a full scan: for tests, `dsc info` and the audit. A step of a run
// does not use it, because it is too slow.

#include <string>
#include <vector>

#include <dsc/mesh/complex.hpp>

namespace dsc::mesh {

/// What a full scan found.
struct ComplexReport {
    std::vector<std::string> faults;  ///< empty for a valid complex; at most 20, each naming an
                                      ///< element
    std::size_t inverted_tets = 0;    ///< orient3d not 1
    std::size_t irregular_vertices = 0;
    double min_quality = 1.0;
    double volume = 0.0;  ///< of all tets
    bool valid() const { return faults.empty(); }
};

/// Checks exact orientation, symmetry of the adjacency, seeds, caches (quality, phases, interface
/// list), that vertices of box faces are marked, that the volumes add up to the box, and that every
/// interface vertex is regular. [step]
ComplexReport validate(const Complex& complex);

/// Counts of the interface of a complex: shells, genus summed over shells, Euler number, by a full
/// scan.
struct InterfaceCounts {
    std::size_t vertices = 0, edges = 0, faces = 0;
    std::size_t shells = 0;
    long euler() const {
        return static_cast<long>(vertices) - static_cast<long>(edges) + static_cast<long>(faces);
    }
    /// Sum over closed shells of (2 - Euler number) / 2.
    long genus() const { return static_cast<long>(shells) - euler() / 2; }
};
InterfaceCounts count_interface(const Complex& complex);

/// Sum of the volumes of all tets with a label above 0.
double labelled_volume(const Complex& complex);

}  // namespace dsc::mesh
