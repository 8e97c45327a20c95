#pragma once
// Target lengths of the interface edges, from the number of vertices that suits the points of the
// cloud.

#include <cstdint>
#include <vector>

#include <dsc/hooks/context.hpp>

#include "edge_mesh.hpp"

namespace dsc::remesh {

/// The wishes of the user.
struct Wish {
    std::uint64_t vertices = 0;                    ///< budget; 0: from the number of points
    double edge_length = 0.0;                      ///< in normalised units; 0: from the budget
    bool thin_parts = true;                        ///< thin parts get shorter edges
    cloud::Detail detail = cloud::Detail::medium;  ///< level of detail of the budget from the
                                                   ///< points
};

/// Target lengths for a surface. [step]
class Sizing {
public:
    /// Number of vertices that the surface may have; 0 if there is neither a wish nor a cloud.
    static double budget(const Wish& wish, const cloud::TargetCloud* cloud);

    /// The lengths for `mesh`, the view of `context`, multiplied by `factor`; they are valid until
    /// the next call.
    Lengths lengths(const hooks::StepContext& context, const EdgeMesh& mesh, const Wish& wish,
                    double factor);
    /// Factor by which thin parts may exceed the budget with the last lengths, from 1 to 1.5.
    double allowance() const { return allowance_; }

private:
    void even_lengths(const hooks::StepContext& context, const EdgeMesh& mesh, double vertices,
                      double scale);
    bool shorten_thin_parts(const hooks::StepContext& context, const EdgeMesh& mesh);
    void median_of_rings(const EdgeMesh& mesh, std::vector<double>& values);
    void follow_widths(const hooks::StepContext& context, const EdgeMesh& mesh, double vertices,
                       double scale);
    void smooth(const EdgeMesh& mesh);
    void grade(const EdgeMesh& mesh);
    double count(const EdgeMesh& mesh) const;

    double allowance_ = 1.0;
    std::vector<double> each_, next_, weights_;
    std::vector<double> thickness_, usual_, ring_;
};

/// Factor by which noise makes the lengths longer: min(2, 1 + 1.5 s), with the ratio s of noise to
/// spacing. For an even cloud, ratios up to 0.12 have no effect, since curvature is measured as
/// noise there.
double noise_factor(const cloud::Statistics& statistics);

}  // namespace dsc::remesh
