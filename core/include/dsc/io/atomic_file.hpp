#pragma once
// Files that appear whole or not at all.

#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>

namespace dsc::io {

/// dsc::replace_file(): whole or not at all, attributes and links are kept. Throws IoError "io.write". [step]
void write_file(const std::filesystem::path& file, std::string_view content);

/// Whether the folder is empty but for temporary files that write_file() left when its process was killed, and for a file
/// `but`. [step]
bool nothing_but_leftovers(const std::filesystem::path& folder, std::error_code& error, std::string_view but = {});

/// Removes such files from the folder, if it is one; nobody may be writing in it. [step]
void remove_leftovers(const std::filesystem::path& folder);

}  // namespace dsc::io
