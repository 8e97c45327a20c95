#pragma once
// Files that appear whole or not at all.

#include <filesystem>
#include <string>
#include <string_view>

namespace dsc::io {

/// Writes `content` to a temporary file beside `file`, flushes it to the disk and renames it. A symbolic link
/// is followed; anything but a regular file is refused. On failure the temporary file is removed and IoError
/// "io.write" thrown, naming the system's reason. [step]
void write_file(const std::filesystem::path& file, std::string_view content);

/// The whole file. Throws IoError "io.missing", "io.directory", "io.unreadable". [step]
std::string read_file(const std::filesystem::path& file);

}  // namespace dsc::io
