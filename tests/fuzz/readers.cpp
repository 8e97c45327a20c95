#include "readers.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <stdexcept>

#include <dsc/base/error.hpp>
#include <dsc/cloud/read.hpp>
#include <dsc/config/overrides.hpp>
#include <dsc/config/yaml.hpp>
#include <dsc/io/read.hpp>
#include <dsc/surface/measure.hpp>
#include <dsc/sweep/sweep.hpp>

#include "../unit/cloud/files.hpp"

namespace dsc::fuzz {
namespace {

void require(bool holds, const char* what) {
    if (!holds) throw std::logic_error(what);
}

std::filesystem::path as_file(const std::string& extension, std::string_view bytes) {
    static const test::Folder folder;
    return folder.write("input" + extension, bytes);
}

bool finite(const Vec3& p) { return p.allFinite(); }

void read_cloud_bytes(const std::string& extension, std::string_view bytes) {
    cloud::ReadReport report;
    const cloud::Cloud cloud = cloud::parse_cloud("input" + extension, std::string(bytes), &report);
    const std::size_t points = cloud.points.size();
    require(points > 0, "a cloud without points");
    require(std::all_of(cloud.points.begin(), cloud.points.end(), finite),
            "a point that is not finite");
    require(cloud.colours.empty() || cloud.colours.size() == points, "as many colours as points");
    require(cloud.normals.empty() || cloud.normals.size() == points, "as many normals as points");
    for (const Vec3& normal : cloud.normals) {
        const double length = normal.norm();
        require(length == 0.0 || std::abs(length - 1.0) < 1e-6,
                "a normal that is neither zero nor a unit vector");
    }
    require(report.points == points + report.dropped_non_finite, "points that nobody counted");
}

void read_surface_file(const std::string& extension, std::string_view bytes) {
    std::vector<io::DataArray> arrays;
    const surface::TriangleMesh mesh = io::read_surface(as_file(extension, bytes), &arrays);
    surface::require_sound(mesh);
    require(!mesh.faces.empty(), "a surface without faces");
    require(mesh.colours.empty() || mesh.colours.size() == mesh.points.size(),
            "as many colours as points");
    for (const io::DataArray& array : arrays)
        require(array.values.size() == mesh.points.size(), "as many values as points");
}

void read_volume_file(const std::string& extension, std::string_view bytes) {
    std::vector<io::DataArray> arrays;
    const mesh::TetMesh mesh = io::read_volume(as_file(extension, bytes), &arrays);
    require(!mesh.tets.empty(), "a volume without tets");
    require(mesh.labels.size() == mesh.tets.size(), "as many labels as tets");
    require(std::all_of(mesh.points.begin(), mesh.points.end(), finite),
            "a point that is not finite");
    for (const auto& tet : mesh.tets) {
        require(std::all_of(tet.begin(), tet.end(),
                            [&](std::uint32_t v) { return v < mesh.points.size(); }),
                "an index beyond the points");
    }
    for (const io::DataArray& array : arrays)
        require(array.values.size() == mesh.points.size(), "as many values as points");
}

/// Environment variables of the machine must not decide what an input does.
config::YamlOptions without_environment() {
    config::YamlOptions options;
    options.environment = [](const std::string&) { return std::optional<std::string>(); };
    return options;
}

void read_yaml(std::string_view bytes) {
    const config::ConfigNode root =
        config::parse_yaml(bytes, as_file(".yaml", bytes).string(), without_environment());
    const std::string text = config::to_yaml(root);
    require(config::to_yaml(config::parse_yaml(text, "again.yaml", without_environment())) == text,
            "YAML that reads back as another tree");
}

/// The first line is an experiment in flow style, the others are overrides.
void read_overrides(std::string_view bytes) {
    std::vector<std::string> lines;
    for (std::size_t begin = 0; begin <= bytes.size();) {
        const std::size_t end = std::min(bytes.find('\n', begin), bytes.size());
        lines.emplace_back(bytes.substr(begin, end - begin));
        begin = end + 1;
    }
    const config::ConfigNode root =
        config::parse_yaml(lines.front(), "base.yaml", without_environment());
    const config::ConfigNode changed =
        config::apply_overrides(root, std::span(lines).subspan(1), without_environment());
    require(!config::to_yaml(changed).empty(), "an empty text");
}

void read_sweep(std::string_view bytes) {
    const sweep::Sweep sweep =
        sweep::load_sweep(as_file(".yaml", bytes).string(), without_environment());
    require(!sweep.points.empty(), "a sweep without points");
    require(sweep.points.size() <= sweep::most_sweep_points, "a sweep with too many points");
}

constexpr std::array<Reader, 14> all = {{
    {"cloud_obj", [](std::string_view bytes) { read_cloud_bytes(".obj", bytes); }},
    {"cloud_ply", [](std::string_view bytes) { read_cloud_bytes(".ply", bytes); }},
    {"cloud_pcd", [](std::string_view bytes) { read_cloud_bytes(".pcd", bytes); }},
    {"cloud_xyz", [](std::string_view bytes) { read_cloud_bytes(".xyz", bytes); }},
    {"cloud_csv", [](std::string_view bytes) { read_cloud_bytes(".csv", bytes); }},
    {"surface_obj", [](std::string_view bytes) { read_surface_file(".obj", bytes); }},
    {"surface_ply", [](std::string_view bytes) { read_surface_file(".ply", bytes); }},
    {"surface_off", [](std::string_view bytes) { read_surface_file(".off", bytes); }},
    {"surface_stl", [](std::string_view bytes) { read_surface_file(".stl", bytes); }},
    {"volume_dsc", [](std::string_view bytes) { read_volume_file(".dsc", bytes); }},
    {"volume_vtu", [](std::string_view bytes) { read_volume_file(".vtu", bytes); }},
    {"yaml", read_yaml},
    {"overrides", read_overrides},
    {"sweep", read_sweep},
}};

}  // namespace

std::span<const Reader> readers() { return all; }

const Reader* find_reader(std::string_view name) {
    const auto found = std::find_if(all.begin(), all.end(),
                                    [name](const Reader& reader) { return reader.name == name; });
    return found != all.end() ? &*found : nullptr;
}

void require_orderly(const Reader& reader, std::string_view bytes) {
    try {
        reader.read(bytes);
    } catch (const Error& error) {
        if (error.exit_code() == ExitCode::internal)
            throw std::logic_error(std::string("an internal error: ") + error.what());
    } catch (const std::logic_error&) {
        throw;
    } catch (const std::exception& error) {
        throw std::logic_error(std::string("an exception that is not an Error: ") + error.what());
    }
}

}  // namespace dsc::fuzz
