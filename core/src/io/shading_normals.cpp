// Normals for shading.
#include "io/shading_normals.hpp"

#include <Eigen/Geometry>

namespace dsc::io {

using Eigen::Vector3f;

std::vector<std::array<Vector3f, 3>> shading_normals(
    const std::vector<Vector3f>& points, const std::vector<std::array<std::uint32_t, 3>>& faces) {
    constexpr float crease_cosine = 0.766F;
    // Faces of point v: around[first[v] .. first[v + 1]).
    std::vector<std::uint32_t> first(points.size() + 1, 0);
    for (const auto& face : faces) {
        for (const std::uint32_t v : face) ++first[v + 1];
    }
    for (std::size_t v = 0; v < points.size(); ++v) first[v + 1] += first[v];
    std::vector<std::uint32_t> around(3 * faces.size()), next(first.begin(), first.end() - 1);
    std::vector<Vector3f> weighted, unit;
    weighted.reserve(faces.size());
    unit.reserve(faces.size());
    for (std::uint32_t f = 0; f < faces.size(); ++f) {
        const auto& [a, b, c] = faces[f];
        for (const std::uint32_t v : faces[f]) around[next[v]++] = f;
        weighted.push_back((points[b] - points[a]).cross(points[c] - points[a]));
        unit.push_back(weighted.back().normalized());
    }
    std::vector<std::array<Vector3f, 3>> out(faces.size());
    for (std::size_t f = 0; f < faces.size(); ++f) {
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t v = faces[f][k];
            Vector3f sum = weighted[f];
            for (std::uint32_t i = first[v]; i < first[v + 1]; ++i) {
                if (around[i] != f && unit[around[i]].dot(unit[f]) > crease_cosine)
                    sum += weighted[around[i]];
            }
            const float length = sum.norm();
            out[f][k] = length > 0.0F ? Vector3f(sum / length) : Vector3f(0, 0, 1);
        }
    }
    return out;
}

}  // namespace dsc::io
