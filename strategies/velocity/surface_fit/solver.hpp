#pragma once
// Conjugate gradients for a RowSystem, without a matrix.

#include <vector>

#include "rows.hpp"

namespace dsc::strategies::fit {

struct SolverOptions {
    std::size_t most_iterations = 80;
    double tolerance = 1e-3;  ///< of the preconditioned residual's length, relative to that at the
                              ///< start
};

struct SolverReport {
    std::size_t iterations = 0;
    double residual = 0.0;  ///< final residual over the initial one
};

/// Keeps its memory between calls.
class Solver {
public:
    /// Minimises from zero displacements on [Hestenes1952], preconditioned by the 3 x 3 blocks of
    /// the diagonal; `displacements` gets one entry per vertex, zero where a vertex has no row. All
    /// sums are over fixed blocks: the same bits for any number of threads. [step]
    SolverReport solve(const RowSystem& system, const SolverOptions& options, Workers* workers,
                       std::vector<Vec3>& displacements);

private:
    void begin(const RowSystem& system, Workers* workers);
    double multiply(const RowSystem& system, Workers* workers);
    double descend(double step, Workers* workers, std::vector<Vec3>& displacements);
    double sum() const;

    std::vector<Eigen::Matrix3d> inverse_;  // of the blocks of the diagonal
    std::vector<Vec3> residual_;
    std::vector<Vec3> conditioned_;
    std::vector<Vec3> direction_;
    std::vector<Vec3> product_;
    std::vector<Vec3> pull_;       // per row
    std::vector<double> partial_;  // per block of vertices
};

}  // namespace dsc::strategies::fit
