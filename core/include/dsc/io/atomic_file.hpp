#pragma once
// Files that appear whole or not at all.

#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>

namespace dsc::io {

/// Writes `content` to a temporary file beside `file`, flushes it to the disk and renames it. A symbolic link
/// is followed; anything but a regular file is refused. On failure the temporary file is removed and IoError
/// "io.write" thrown, naming the system's reason. [step]
void write_file(const std::filesystem::path& file, std::string_view content);

/// Whether the folder is empty but for temporary files that write_file() left when its process was killed. [step]
bool nothing_but_leftovers(const std::filesystem::path& folder, std::error_code& error);

/// Removes such files from the folder, if it is one; nobody may be writing in it. [step]
void remove_leftovers(const std::filesystem::path& folder);

/// The whole file. Throws IoError "io.missing", "io.directory", "io.unreadable". [step]
std::string read_file(const std::filesystem::path& file);

}  // namespace dsc::io
