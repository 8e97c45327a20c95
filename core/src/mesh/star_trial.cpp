// Copies the corners of a star, two tets side by side.
#include "dsc/mesh/star_trial.hpp"

namespace dsc::mesh {

void StarCopy::gather(const Complex& complex, std::span<const TetId> star, VertexId v) {
    count_ = star.size();
    const std::size_t pairs = (count_ + 1) / 2;
    if (pairs_.size() < pairs) pairs_.resize(pairs);
    for (std::size_t i = 0; i < 2 * pairs; ++i) {
        Pair& pair = pairs_[i / 2];
        const auto side = static_cast<Eigen::Index>(i % 2);
        // An odd star has its last tet twice.
        const Tet& tet = complex.tet(star[std::min(i, count_ - 1)]);
        pair.own[i % 2] = index_of(tet, v);
        for (unsigned k = 0; k < 4; ++k) {
            const Vec3& p = complex.position(tet.v[k]);
            for (unsigned axis = 0; axis < 3; ++axis) pair.corners[k][axis][side] = p[axis];
        }
    }
}

void StarCopy::move(const Vec3& place) {
    for (std::size_t i = 0; i < (count_ + 1) / 2; ++i) {
        Pair& pair = pairs_[i];
        for (Eigen::Index side = 0; side < 2; ++side) {
            geometry::TwoVec3& own = pair.corners[pair.own[static_cast<std::size_t>(side)]];
            for (unsigned axis = 0; axis < 3; ++axis) own[axis][side] = place[axis];
        }
    }
}

}  // namespace dsc::mesh
