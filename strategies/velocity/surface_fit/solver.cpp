#include "solver.hpp"

#include <cmath>

#include <Eigen/LU>

namespace dsc::strategies::fit {
namespace {

constexpr std::size_t solver_vertices = 512;  // per block
constexpr std::size_t solver_rows = 2048;     // per block

/// The inverse of a positive definite block; zero if it is not positive definite, for example
/// without rows: such a vertex stays.
Eigen::Matrix3d inverse_of(const Eigen::Matrix3d& block) {
    const Eigen::Matrix3d inverse = block.inverse();
    return inverse.allFinite() && block.determinant() > 0.0
               ? inverse
               : Eigen::Matrix3d(Eigen::Matrix3d::Zero());
}

}  // namespace

double Solver::sum() const {
    double total = 0.0;
    for (const double part : partial_) total += part;
    return total;
}

// Right-hand side and preconditioner. Vertices without rows do not move and have an inverse of
// zero.
void Solver::begin(const RowSystem& system, Workers* workers) {
    const std::size_t count = system.vertex_count();
    for (std::vector<Vec3>* vector : {&residual_, &conditioned_, &direction_, &product_})
        vector->assign(count, Vec3::Zero());
    pull_.resize(system.rows.size());
    inverse_.resize(count);
    partial_.assign((count + solver_vertices - 1) / solver_vertices, 0.0);
    for_blocks(workers, count, solver_vertices, [&](std::size_t begin, std::size_t end) {
        for (std::size_t v = begin; v < end; ++v) {
            const auto entries = system.entries_of(v);
            inverse_[v].setZero();
            if (entries.empty()) continue;
            const Hold& hold = system.holds[v];
            Eigen::Matrix3d block =
                hold.along * Eigen::Matrix3d::Identity() - hold.axis * hold.axis.transpose();
            Vec3 right = Vec3::Zero();
            for (const RowSystem::Entry& e : entries) {
                const Vec3& n = system.rows[e.row].direction;
                block += (e.factor * e.factor) * (n * n.transpose());
                right += (e.factor * system.wanted[e.row]) * n;
            }
            inverse_[v] = inverse_of(block);
            residual_[v] = right;
        }
    });
}

// product_ = A direction_; returns direction_ . product_.
double Solver::multiply(const RowSystem& system, Workers* workers) {
    for_blocks(workers, system.rows.size(), solver_rows, [&](std::size_t begin, std::size_t end) {
        for (std::size_t r = begin; r < end; ++r) {
            const Row& row = system.rows[r];
            Vec3 moved = row.factor[0] * direction_[row.vertex[0]];
            for (std::size_t k = 1; k < 4; ++k) moved += row.factor[k] * direction_[row.vertex[k]];
            pull_[r] = row.direction.dot(moved) * row.direction;
        }
    });
    for_blocks(workers, system.vertex_count(), solver_vertices,
               [&](std::size_t begin, std::size_t end) {
                   double part = 0.0;
                   for (std::size_t v = begin; v < end; ++v) {
                       Vec3 sum = system.holds[v].times(direction_[v]);
                       for (const RowSystem::Entry& e : system.entries_of(v))
                           sum += e.factor * pull_[e.row];
                       product_[v] = sum;
                       part += sum.dot(direction_[v]);
                   }
                   partial_[begin / solver_vertices] = part;
               });
    return sum();
}

// One step along direction_; returns the new residual . preconditioned residual.
double Solver::descend(double step, Workers* workers, std::vector<Vec3>& displacements) {
    for_blocks(workers, residual_.size(), solver_vertices, [&](std::size_t begin, std::size_t end) {
        double part = 0.0;
        for (std::size_t v = begin; v < end; ++v) {
            displacements[v] += step * direction_[v];
            residual_[v] -= step * product_[v];
            conditioned_[v].noalias() = inverse_[v] * residual_[v];
            part += conditioned_[v].dot(residual_[v]);
        }
        partial_[begin / solver_vertices] = part;
    });
    return sum();
}

SolverReport Solver::solve(const RowSystem& system, const SolverOptions& options, Workers* workers,
                           std::vector<Vec3>& displacements) {
    displacements.assign(system.vertex_count(), Vec3::Zero());
    begin(system, workers);
    const double start = descend(0.0, workers, displacements);
    double left = start;
    double before = INFINITY;  // the first direction is the preconditioned residual alone
    SolverReport report;
    while (left > options.tolerance * options.tolerance * start &&
           report.iterations < options.most_iterations) {
        const double turn = left / before;
        for_blocks(workers, direction_.size(), solver_vertices,
                   [&](std::size_t begin, std::size_t end) {
                       for (std::size_t v = begin; v < end; ++v)
                           direction_[v] = conditioned_[v] + turn * direction_[v];
                   });
        const double curvature = multiply(system, workers);
        if (!(curvature > 0.0) || !std::isfinite(curvature)) break;
        before = left;
        left = descend(left / curvature, workers, displacements);
        ++report.iterations;
    }
    report.residual = start > 0.0 ? std::sqrt(left / start) : 0.0;
    return report;
}

}  // namespace dsc::strategies::fit
