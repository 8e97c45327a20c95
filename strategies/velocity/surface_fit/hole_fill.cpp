#include "hole_fill.hpp"

#include <algorithm>

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

namespace dsc::strategies::fit {
namespace {

constexpr double filled_beyond = 1.0;        // spacings
constexpr std::size_t alike_neighbours = 2;  // with fewer, it is a vertex between points, not a
                                             // hole
constexpr std::size_t largest_part = 4;      // a hole contains at most a quarter of the surface's
                                             // vertices
constexpr int no_unknown = -1;

/// The number of each unknown, per vertex.
class HoleVertices {
public:
    HoleVertices(const SurfaceLinks& links, std::span<const double> gaps,
                 std::span<const std::uint8_t> movable)
        : links_(links), states_(gaps.size(), State::outside), unknown_(gaps.size(), no_unknown) {
        for (std::size_t v = 0; v < gaps.size(); ++v) {
            if (movable[v] == 0 || !(gaps[v] > filled_beyond)) continue;
            const auto near = links.neighbours_of(v);
            const auto alike = std::count_if(
                near.begin(), near.end(), [&](std::uint32_t w) { return gaps[w] > filled_beyond; });
            if (static_cast<std::size_t>(alike) >= alike_neighbours) states_[v] = State::inside;
        }
        for (std::uint32_t v = 0; v < states_.size(); ++v) {
            if (states_[v] == State::inside) take_piece(v);
        }
    }

    int unknown(std::size_t vertex) const { return unknown_[vertex]; }
    const std::vector<std::uint32_t>& vertices() const { return vertices_; }

    /// The unknowns and the vertices next to them, ascending.
    std::vector<std::uint32_t> with_ring() const {
        std::vector<std::uint32_t> all = vertices_;
        for (const std::uint32_t v : vertices_) {
            for (const std::uint32_t w : links_.neighbours_of(v)) all.push_back(w);
        }
        std::sort(all.begin(), all.end());
        all.erase(std::unique(all.begin(), all.end()), all.end());
        return all;
    }

private:
    enum class State : std::uint8_t { outside, inside, seen };

    // Collects the hole of a vertex, unless nothing surrounds it or it is larger than a hole: then
    // that side was not scanned.
    void take_piece(std::uint32_t start) {
        std::vector<std::uint32_t> piece = {start};
        states_[start] = State::seen;
        bool surrounded = false;
        for (std::size_t i = 0; i < piece.size(); ++i) {
            for (const std::uint32_t w : links_.neighbours_of(piece[i])) {
                surrounded = surrounded || states_[w] == State::outside;
                if (states_[w] != State::inside) continue;
                states_[w] = State::seen;
                piece.push_back(w);
            }
        }
        if (!surrounded || piece.size() > states_.size() / largest_part) return;
        for (const std::uint32_t v : piece) {
            unknown_[v] = static_cast<int>(vertices_.size());
            vertices_.push_back(v);
        }
    }

    const SurfaceLinks& links_;
    std::vector<State> states_;
    std::vector<int> unknown_;
    std::vector<std::uint32_t> vertices_;
};

using SparseMatrix = Eigen::SparseMatrix<double>;

/// Laplacian x = right: one equation per vertex of a hole or next to one, x - mean of the
/// neighbours = 0.
struct Laplacian {
    SparseMatrix matrix;
    Eigen::MatrixX3d right;
};

Laplacian laplacian_of(const SurfaceLinks& links, const HoleVertices& hole,
                       const std::vector<Vec3>& positions) {
    const std::vector<std::uint32_t> centres = hole.with_ring();
    const auto equations = static_cast<Eigen::Index>(centres.size());
    const auto unknowns = static_cast<Eigen::Index>(hole.vertices().size());
    Laplacian laplacian{SparseMatrix(equations, unknowns), Eigen::MatrixX3d::Zero(equations, 3)};
    std::vector<Eigen::Triplet<double>> entries;
    for (Eigen::Index e = 0; e < equations; ++e) {
        const std::uint32_t v = centres[static_cast<std::size_t>(e)];
        const auto add = [&](std::uint32_t w, double factor) {
            const int unknown = hole.unknown(w);
            if (unknown != no_unknown)
                entries.emplace_back(static_cast<int>(e), unknown, factor);
            else
                laplacian.right.row(e) -= factor * positions[w].transpose();
        };
        add(v, 1.0);
        const auto near = links.neighbours_of(v);
        for (const std::uint32_t w : near) add(w, -1.0 / static_cast<double>(near.size()));
    }
    laplacian.matrix.setFromTriplets(entries.begin(), entries.end());
    return laplacian;
}

}  // namespace

std::size_t fill_holes(const SurfaceLinks& links, std::span<const double> gaps,
                       std::span<const std::uint8_t> movable, std::vector<Vec3>& positions) {
    const HoleVertices hole(links, gaps, movable);
    if (hole.vertices().empty()) return 0;
    const Laplacian laplacian = laplacian_of(links, hole, positions);
    const SparseMatrix transposed = laplacian.matrix.transpose();
    const Eigen::SimplicialLDLT<SparseMatrix> factors(transposed * laplacian.matrix);
    if (factors.info() != Eigen::Success) return 0;
    const Eigen::MatrixX3d places = factors.solve(transposed * laplacian.right);
    if (!places.allFinite()) return 0;
    for (std::size_t i = 0; i < hole.vertices().size(); ++i) {
        positions[hole.vertices()[i]] = places.row(static_cast<Eigen::Index>(i)).transpose();
    }
    return hole.vertices().size();
}

}  // namespace dsc::strategies::fit
