#pragma once
// The table of file formats: who reads and writes what, by extension.

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace dsc::io {

/// One row. Clouds are read and written by the cloud module.
struct Format {
    std::string_view extension;  ///< lower case with its dot: ".obj"
    std::string_view name;       ///< for a person: "Wavefront OBJ"
    bool surface = false;        ///< read_surface and write_surface take it
    bool volume = false;         ///< write_volume takes it, and read_volume unless write_only
    bool write_only = false;     ///< other programs read it back (share/doc/formats.md)
};

/// All rows, in the order in which they are listed to a person. [parallel]
std::span<const Format> formats();

/// The row of a file's extension, upper or lower case; null when there is none. [parallel]
const Format* find_format(const std::filesystem::path& file);

/// ".obj, .ply, .off, .stl" for messages. [parallel]
std::string surface_extensions();

/// ".vtu, .dsc, .msh, .mesh" for messages: what write_volume takes. [parallel]
std::string volume_extensions();

/// ".vtu, .dsc" for messages: what read_volume takes. [parallel]
std::string readable_volume_extensions();

}  // namespace dsc::io
