#pragma once
// Files that appear whole or not at all: the one way in which files of results are written.

#include <filesystem>
#include <string_view>

namespace dsc {

/// Writes `content` to a temporary file beside `file`, flushes it to the disk and renames it, so whoever looks sees the old
/// file or the whole new one. A file that was there keeps its mode and, where the system lets us, its owner and group;
/// symbolic links are followed, also to a file that is not there yet. A file with several hard links, and one that cannot be
/// replaced but can be written (its folder is not ours, it is mounted by itself), is written in place after the temporary
/// file. Anything but a regular file is refused. Throws IoError "io.write", naming the system's reason; the temporary file is
/// then removed; where the file was written in place and only in part, it is kept and the error names it. [step]
void replace_file(const std::filesystem::path& file, std::string_view content);

/// Throws what replace_file() would throw now, but for a full disk; changes nothing. [setup]
void require_replaceable(const std::filesystem::path& file);

/// Whether the name is that of a temporary file of replace_file(): .NAME.PROCESS-NUMBER.tmp. [step]
bool is_replacement_leftover(const std::filesystem::path& file);

}  // namespace dsc
