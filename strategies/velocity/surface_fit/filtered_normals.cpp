#include "filtered_normals.hpp"

#include <cmath>

namespace dsc::strategies::fit {
namespace {

constexpr std::size_t normal_block = 512;  // faces

/// The factors in the weights of a face's neighbours.
struct FilterFace {
    Vec3 centroid;
    double space;  // 1 / 2 length^2
};

bool has_corner(const std::array<std::uint32_t, 3>& face, std::uint32_t v) {
    return face[0] == v || face[1] == v || face[2] == v;
}

// Each face around the corners once: faces of the second and third corner only if they do not
// contain an earlier corner.
Vec3 average_normal(const surface::SurfaceView& view, const std::vector<FilterFace>& faces,
                    const std::vector<Vec3>& normals, std::size_t f, double range) {
    const auto& corners = view.faces[f];
    const FilterFace face = faces[f];
    const Vec3 normal = normals[f];
    Vec3 sum = Vec3::Zero();
    for (std::size_t k = 0; k < 3; ++k) {
        for (const std::uint32_t g : view.faces_of(corners[k])) {
            const auto& other = view.faces[g];
            if ((k > 0 && has_corner(other, corners[0])) ||
                (k > 1 && has_corner(other, corners[1])))
                continue;
            const double apart = face.space * (faces[g].centroid - face.centroid).squaredNorm() +
                                 range * (normals[g] - normal).squaredNorm();
            sum += view.face_areas[g] * std::exp(-apart) * normals[g];
        }
    }
    const double length = sum.norm();
    return length > 0.0 ? Vec3(sum / length) : normal;
}

}  // namespace

void filter_normals(const surface::SurfaceView& view, unsigned rounds, double range,
                    std::span<const double> lengths, Workers* workers,
                    std::vector<Vec3>& filtered) {
    filtered = view.face_normals;
    if (!(range > 0.0)) return;
    std::vector<FilterFace> faces(view.face_count());
    for_blocks(workers, view.face_count(), normal_block, [&](std::size_t begin, std::size_t end) {
        for (std::size_t f = begin; f < end; ++f) {
            const auto& [a, b, c] = view.faces[f];
            const double length = (lengths[a] + lengths[b] + lengths[c]) / 3.0;
            faces[f] = {(view.positions[a] + view.positions[b] + view.positions[c]) / 3.0,
                        length > 0.0 ? 0.5 / (length * length) : 0.0};
        }
    });
    std::vector<Vec3> before(view.face_count());
    for (unsigned round = 0; round < rounds; ++round) {
        std::swap(before, filtered);
        for_blocks(
            workers, view.face_count(), normal_block, [&](std::size_t begin, std::size_t end) {
                for (std::size_t f = begin; f < end; ++f)
                    filtered[f] = average_normal(view, faces, before, f, 0.5 / (range * range));
            });
    }
}

}  // namespace dsc::strategies::fit
