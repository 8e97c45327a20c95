// The label interface of plain arrays. Deliberately independent of Complex: it judges what the kernel wrote.
#include <dsc/surface/surface_view.hpp>

#include <algorithm>

namespace dsc::surface {

TriangleMesh extract_interface(const mesh::TetMesh& mesh, std::vector<std::uint32_t>* vertex_of) {
    struct Face {
        std::array<std::uint32_t, 3> key;
        std::array<std::uint32_t, 3> out;  // counter-clockwise seen from outside its tet
        mesh::Label label;
    };
    std::vector<Face> faces;
    faces.reserve(4 * mesh.tets.size());
    for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
        const auto& v = mesh.tets[t];
        // A negative tet sees its faces the other way round.
        const Vec3 &a = mesh.points[v[0]], &b = mesh.points[v[1]], &c = mesh.points[v[2]], &d = mesh.points[v[3]];
        const bool positive = (b - a).cross(c - a).dot(d - a) > 0.0;
        for (unsigned f = 0; f < 4; ++f) {
            Face face{{}, {}, mesh.labels[t]};
            for (unsigned k = 0; k < 3; ++k) face.out[k] = v[mesh::face_vertices[f][positive ? k : 2 - k]];
            std::rotate(face.out.begin(), std::min_element(face.out.begin(), face.out.end()), face.out.end());
            face.key = face.out;
            if (face.key[1] > face.key[2]) std::swap(face.key[1], face.key[2]);
            faces.push_back(face);
        }
    }
    std::sort(faces.begin(), faces.end(), [](const Face& a, const Face& b) {
        return a.key != b.key ? a.key < b.key : a.label > b.label;
    });
    TriangleMesh surface;
    for (std::size_t i = 0; i < faces.size();) {
        std::size_t j = i + 1;
        while (j < faces.size() && faces[j].key == faces[i].key) ++j;
        const mesh::Label across = j - i > 1 ? faces[i + 1].label : 0;
        if (faces[i].label > across) surface.faces.push_back(faces[i].out);
        i = j;
    }
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
