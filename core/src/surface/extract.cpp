// The label interface of plain arrays. Deliberately independent of Complex: it judges what the kernel wrote.
#include <dsc/surface/surface_view.hpp>

#include <algorithm>

#include <dsc/mesh/face_groups.hpp>

namespace dsc::surface {

namespace {

// The face of a tet, counter-clockwise seen from outside it, its least vertex first.
std::array<std::uint32_t, 3> outward(const mesh::TetMesh& mesh, std::uint32_t code) {
    const auto& v = mesh.tets[code >> 2U];
    // A negative tet sees its faces the other way round.
    const Vec3 &a = mesh.points[v[0]], &b = mesh.points[v[1]], &c = mesh.points[v[2]], &d = mesh.points[v[3]];
    const bool positive = (b - a).cross(c - a).dot(d - a) > 0.0;
    std::array<std::uint32_t, 3> face{};
    for (unsigned k = 0; k < 3; ++k) face[k] = v[mesh::face_vertices[code & 3U][positive ? k : 2 - k]];
    std::rotate(face.begin(), std::min_element(face.begin(), face.end()), face.end());
    return face;
}

}  // namespace

TriangleMesh extract_interface(const mesh::TetMesh& mesh, std::vector<std::uint32_t>* vertex_of) {
    TriangleMesh surface;
    const auto corners = [&](std::size_t t) { return &mesh.tets[t]; };
    mesh::for_each_face(mesh.points.size(), mesh.tets.size(), corners, [&](const mesh::FaceKey&, std::span<const mesh::FaceUse> uses) {
        const auto label = [&](const mesh::FaceUse& use) { return mesh.labels[use.code >> 2U]; };
        const mesh::FaceUse* inner = &uses[0];
        mesh::Label across = 0;  // outside the box
        if (uses.size() > 1) {
            if (label(uses[1]) > label(uses[0])) inner = &uses[1];
            across = std::min(label(uses[0]), label(uses[1]));
        }
        if (label(*inner) > across) surface.faces.push_back(outward(mesh, inner->code));
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

}  // namespace dsc::surface
