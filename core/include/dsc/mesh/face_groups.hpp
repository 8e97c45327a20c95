#pragma once
// The faces of a tet mesh in plain arrays, each with the tets that use it.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <dsc/mesh/complex.hpp>

namespace dsc::mesh {

/// A face's vertices in ascending order.
using FaceKey = std::array<std::uint32_t, 3>;

/// A face as one of its tets sees it.
struct FaceUse {
    std::uint32_t second;      ///< of the key
    std::uint32_t third : 31;  ///< of the key
    std::uint32_t odd : 1;     ///< the key is an odd permutation of the vertices in face_vertices
    std::uint32_t code;        ///< 4 * tet + face
};

/// All faces of a tet mesh, grouped by their first vertex; 48 bytes per tet.
struct FaceTable {
    std::vector<std::size_t> start;  ///< uses of the faces with first vertex v: uses[start[v] ..
                                     ///< start[v + 1])
    std::vector<FaceUse> uses;
};

/// Groups the faces by their first vertex, unsorted. `corners(t)` points to the four vertices of
/// tet t, all below `points`, or is null if the tet has no faces. There are `tets` tets.
template <class Corners>
FaceTable deal_faces(std::size_t points, std::size_t tets, const Corners& corners) {
    FaceTable table;
    std::vector<std::size_t>& start = table.start;
    start.assign(points + 2, 0);  // number of uses with first vertex v, stored at v + 1 while the
                                  // faces are grouped
    for (std::size_t t = 0; t < tets; ++t) {
        const std::array<std::uint32_t, 4>* v = corners(t);
        if (v == nullptr) continue;
        for (const auto& face : face_vertices)
            ++start[std::min({(*v)[face[0]], (*v)[face[1]], (*v)[face[2]]}) + 2];
    }
    for (std::size_t i = 2; i < start.size(); ++i) start[i] += start[i - 1];
    table.uses.resize(start.back());
    for (std::size_t t = 0; t < tets; ++t) {
        const std::array<std::uint32_t, 4>* v = corners(t);
        if (v == nullptr) continue;
        for (unsigned f = 0; f < 4; ++f) {
            FaceKey key{};
            for (unsigned k = 0; k < 3; ++k) key[k] = (*v)[face_vertices[f][k]];
            bool odd = false;
            const auto exchange = [&](unsigned i, unsigned j) {
                if (key[i] <= key[j]) return;
                std::swap(key[i], key[j]);
                odd = !odd;
            };
            exchange(0, 1);
            exchange(1, 2);
            exchange(0, 1);
            table.uses[start[key[0] + 1]++] = {key[1], key[2] & 0x7fffffffU, odd ? 1U : 0U,
                                               static_cast<std::uint32_t>(4 * t + f)};
        }
    }
    return table;
}

/// Calls visit(FaceKey, std::span<const FaceUse>) once for every face whose first vertex is in
/// [begin, end): the faces in the order of the keys, the uses in the order of their codes. Ranges
/// that do not overlap may be visited at the same time. [parallel]
template <class Visit>
void visit_faces(FaceTable& table, std::size_t begin, std::size_t end, const Visit& visit) {
    for (std::size_t first = begin; first < end; ++first) {
        const auto group =
            std::span(table.uses)
                .subspan(table.start[first], table.start[first + 1] - table.start[first]);
        std::sort(group.begin(), group.end(), [](const FaceUse& a, const FaceUse& b) {
            const auto ends = [](const FaceUse& use) {
                return std::uint64_t{use.second} << 32U | use.third;
            };
            return ends(a) != ends(b) ? ends(a) < ends(b) : a.code < b.code;
        });
        for (std::size_t from = 0, to = 0; from < group.size(); from = to) {
            to = from + 1;
            while (to < group.size() && group[to].second == group[from].second &&
                   group[to].third == group[from].third)
                ++to;
            visit(FaceKey{static_cast<std::uint32_t>(first), group[from].second, group[from].third},
                  std::span<const FaceUse>(group.subspan(from, to - from)));
        }
    }
}

/// Calls visit() as above for every face of the mesh, `corners` as in deal_faces().
template <class Corners, class Visit>
void for_each_face(std::size_t points, std::size_t tets, const Corners& corners,
                   const Visit& visit) {
    FaceTable table = deal_faces(points, tets, corners);
    visit_faces(table, 0, points, visit);
}

}  // namespace dsc::mesh
