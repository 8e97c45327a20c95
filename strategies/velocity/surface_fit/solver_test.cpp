#include "solver.hpp"

#include <Eigen/Cholesky>
#include <doctest/doctest.h>

#include <dsc/base/random.hpp>

using dsc::Vec3;
using namespace dsc::strategies::fit;

namespace {

Vec3 random_vector(dsc::RandomStream& random) {
    return {random.uniform() - 0.5, random.uniform() - 0.5, random.uniform() - 0.5};
}

/// Rows between random vertices with holds that differ by direction; every seventh vertex does not
/// move.
RowSystem random_system(std::uint32_t vertices, std::size_t rows,
                        std::vector<std::uint8_t>& movable) {
    dsc::RandomStream random(dsc::RandomKey{7, 1, 0, 0});
    RowSystem system;
    for (std::size_t r = 0; r < rows; ++r) {
        Row row;
        row.direction = random_vector(random);
        for (std::size_t k = 0; k < 4; ++k) {
            row.vertex[k] = static_cast<std::uint32_t>(random.index(vertices));
            row.factor[k] = random.uniform() - 0.5;
        }
        if (r % 3 == 0) row.factor[3] = 0.0;
        if (r % 11 == 0) row = {};
        system.rows.push_back(row);
        system.wanted.push_back(random.uniform() - 0.5);
    }
    for (std::uint32_t v = 0; v < vertices; ++v)
        system.holds.push_back({0.05, std::sqrt(0.04) * random_vector(random).normalized()});
    movable.assign(vertices, 1);
    for (std::uint32_t v = 0; v < vertices; v += 7) movable[v] = 0;
    gather_rows(system, movable);
    return system;
}

/// The same minimum by Cholesky's method on the full matrix.
std::vector<Vec3> dense_minimum(const RowSystem& system, const std::vector<std::uint8_t>& movable) {
    const auto count = static_cast<Eigen::Index>(movable.size());
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(3 * count, 3 * count);
    Eigen::VectorXd right = Eigen::VectorXd::Zero(3 * count);
    for (std::size_t r = 0; r < system.rows.size(); ++r) {
        Eigen::RowVectorXd line = Eigen::RowVectorXd::Zero(3 * count);
        for (std::size_t k = 0; k < 4; ++k) {
            const std::uint32_t v = system.rows[r].vertex[k];
            if (movable[v] != 0)
                line.segment<3>(3 * v) +=
                    system.rows[r].factor[k] * system.rows[r].direction.transpose();
        }
        matrix += line.transpose() * line;
        right += system.wanted[r] * line.transpose();
    }
    for (Eigen::Index v = 0; v < count; ++v) {
        const Hold& hold = system.holds[static_cast<std::size_t>(v)];
        matrix.block<3, 3>(3 * v, 3 * v) +=
            hold.along * Eigen::Matrix3d::Identity() - hold.axis * hold.axis.transpose();
    }
    const Eigen::VectorXd solution = matrix.ldlt().solve(right);
    std::vector<Vec3> out;
    for (Eigen::Index v = 0; v < count; ++v)
        out.emplace_back(movable[static_cast<std::size_t>(v)] != 0
                             ? Vec3(solution.segment<3>(3 * v))
                             : Vec3::Zero());
    return out;
}

}  // namespace

TEST_CASE("the solver finds the minimum that a dense factorisation finds") {
    std::vector<std::uint8_t> movable;
    const RowSystem system = random_system(60, 300, movable);
    const std::vector<Vec3> expected = dense_minimum(system, movable);
    Solver solver;
    std::vector<Vec3> found;
    const SolverReport report =
        solver.solve(system, {.most_iterations = 500, .tolerance = 1e-12}, nullptr, found);
    CHECK(report.residual <= 1e-12);
    REQUIRE(found.size() == expected.size());
    for (std::size_t v = 0; v < found.size(); ++v) {
        if (movable[v] == 0 || !system.entries_of(v).empty())
            CHECK((found[v] - expected[v]).norm() < 1e-9);
    }
}

TEST_CASE("the solver stops at its tolerance or its limit of iterations, and is then closer to the "
          "solution") {
    std::vector<std::uint8_t> movable;
    const RowSystem system = random_system(400, 2500, movable);
    Solver solver;
    std::vector<Vec3> exact, found;
    solver.solve(system, {.most_iterations = 2000, .tolerance = 1e-13}, nullptr, exact);
    const SolverReport few =
        solver.solve(system, {.most_iterations = 3, .tolerance = 1e-13}, nullptr, found);
    CHECK(few.iterations == 3);
    const SolverReport usual = solver.solve(system, {}, nullptr, found);
    CHECK(usual.iterations > 3);
    CHECK(usual.iterations < 80);
    CHECK(usual.residual <= 1e-3);
    double off = 0.0, all = 0.0;
    for (std::size_t v = 0; v < found.size(); ++v) {
        off += (found[v] - exact[v]).squaredNorm();
        all += exact[v].squaredNorm();
    }
    CHECK(off < 1e-5 * all);
}

TEST_CASE("the solver gives the same bits with any number of threads") {
    std::vector<std::uint8_t> movable;
    const RowSystem system = random_system(3000, 15000, movable);
    Solver solver;
    std::vector<Vec3> alone;
    solver.solve(system, {}, nullptr, alone);
    for (const unsigned threads : {1U, 2U, 3U}) {
        dsc::Workers workers(threads);
        std::vector<Vec3> found;
        Solver another;
        another.solve(system, {}, &workers, found);
        CHECK(found == alone);
    }
}

TEST_CASE("without rows, or where none has an effect, nothing moves") {
    RowSystem system;
    system.rows.resize(5);
    system.wanted.assign(5, 1.0);
    system.holds.assign(4, Hold{1.0, Vec3::Zero()});
    gather_rows(system, std::vector<std::uint8_t>(4, 1));
    Solver solver;
    std::vector<Vec3> found;
    CHECK(solver.solve(system, {}, nullptr, found).iterations == 0);
    CHECK(found == std::vector<Vec3>(4, Vec3::Zero()));
}
