#pragma once
// Files that are complete or absent.

#include <filesystem>
#include <string_view>
#include <system_error>

namespace dsc::io {

/// dsc::replace_file(): the file is complete or unchanged; attributes and links are kept. Throws
/// IoError "io.write". [step]
void write_file(const std::filesystem::path& file, std::string_view content);

/// Whether the folder is empty, apart from the file `but` and from temporary files that
/// write_file() left when its process was killed. [step]
bool nothing_but_leftovers(const std::filesystem::path& folder, std::error_code& error,
                           std::string_view but = {});

/// Removes these temporary files if `folder` is a folder. No process may be writing into it. [step]
void remove_leftovers(const std::filesystem::path& folder);

}  // namespace dsc::io
