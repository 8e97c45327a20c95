// Wavefront OBJ: the surface of a decoded file, and back.
#include <algorithm>
#include <string>
#include <utility>

#include <dsc/decode/obj.hpp>
#include <dsc/text/numbers.hpp>

#include "io/codecs.hpp"

namespace dsc::io {

surface::TriangleMesh decode_obj(std::string_view content, std::string_view file) {
    decode::Obj obj = decode::decode_obj(content, file, {});
    surface::TriangleMesh mesh{std::move(obj.points), std::move(obj.faces)};
    if (obj.colours.size() != mesh.points.size()) return mesh;
    double largest = 0.0;  // fractions or bytes: only the largest number can decide
    for (const Vec3& c : obj.colours) largest = std::max(largest, c.maxCoeff());
    mesh.colours = decode::colour_bytes(obj.colours, largest > 1.0 ? 255.0 : 1.0);
    return mesh;
}

std::string encode_obj(const surface::TriangleMesh& mesh, const std::vector<Vec3>& normals) {
    std::string out;
    out.reserve(60 * mesh.points.size() + 24 * mesh.faces.size());
    for (std::size_t i = 0; i < mesh.points.size(); ++i) {
        out += 'v';
        for (int k = 0; k < 3; ++k) {
            out += ' ';
            text::append_number(out, mesh.points[i][k]);
        }
        if (!mesh.colours.empty()) {
            for (const std::uint8_t c : mesh.colours[i]) {
                out += ' ';
                text::append_number(out, c / 255.0);
            }
        }
        out += '\n';
    }
    for (const Vec3& normal : normals) {
        out += "vn";
        for (int k = 0; k < 3; ++k) {
            out += ' ';
            text::append_number(out, normal[k]);
        }
        out += '\n';
    }
    for (const auto& face : mesh.faces) {
        out += 'f';
        for (const std::uint32_t v : face) {
            out += ' ';
            text::append_number(out, std::uint64_t{v} + 1);
            if (normals.empty()) continue;
            out += "//";
            text::append_number(out, std::uint64_t{v} + 1);
        }
        out += '\n';
    }
    return out;
}

}  // namespace dsc::io
