// Binary glTF 2.0 (.glb): a surface for browsers, slides and 3-D programs. Written only.
//
// Source: Khronos Group, glTF 2.0 Specification, sections 3.6 (buffers and accessors), 3.7 (meshes)
// and 4.4 (the binary file).
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

#include <nlohmann/json.hpp>

#include <dsc/base/version.hpp>

#include "io/bytes.hpp"
#include "io/codecs.hpp"
#include "io/float_centre.hpp"
#include "io/shading_normals.hpp"

namespace dsc::io {
namespace {

using Eigen::Vector3f;
using nlohmann::json;

// Numbers that the specification assigns.
constexpr int unsigned_short = 5123, unsigned_int = 5125, single_float = 5126;
constexpr int vertex_buffer = 34962, index_buffer = 34963;

/// The vertices of the file: a point of the mesh with a normal. A point on a crease is written once
/// for each of its normals.
struct Corners {
    std::vector<std::uint32_t> point;  ///< in the mesh
    std::vector<Vector3f> normal;      ///< unit
    std::vector<std::uint32_t> index;  ///< three per face
};

Corners split_at_creases(const surface::TriangleMesh& mesh, const std::vector<Vector3f>& points) {
    // Within this angle (1 degree) two normals of a point are the same: they differ by rounding.
    constexpr float same_cosine = 0.99985F;
    const auto normals = shading_normals(points, mesh.faces);
    Corners out;
    std::vector<std::vector<std::uint32_t>> copies(points.size());
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
        for (std::size_t k = 0; k < 3; ++k) {
            auto& of_point = copies[mesh.faces[f][k]];
            const Vector3f& normal = normals[f][k];
            auto found = std::find_if(of_point.begin(), of_point.end(), [&](std::uint32_t copy) {
                return out.normal[copy].dot(normal) > same_cosine;
            });
            if (found == of_point.end()) {
                of_point.push_back(static_cast<std::uint32_t>(out.point.size()));
                out.point.push_back(mesh.faces[f][k]);
                out.normal.push_back(normal);
                found = std::prev(of_point.end());
            }
            out.index.push_back(*found);
        }
    }
    return out;
}

/// The linear intensity of an sRGB byte, as 16 bits: glTF multiplies colours in linear light.
std::uint16_t linear_intensity(std::uint8_t byte) {
    const double c = byte / 255.0;
    const double linear = c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
    return static_cast<std::uint16_t>(std::lround(linear * 65535.0));
}

/// Collects arrays in the buffer, and describes them.
class Buffer {
public:
    /// Appends numbers; each view starts at a multiple of 4. Returns the accessor's number.
    template <class T>
    std::size_t add(std::span<const T> values, int component, const char* type, std::size_t count,
                    int target) {
        const std::size_t start = bytes_.size();
        for (const T value : values) append_bytes(bytes_, value);
        views_.push_back({{"buffer", 0},
                          {"byteOffset", start},
                          {"byteLength", bytes_.size() - start},
                          {"target", target}});
        bytes_.resize((bytes_.size() + 3) / 4 * 4, '\0');
        accessors_.push_back({{"bufferView", views_.size() - 1},
                              {"componentType", component},
                              {"type", type},
                              {"count", count}});
        return accessors_.size() - 1;
    }

