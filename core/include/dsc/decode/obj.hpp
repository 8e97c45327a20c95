#pragma once
// Wavefront OBJ, for clouds and for surfaces.

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include <dsc/geometry/vec.hpp>
#include <dsc/text/reading.hpp>

namespace dsc::decode {

/// What an OBJ file is read for.
struct ObjOptions {
    /// True for a surface: faces are read, and a keyword that the format does not have is refused.
    /// False for a cloud: normals are read, other lines are skipped, and lines `v` must look
    /// complete, because a cut cloud has no faces that would show it.
    bool faces = true;
    /// Reads a coordinate; throws for a word that is not one.
    double (*coordinate)(std::string_view word, const text::Place& place) = text::read_coordinate;
};

/// A corner of a face that names a point and a normal, both counted from 0.
struct NormalCorner {
    std::size_t point, normal;
};

struct Obj {
    std::vector<Vec3> points;
    std::vector<Vec3> colours;                        ///< as written, of the points that have one
    std::vector<std::array<std::uint32_t, 3>> faces;  ///< polygons as fans; empty for a cloud
    std::vector<Vec3> normals;  ///< as written, in the order of the lines `vn`; empty for a surface
    std::vector<NormalCorner> corners;  ///< of a cloud: the normals may have a higher number than
                                        ///< there are
};

/// Throws IoError "io.syntax", "io.truncated", "io.index", "io.count", and what `coordinate`
/// throws. `file` is used only in messages.
Obj decode_obj(std::string_view content, std::string_view file, const ObjOptions& options);

/// Converts colours to bytes; `largest` is full brightness, and what is beyond it or below 0 is
/// clamped.
std::vector<std::array<std::uint8_t, 3>> colour_bytes(const std::vector<Vec3>& colours,
                                                      double largest);

/// Appends the fan of triangles of a polygon.
template <class Indices>
void append_fan(std::vector<std::array<std::uint32_t, 3>>& faces, const Indices& polygon) {
    for (std::size_t k = 2; k < polygon.size(); ++k)
        faces.push_back({polygon[0], polygon[k - 1], polygon[k]});
}

}  // namespace dsc::decode
