#pragma once
// Atomic replacement of files: a file is complete or absent. All result files are written with it.

#include <filesystem>
#include <string_view>

namespace dsc {

/// Writes `content` to a temporary file next to `file`, flushes it to the disk and renames it.
/// Readers see the old file or the complete new one. An existing file keeps its mode and, where the
/// system allows it, its owner and group. Symbolic links are followed, also to a file that does not
/// exist yet. A file with several hard links, or one that can be written but not replaced (its
/// folder is not writable, it is a mount point), is written in place after the temporary file.
/// Anything but a regular file is refused. Throws IoError "io.write" with the system's reason; the
/// temporary file is then removed. If the file was written in place and only in part, the temporary
/// file is kept and the error names it. [step]
void replace_file(const std::filesystem::path& file, std::string_view content);

/// Throws what replace_file() would throw now, except for a full disk. Changes nothing. [setup]
void require_replaceable(const std::filesystem::path& file);

/// Whether the name is the name of a temporary file of replace_file(): .NAME.PROCESS-NUMBER.tmp.
/// [step]
bool is_replacement_leftover(const std::filesystem::path& file);

}  // namespace dsc
