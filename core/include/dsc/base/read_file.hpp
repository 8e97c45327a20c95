#pragma once
// Reads a complete file.

#include <filesystem>
#include <string>

namespace dsc {

/// The bytes of a regular file. Throws IoError "io.missing", "io.directory", "io.unreadable".
/// [parallel]
std::string read_file(const std::filesystem::path& file);

}  // namespace dsc
