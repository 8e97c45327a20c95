// Reads surfaces and volumes: chooses the format, checks that the file is not empty.
#include "dsc/io/read.hpp"

#include <dsc/base/byte_order_mark.hpp>
#include <dsc/base/read_file.hpp>
#include <dsc/io/formats.hpp>
#include <dsc/text/reading.hpp>
#include <dsc/text/words.hpp>

#include "io/codecs.hpp"
#include "io/vtk_backend.hpp"

namespace dsc::io {
namespace {

[[noreturn]] void unknown_format(const std::string& file, const std::string& what,
                                 const std::string& accepted) {
    text::fail("io.format", {file, 0}, "the extension does not belong to a " + what + " file",
               "give it one of " + accepted + " or convert the file");
}

/// Refuses a format that only other programs read.
void require_readable(const Format& format, const std::string& file, const std::string& remedy) {
    if (!format.write_only) return;
    text::fail("io.write_only", {file, 0},
               std::string(format.name) + " files can be written but not read", remedy);
}

/// The content of a file of a known format, without a byte order mark; refuses an empty file.
std::string require_content(const std::filesystem::path& file) {
    std::string content = read_file(file);
    if (content.find_first_not_of(" \t\r\n") == std::string::npos) {
        text::fail("io.empty", {file.string(), 0}, "the file is empty", "copy or export it again");
    }
    // In a binary STL these bytes may be part of the header.
    if (find_format(file)->extension == ".stl") return content;
    if (has_wide_byte_order_mark(content)) {
        text::fail("io.format", {file.string(), 0}, std::string(wide_text_cause),
                   std::string(wide_text_remedy));
    }
    content.erase(0, content.size() - without_byte_order_mark(content).size());
    return content;
}

}  // namespace

surface::TriangleMesh read_surface(const std::filesystem::path& file,
                                   std::vector<DataArray>* points) {
    if (points != nullptr) points->clear();
    const std::string name = file.string();
    const Format* format = find_format(file);
    if (format == nullptr || !format->surface)
        unknown_format(name, "surface", readable_surface_extensions());
    require_readable(
        *format, name,
        "convert it with Blender or trimesh to one of " + readable_surface_extensions());
    const std::string content = require_content(file);
    surface::TriangleMesh mesh = format->extension == ".obj"   ? decode_obj(content, name)
                                 : format->extension == ".ply" ? decode_ply(content, name, points)
                                 : format->extension == ".off" ? decode_off(content, name)
                                                               : decode_stl(content, name);
    if (mesh.faces.empty()) {
        text::fail("io.no_faces", {name, 0},
                   "contains " + text::counted(mesh.points.size(), "point") + " and no faces",
                   "a surface is needed here; a cloud must be reconstructed first");
    }
    return mesh;
}

mesh::TetMesh read_volume(const std::filesystem::path& file, std::vector<DataArray>* points) {
    if (points != nullptr) points->clear();
    const std::string name = file.string();
    const Format* format = find_format(file);
    if (format == nullptr || !format->volume)
        unknown_format(name, "volume", readable_volume_extensions());
    require_readable(*format, name,
                     "convert it with meshio to one of " + readable_volume_extensions() +
                         ", as share/doc/formats.md shows");
    const std::string content = require_content(file);
    mesh::TetMesh mesh = format->extension == ".dsc"
                             ? decode_dsc(content, name)
                             : vtk_backend().decode_vtu(content, name, points);
    if (mesh.tets.empty()) {
        text::fail("io.no_tets", {name, 0},
                   "no tets among " + text::counted(mesh.points.size(), "point"),
                   "a volume is needed here; export the file again");
    }
    return mesh;
}

}  // namespace dsc::io
