// Points, colours and normals of a cloud in OBJ.
#include <dsc/decode/obj.hpp>

#include "attributes.hpp"
#include "formats.hpp"

namespace dsc::cloud {
namespace {

/// Per point: the mean of the normals from its corners; or its own normal if there are as many
/// normals as points. A normal that all corners repeat keeps its bits.
std::vector<Vec3> normals_of_points(const decode::Obj& obj) {
    std::vector<Vec3> normals;
    for (const Vec3& normal : obj.normals) normals.push_back(direction_of(normal));
    if (obj.corners.empty())
        return normals.size() == obj.points.size() ? normals : std::vector<Vec3>();
    std::vector<Vec3> out(obj.points.size(), Vec3::Zero());
    for (const auto& [point, normal] : obj.corners)
        if (point < out.size() && normal < normals.size() && out[point] != normals[normal])
            out[point] += normals[normal];
    for (Vec3& normal : out) normal = direction_of(normal);
    return out;
}

}  // namespace

Cloud read_obj(const std::string& file, std::string_view text, std::vector<std::string>& names) {
    decode::Obj obj = decode::decode_obj(text, file, {.faces = false, .coordinate = coordinate});
    if (obj.points.empty()) no_points(file, "a cloud in OBJ has a line 'v x y z' for each point");
    Cloud cloud;
    // Fractions or bytes: only the largest number can decide.
    if (obj.colours.size() == obj.points.size()) cloud.colours = colours_from(obj.colours, false);
    cloud.normals = normals_of_points(obj);
    cloud.points = std::move(obj.points);
    keep_whole_normals(cloud);
    names = {"x", "y", "z"};
    if (!obj.colours.empty()) names.insert(names.end(), {"r", "g", "b"});
    if (!obj.normals.empty()) names.insert(names.end(), {"nx", "ny", "nz"});
    return cloud;
}

}  // namespace dsc::cloud
