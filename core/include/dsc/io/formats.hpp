#pragma once
// The table of file formats: which formats can be read and written, by extension.

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace dsc::io {

/// One row. Clouds are read and written by the cloud module.
struct Format {
    std::string_view extension;  ///< lower case with its dot: ".obj"
    std::string_view name;       ///< for a person: "Wavefront OBJ"
    bool surface = false;        ///< write_surface supports it, and read_surface unless write_only
    bool volume = false;         ///< write_volume supports it, and read_volume unless write_only
    bool write_only = false;     ///< only other programs read it (share/doc/formats.md)
};

/// All rows, in the order in which a person sees them. [parallel]
std::span<const Format> formats();

/// The row of a file's extension, in upper or lower case; null if there is none. [parallel]
const Format* find_format(const std::filesystem::path& file);

/// ".obj, .ply, .off, .stl, .glb" for messages: the extensions that write_surface accepts.
/// [parallel]
std::string surface_extensions();

/// ".obj, .ply, .off, .stl" for messages: the extensions that read_surface accepts. [parallel]
std::string readable_surface_extensions();

/// ".vtu, .dsc, .msh, .mesh" for messages: the extensions that write_volume accepts. [parallel]
std::string volume_extensions();

/// ".vtu, .dsc" for messages: the extensions that read_volume accepts. [parallel]
std::string readable_volume_extensions();

}  // namespace dsc::io
