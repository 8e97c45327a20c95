// The label interface of plain arrays. It is deliberately independent of Complex, because it checks
// the kernel's results.
#include <algorithm>

#include <dsc/mesh/face_groups.hpp>
#include <dsc/surface/surface_view.hpp>

namespace dsc::surface {

namespace {

// The face of a tet, counter-clockwise seen from outside the tet, its least vertex first.
std::array<std::uint32_t, 3> outward(const mesh::TetMesh& mesh, std::uint32_t code) {
    const auto& v = mesh.tets[code >> 2U];
    // The faces of a negative tet have the opposite orientation.
    const Vec3 &a = mesh.points[v[0]], &b = mesh.points[v[1]], &c = mesh.points[v[2]],
               &d = mesh.points[v[3]];
    const bool positive = (b - a).cross(c - a).dot(d - a) > 0.0;
    std::array<std::uint32_t, 3> face{};
    for (unsigned k = 0; k < 3; ++k)
        face[k] = v[mesh::face_vertices[code & 3U][positive ? k : 2 - k]];
    std::rotate(face.begin(), std::min_element(face.begin(), face.end()), face.end());
    return face;
}

// The faces that `inner` chooses, each counter-clockwise seen from outside the tet that it returns
// (null for none), and the points that they use, in the order of the arrays.
template <class Corners, class Inner>
TriangleMesh extract(const mesh::TetMesh& mesh, std::vector<std::uint32_t>* vertex_of,
                     const Corners& corners, const Inner& inner) {
    TriangleMesh surface;
    mesh::for_each_face(mesh.points.size(), mesh.tets.size(), corners,
                        [&](const mesh::FaceKey&, std::span<const mesh::FaceUse> uses) {
                            if (const mesh::FaceUse* use = inner(uses); use != nullptr)
                                surface.faces.push_back(outward(mesh, use->code));
                        });
    std::vector<std::uint32_t> index(mesh.points.size(), mesh::none);
    for (const auto& face : surface.faces) {
        for (const auto v : face) index[v] = 0;
    }
    if (vertex_of != nullptr) vertex_of->clear();
    for (std::size_t i = 0; i < index.size(); ++i) {
        if (index[i] == mesh::none) continue;
        index[i] = static_cast<std::uint32_t>(surface.points.size());
        surface.points.push_back(mesh.points[i]);
        if (vertex_of != nullptr) vertex_of->push_back(static_cast<std::uint32_t>(i));
    }
    for (auto& face : surface.faces) {
        for (auto& v : face) v = index[v];
    }
    return surface;
}

// Per vertex, whether it belongs to tets of label 0 and to tets of other labels.
std::vector<std::uint8_t> vertices_between(const mesh::TetMesh& mesh) {
    std::vector<std::uint8_t> sides(mesh.points.size(), 0);
    for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
        const std::uint8_t side = mesh.labels[t] == 0 ? 1 : 2;
        for (const std::uint32_t v : mesh.tets[t])
            sides[v] = static_cast<std::uint8_t>(sides[v] | side);
    }
    for (std::uint8_t& side : sides) side = side == 3 ? 1 : 0;
    return sides;
}

}  // namespace

TriangleMesh extract_interface(const mesh::TetMesh& mesh, std::vector<std::uint32_t>* vertex_of) {
    const auto label = [&](const mesh::FaceUse& use) { return mesh.labels[use.code >> 2U]; };
    // Most tets lie outside and share no whole face with another label, so their faces need not be
    // sorted: neither a face between two of them nor their faces on the box belong to the
    // interface.
    const std::vector<std::uint8_t> between = vertices_between(mesh);
    const auto corners = [&](std::size_t t) {
        const auto& v = mesh.tets[t];
        const bool needed = mesh.labels[t] != 0 ||
                            between[v[0]] + between[v[1]] + between[v[2]] + between[v[3]] >= 3;
        return needed ? &v : nullptr;
    };
    return extract(mesh, vertex_of, corners,
                   [&](std::span<const mesh::FaceUse> uses) -> const mesh::FaceUse* {
                       const mesh::FaceUse* inner = &uses[0];
                       mesh::Label across = 0;  // outside the box
                       if (uses.size() > 1) {
                           if (label(uses[1]) > label(uses[0])) inner = &uses[1];
                           across = std::min(label(uses[0]), label(uses[1]));
                       }
                       return label(*inner) > across ? inner : nullptr;
                   });
}

TriangleMesh extract_phase(const mesh::TetMesh& mesh, mesh::Label phase,
                           std::vector<std::uint32_t>* vertex_of) {
    const auto label = [&](const mesh::FaceUse& use) { return mesh.labels[use.code >> 2U]; };
    const auto corners = [&](std::size_t t) {
        return mesh.labels[t] == phase ? &mesh.tets[t] : nullptr;
    };
    return extract(mesh, vertex_of, corners,
                   [&](std::span<const mesh::FaceUse> uses) -> const mesh::FaceUse* {
                       const mesh::FaceUse* inner = nullptr;
                       for (const mesh::FaceUse& use : uses) {
                           if (label(use) != phase) continue;
                           if (inner != nullptr) return nullptr;
                           inner = &use;
                       }
                       return inner;
                   });
}

}  // namespace dsc::surface
