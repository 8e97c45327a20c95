// The table of file formats.
#include "dsc/io/formats.hpp"

#include <algorithm>
#include <array>

#include <dsc/text/words.hpp>

namespace dsc::io {
namespace {

constexpr std::array<Format, 9> table = {{
    {".obj", "Wavefront OBJ", true, false},
    {".ply", "PLY", true, false},
    {".off", "Geomview OFF", true, false},
    {".stl", "STL", true, false},
    {".glb", "binary glTF", true, false, true},
    {".vtu", "VTK unstructured grid", false, true},
    {".dsc", "deformable simplicial complex", false, true},
    {".msh", "Gmsh MSH 4.1", false, true, true},
    {".mesh", "MEDIT mesh", false, true, true},
}};

template <class Predicate>
std::string list(Predicate&& wanted) {
    std::string out;
    for (const Format& format : table) {
        if (!wanted(format)) continue;
        if (!out.empty()) out += ", ";
        out += format.extension;
    }
    return out;
}

}  // namespace

std::span<const Format> formats() { return table; }

const Format* find_format(const std::filesystem::path& file) {
    const std::string extension = text::lower_case_extension(file);
    const auto found = std::find_if(table.begin(), table.end(),
                                    [&](const Format& f) { return f.extension == extension; });
    return found == table.end() ? nullptr : &*found;
}

std::string surface_extensions() {
    return list([](const Format& f) { return f.surface; });
}

std::string readable_surface_extensions() {
    return list([](const Format& f) { return f.surface && !f.write_only; });
}

std::string volume_extensions() {
    return list([](const Format& f) { return f.volume; });
}

std::string readable_volume_extensions() {
    return list([](const Format& f) { return f.volume && !f.write_only; });
}

}  // namespace dsc::io
