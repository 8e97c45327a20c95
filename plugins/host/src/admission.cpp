#include "admission.hpp"

#include <dsc/host/search_path.hpp>

#include "entry_file.hpp"

namespace dsc::host {
namespace {

namespace fs = std::filesystem;

// Loading a library is running it: nobody else may be able to put one there. A sticky folder (as /tmp)
// protects a file that the user names, but not what a scan of it would find.
void require_unwritable(const fs::path& path, bool sticky_will_do) {
    std::error_code error;
    const fs::perms permissions = fs::status(path, error).permissions();
    if (error || (permissions & fs::perms::others_write) == fs::perms::none) return;
    if (sticky_will_do && (permissions & fs::perms::sticky_bit) != fs::perms::none) return;
    refuse(path, "plugin.writable", "may be written by everyone, and loading a plugin runs it",
           "take the permission away (chmod o-w) or move the plugin to a folder of your own");
}

// The folder beside the core library: whoever may write there may as well replace the program, so a judgement
// of it would only stop builds made with a permissive umask.
bool as_trusted_as_the_program(const fs::path& folder) {
    std::error_code error;
    return fs::equivalent(folder, installed_folder(), error);
}

}  // namespace

fs::path real_path(const fs::path& file) {
    std::error_code error;
    fs::path real = fs::canonical(file, error);
    if (error)
        refuse(file, "plugin.open", "cannot be opened (" + error.message() + ")",
               "check the name and the permissions");
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
