#pragma once
// SHA-256, in the form that sha256sum prints.

#include <filesystem>
#include <string>
#include <string_view>

namespace dsc::run {

/// 64 lower-case hex digits. [parallel]
std::string sha256(std::string_view bytes);

/// The same for a file's content. Throws IoError "io.missing", "io.unreadable". [parallel]
std::string sha256_of_file(const std::filesystem::path& file);

}  // namespace dsc::run
