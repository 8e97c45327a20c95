// Measures surfaces and volumes.
#include "dsc/run/measure.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include <dsc/geometry/predicates.hpp>
#include <dsc/geometry/quality.hpp>
#include <dsc/mesh/complex.hpp>
#include <dsc/mesh/face_groups.hpp>
#include <dsc/surface/surface_view.hpp>

namespace dsc::run {
namespace {

using TetCorners = std::array<std::uint32_t, 4>;

bool sound(const mesh::TetMesh& mesh, const TetCorners& tet) {
    for (std::size_t i = 0; i < 4; ++i) {
        if (tet[i] >= mesh.points.size() || !mesh.points[tet[i]].allFinite()) return false;
        for (std::size_t j = 0; j < i; ++j) {
            if (tet[i] == tet[j]) return false;
        }
    }
    return true;
}

/// Up to two labels at a vertex, and whether there is a third.
class LabelsAt {
public:
    void meet(mesh::Label label) {
        for (mesh::Label& known : known_) {
            if (known == unknown) known = label;
            if (known == label) return;
        }
        third_ = true;
    }
    bool junction() const { return third_; }

private:
    static constexpr mesh::Label unknown = -1;
    std::array<mesh::Label, 2> known_ = {unknown, unknown};
    bool third_ = false;
};

void count_junctions(const mesh::TetMesh& mesh, const std::vector<char>& valid,
                     VolumeMeasure& measure) {
    if (measure.label_tets.size() < 2) return;
    std::vector<LabelsAt> at(mesh.points.size());
    for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
        if (valid[t] == 0) continue;
        for (const std::uint32_t v : mesh.tets[t]) at[v].meet(mesh.labels[t]);
    }
    const auto corners = [&](std::size_t t) { return valid[t] != 0 ? &mesh.tets[t] : nullptr; };
    mesh::for_each_face(mesh.points.size(), mesh.tets.size(), corners,
                        [&](const mesh::FaceKey& key, std::span<const mesh::FaceUse> uses) {
                            if (uses.size() > 1) return;
                            for (const std::uint32_t v : key) at[v].meet(0);
                        });
    measure.junction_vertices = static_cast<std::size_t>(std::count_if(
        at.begin(), at.end(), [](const LabelsAt& labels) { return labels.junction(); }));
}

/// Counts faces by the number and the sides of their tets.
void count_faces(const mesh::TetMesh& mesh, const std::vector<char>& valid,
                 VolumeMeasure& measure) {
    const auto corners = [&](std::size_t t) { return valid[t] ? &mesh.tets[t] : nullptr; };
    const auto count = [&](const mesh::FaceKey& key, std::span<const mesh::FaceUse> uses) {
        if (uses.size() == 1) {
            ++measure.boundary_faces;
        } else if (uses.size() > 2) {
            ++measure.overused_faces;
        } else {
            const auto side = [&](const mesh::FaceUse& use) {
                const std::uint32_t apex = mesh.tets[use.code >> 2U][use.code & 3U];
                return geometry::orient3d(mesh.points[key[0]], mesh.points[key[1]],
                                          mesh.points[key[2]], mesh.points[apex]);
            };
            if (side(uses[0]) * side(uses[1]) >= 0) ++measure.folded_faces;
        }
    };
    mesh::for_each_face(mesh.points.size(), mesh.tets.size(), corners, count);
}

}  // namespace

SurfaceMeasure measure(const surface::TriangleMesh& mesh, Workers* workers) {
    SurfaceMeasure result;
    result.report = surface::analyse(mesh);
    if (result.report.invalid_faces == 0)
        result.intersections = surface::self_intersections(mesh, 16, workers);
    return result;
}

bool VolumeMeasure::fills_box() const {
    return box_volume > 0.0 && std::abs(volume - box_volume) <= 1e-9 * box_volume;
}

VolumeMeasure measure(const mesh::TetMesh& mesh, Workers* workers, bool with_interface) {
    VolumeMeasure result;
    result.points = mesh.points.size();
    result.tets = mesh.tets.size();
    std::vector<char> used(mesh.points.size(), 0);
    std::vector<char> valid(mesh.tets.size(), 0);
    double quality_sum = 0.0;
    result.min_quality = mesh.tets.empty() ? 0.0 : 1.0;
    for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
        const TetCorners& tet = mesh.tets[t];
        if (!sound(mesh, tet)) {
            ++result.invalid_tets;
            continue;
        }
        valid[t] = 1;
        const auto& [a, b, c, d] = tet;
        const Vec3 &pa = mesh.points[a], &pb = mesh.points[b], &pc = mesh.points[c],
                   &pd = mesh.points[d];
        for (const std::uint32_t v : tet) {
            used[v] = 1;
            result.box.extend(mesh.points[v]);
        }
        if (geometry::orient3d(pa, pb, pc, pd) != 1) ++result.inverted_tets;
        const double quality = geometry::tet_quality(pa, pb, pc, pd);
        const double volume = geometry::tet_volume(pa, pb, pc, pd);
        result.min_quality = std::min(result.min_quality, quality);
        quality_sum += quality;
        result.volume += volume;
        if (t < mesh.labels.size()) {
            ++result.label_tets[mesh.labels[t]];
            result.label_volumes[mesh.labels[t]] += volume;
        }
    }
    result.unused_points = static_cast<std::size_t>(std::count(used.begin(), used.end(), 0));
    const std::size_t counted = result.tets - result.invalid_tets;
    result.mean_quality = counted == 0 ? 0.0 : quality_sum / static_cast<double>(counted);
    result.box_volume = result.box.empty() ? 0.0 : result.box.size().prod();
    count_faces(mesh, valid, result);
    if (mesh.labels.size() == mesh.tets.size()) count_junctions(mesh, valid, result);
    if (with_interface && result.adjacency_valid() && mesh.labels.size() == mesh.tets.size()) {
        result.interface = surface::extract_interface(mesh);
        result.interface_measure = measure(result.interface, workers);
    }
    return result;
}

bool identical(const surface::TriangleMesh& a, const surface::TriangleMesh& b) {
    if (a.points.size() != b.points.size() || a.faces != b.faces) return false;
    for (std::size_t i = 0; i < a.points.size(); ++i) {
        if (std::memcmp(a.points[i].data(), b.points[i].data(), 3 * sizeof(double)) != 0)
            return false;
    }
    return true;
}

}  // namespace dsc::run
