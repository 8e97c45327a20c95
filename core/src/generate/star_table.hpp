#pragma once
// The stars of some vertices of a plain tet mesh, in one array.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <dsc/geometry/vec.hpp>

namespace dsc::generate::stuffing {

using Corners = std::array<std::uint32_t, 4>;
/// The mesh that is cut.
struct LatticeView {
    std::span<const Vec3> points;
    std::span<const Corners> tets;
};
/// Whether the point lies on the sides of the box or outside.
inline bool lies_on(const Box3& box, const Vec3& p) {
    return (p.array() <= box.low.array()).any() || (p.array() >= box.high.array()).any();
}
/// Means that there is no vertex.
inline constexpr std::uint32_t no_vertex = 0xffffffffU;

/// Tets of each marked vertex, in ascending order; other vertices have no tets in the table.
class StarTable {
public:
    StarTable(std::span<const Corners> tets, std::span<const char> marks)
        : start_(marks.size() + 2, 0) {
        for (const Corners& tet : tets) {
            for (const std::uint32_t v : tet) start_[v + 2] += marks[v] != 0 ? 1 : 0;
        }
        for (std::size_t i = 2; i < start_.size(); ++i) start_[i] += start_[i - 1];
        tets_.resize(start_.back());
        for (std::uint32_t t = 0; t < tets.size(); ++t) {
            for (const std::uint32_t v : tets[t]) {
                if (marks[v] != 0) tets_[start_[v + 1]++] = t;
            }
        }
    }

    std::span<const std::uint32_t> of(std::uint32_t v) const {
        return std::span(tets_).subspan(start_[v], start_[v + 1] - start_[v]);
    }

private:
    std::vector<std::uint32_t> start_;  // the tets of vertex v start here, after the table is
                                        // filled
    std::vector<std::uint32_t> tets_;
};

}  // namespace dsc::generate::stuffing
