// MEDIT .mesh, as mmg and other programs read it: labels are the references of the tets. Indices
// count from 1.
#include <dsc/text/numbers.hpp>

#include "io/codecs.hpp"

namespace dsc::io {

std::string encode_medit(const mesh::TetMesh& mesh) {
    // Version 2 means that the reals are doubles.
    std::string out = "MeshVersionFormatted 2\n\nDimension 3\n\nVertices\n";
    out.reserve(62 * mesh.points.size() + 32 * mesh.tets.size() + 128);
    text::append_number(out, std::uint64_t{mesh.points.size()});
    out += '\n';
    for (const Vec3& p : mesh.points) {
        for (int k = 0; k < 3; ++k) {
            text::append_number(out, p[k]);
            out += ' ';
        }
        out += "0\n";
    }
    out += "\nTetrahedra\n";
    text::append_number(out, std::uint64_t{mesh.tets.size()});
    out += '\n';
    for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
        for (const std::uint32_t v : mesh.tets[t]) {
            text::append_number(out, std::uint64_t{v} + 1);
            out += ' ';
        }
        out += std::to_string(mesh.labels[t]);
        out += '\n';
    }
    out += "\nEnd\n";
    return out;
}

}  // namespace dsc::io