    json& accessor(std::size_t number) { return accessors_[number]; }
    const json& views() const { return views_; }
    const json& accessors() const { return accessors_; }
    const std::string& bytes() const { return bytes_; }

private:
    std::string bytes_;
    json views_ = json::array();
    json accessors_ = json::array();
};

std::size_t add_vectors(Buffer& buffer, const std::vector<Vector3f>& vectors) {
    std::vector<float> numbers;
    numbers.reserve(3 * vectors.size());
    for (const Vector3f& v : vectors) numbers.insert(numbers.end(), {v.x(), v.y(), v.z()});
    return buffer.add(std::span<const float>(numbers), single_float, "VEC3", vectors.size(),
                      vertex_buffer);
}

std::size_t add_positions(Buffer& buffer, const Corners& corners,
                          const std::vector<Vector3f>& points) {
    std::vector<Vector3f> positions;
    positions.reserve(corners.point.size());
    Vector3f low = Vector3f::Constant(std::numeric_limits<float>::infinity()), high = -low;
    for (const std::uint32_t p : corners.point) {
        positions.push_back(points[p]);
        low = low.cwiseMin(points[p]);
        high = high.cwiseMax(points[p]);
    }
    const std::size_t accessor = add_vectors(buffer, positions);
    buffer.accessor(accessor)["min"] = {low.x(), low.y(), low.z()};
    buffer.accessor(accessor)["max"] = {high.x(), high.y(), high.z()};
    return accessor;
}

std::size_t add_colours(Buffer& buffer, const Corners& corners, const surface::TriangleMesh& mesh) {
    std::vector<std::uint16_t> numbers;
    numbers.reserve(4 * corners.point.size());
    for (const std::uint32_t p : corners.point) {
        for (const std::uint8_t c : mesh.colours[p]) numbers.push_back(linear_intensity(c));
        numbers.push_back(65535);
    }
    const std::size_t accessor = buffer.add(std::span<const std::uint16_t>(numbers), unsigned_short,
                                            "VEC4", corners.point.size(), vertex_buffer);
    buffer.accessor(accessor)["normalized"] = true;
    return accessor;
}

/// Whether the format can store the array: its floats must be finite.
bool storable(const DataArray& array) {
    return std::all_of(array.values.begin(), array.values.end(),
                       [](double v) { return std::isfinite(static_cast<float>(v)); });
}

/// Names of an application's own attributes start with an underscore.
std::string attribute_name(const std::string& name) {
    std::string out = "_";
    for (const char c : name) out += static_cast<char>(c >= 'a' && c <= 'z' ? c - 'a' + 'A' : c);
    return out;
}

std::size_t add_array(Buffer& buffer, const Corners& corners, const DataArray& array) {
    std::vector<float> numbers;
    numbers.reserve(corners.point.size());
    for (const std::uint32_t p : corners.point)
        numbers.push_back(static_cast<float>(array.values[p]));
    return buffer.add(std::span<const float>(numbers), single_float, "SCALAR", numbers.size(),
                      vertex_buffer);
}

json primitive_of(Buffer& buffer, const surface::TriangleMesh& mesh,
                  const std::vector<DataArray>& arrays, const Vec3& centre) {
    std::vector<Vector3f> points;
    points.reserve(mesh.points.size());
    for (const Vec3& p : mesh.points) points.emplace_back((p - centre).cast<float>());
    const Corners corners = split_at_creases(mesh, points);
    json attributes = {{"POSITION", add_positions(buffer, corners, points)},
                       {"NORMAL", add_vectors(buffer, corners.normal)}};
    if (!mesh.colours.empty()) attributes["COLOR_0"] = add_colours(buffer, corners, mesh);
    for (const DataArray& array : arrays) {
        if (storable(array))
            attributes[attribute_name(array.name)] = add_array(buffer, corners, array);
    }
    const std::size_t indices =
        buffer.add(std::span<const std::uint32_t>(corners.index), unsigned_int, "SCALAR",
                   corners.index.size(), index_buffer);
    return {{"attributes", attributes}, {"indices", indices}, {"material", 0}, {"mode", 4}};
}

void append_chunk(std::string& out, std::string_view type, std::string content, char fill) {
    content.resize((content.size() + 3) / 4 * 4, fill);
    append_bytes(out, static_cast<std::uint32_t>(content.size()));
    out += type;
    out += content;
}

}  // namespace

std::string encode_glb(const surface::TriangleMesh& mesh, const std::vector<DataArray>& points) {
    const Vec3 centre = centre_to_subtract(mesh);
    Buffer buffer;
    json node = {{"name", "surface"}, {"mesh", 0}};
    if (centre != Vec3::Zero()) node["translation"] = {centre.x(), centre.y(), centre.z()};
    const json primitive = primitive_of(buffer, mesh, points, centre);
    const bool coloured = !mesh.colours.empty();
    const json base = coloured ? json{1, 1, 1, 1} : json{0.7, 0.7, 0.7, 1};
    const json document = {
        {"asset", {{"version", "2.0"}, {"generator", "dsc " DSC_VERSION}}},
        {"scene", 0},
        {"scenes", {{{"nodes", {0}}}}},
        {"nodes", json::array({node})},
        {"meshes", json::array({{{"primitives", json::array({primitive})}}})},
        {"materials",
         json::array(
             {{{"doubleSided", true},
               {"pbrMetallicRoughness",
                {{"baseColorFactor", base}, {"metallicFactor", 0}, {"roughnessFactor", 0.8}}}}})},
        {"buffers", json::array({{{"byteLength", buffer.bytes().size()}}})},
        {"bufferViews", buffer.views()},
        {"accessors", buffer.accessors()}};
    std::string chunks;
    append_chunk(chunks, "JSON", document.dump(), ' ');
    append_chunk(chunks, std::string_view("BIN\0", 4), buffer.bytes(), '\0');
    std::string out = "glTF";
    append_bytes(out, std::uint32_t{2});
    append_bytes(out, static_cast<std::uint32_t>(12 + chunks.size()));
    return out + chunks;
}

}  // namespace dsc::io
