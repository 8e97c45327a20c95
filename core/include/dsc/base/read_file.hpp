#pragma once
// Reads a file as a whole.

#include <filesystem>
#include <string>

namespace dsc {

/// The bytes of a regular file. Throws IoError "io.missing", "io.directory", "io.unreadable". [parallel]
std::string read_file(const std::filesystem::path& file);

}  // namespace dsc
