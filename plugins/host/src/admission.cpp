#include "admission.hpp"

#include <fmt/format.h>

#include <dsc/host/search_path.hpp>

#include "entry_file.hpp"

namespace dsc::host {
namespace {

namespace fs = std::filesystem;

// Loading a library runs it, so nobody else may be able to put one there. A sticky folder (like
// /tmp) protects a file that the user names, but not the files that a scan of the folder would
// find.
void require_unwritable(const fs::path& path, bool sticky_will_do) {
    std::error_code error;
    const fs::perms permissions = fs::status(path, error).permissions();
    if (error || (permissions & fs::perms::others_write) == fs::perms::none) return;
    if (sticky_will_do && (permissions & fs::perms::sticky_bit) != fs::perms::none) return;
    refuse(path, "plugin.writable",
           "can be written by everyone, and loading a plugin runs its code",
           "remove this permission (chmod o-w) or move the plugin to your own folder");
}

// The folder beside the core library: a user who may write there may also replace the program, so a
// check of it would only refuse builds made with a permissive umask.
bool as_trusted_as_the_program(const fs::path& folder) {
    std::error_code error;
    return fs::equivalent(folder, installed_folder(), error);
}

}  // namespace

fs::path real_path(const fs::path& file) {
    std::error_code error;
    fs::path real = fs::canonical(file, error);
    if (error)
        refuse(file, "plugin.open", fmt::format("cannot be opened ({})", error.message()),
               "check its name and permissions");
    return real;
}

void require_safe_folder(const fs::path& folder) {
    if (!as_trusted_as_the_program(folder)) require_unwritable(folder, false);
}

void require_safe_file(const fs::path& real) {
    if (as_trusted_as_the_program(real.parent_path())) return;
    require_unwritable(real, false);
    require_unwritable(real.parent_path(), true);
}

void require_admissible(const fs::path& real) {
    require_safe_file(real);
    require_fitting(read_entry(real), real);
}

}  // namespace dsc::host
