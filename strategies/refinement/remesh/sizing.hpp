#pragma once
// How long the edges of the interface shall be: as many vertices as the cloud's points are worth.

#include <cstdint>
#include <vector>

#include <dsc/hooks/context.hpp>

#include "edge_mesh.hpp"

namespace dsc::remesh {

/// What the user asks for.
struct Wish {
    std::uint64_t vertices = 0;  ///< budget; 0: what the number of points is worth
    double edge_length = 0.0;    ///< in normalised units; 0: from the budget
    bool thin_parts = true;      ///< thin parts get shorter edges
    cloud::Detail detail = cloud::Detail::medium;  ///< of the budget that the points give
};

/// Target lengths for a surface. [step]
class Sizing {
public:
    /// Number of vertices that the surface may have; 0 where neither wish nor cloud says anything.
    static double budget(const Wish& wish, const cloud::TargetCloud* cloud);

    /// The lengths for `mesh`, the view of `context`, all times `factor`; they live until the next call.
    Lengths lengths(const hooks::StepContext& context, const EdgeMesh& mesh, const Wish& wish, double factor);
    /// By how many times thin parts may exceed the budget with the lengths given last, from 1 to 1.5.
    double allowance() const { return allowance_; }

private:
    void even_lengths(const hooks::StepContext& context, const EdgeMesh& mesh, double vertices, double scale);
    bool shorten_thin_parts(const hooks::StepContext& context, const EdgeMesh& mesh);
    void median_of_rings(const EdgeMesh& mesh, std::vector<double>& values);
    void follow_widths(const hooks::StepContext& context, const EdgeMesh& mesh, double vertices, double scale);
    void smooth(const EdgeMesh& mesh);
    void grade(const EdgeMesh& mesh);
    double count(const EdgeMesh& mesh) const;

    double allowance_ = 1.0;
    std::vector<double> each_, next_, weights_;
    std::vector<double> thickness_, usual_, ring_;
};

/// By what the lengths grow where the points are noisy: min(2, 1 + 1.5 s), with the ratio s of noise to point width, of which
/// an even cloud has a dead zone up to 0.12, since curvature reads as noise there.
double noise_factor(const cloud::Statistics& statistics);

}  // namespace dsc::remesh
