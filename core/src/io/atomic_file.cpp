// Complete files, and the temporary files of killed processes.
#include "dsc/io/atomic_file.hpp"

#include <system_error>
#include <vector>

#include <dsc/base/replace_file.hpp>

namespace dsc::io {
void write_file(const std::filesystem::path& file, std::string_view content) {
    replace_file(file, content);
}

bool nothing_but_leftovers(const std::filesystem::path& folder, std::error_code& error,
                           std::string_view but) {
    std::filesystem::directory_iterator entry(folder, error);
    while (!error && entry != std::filesystem::directory_iterator()) {
        if (!is_replacement_leftover(entry->path()) &&
            (but.empty() || entry->path().filename() != but))
            return false;
        entry.increment(error);
    }
    return !error;
}

void remove_leftovers(const std::filesystem::path& folder) {
    std::error_code error, ignored;
    std::vector<std::filesystem::path> found;
    std::filesystem::directory_iterator entry(folder, error);
    while (!error && entry != std::filesystem::directory_iterator()) {
        if (is_replacement_leftover(entry->path()) && entry->is_regular_file(ignored))
            found.push_back(entry->path());
        entry.increment(error);
    }
    for (const auto& file : found) std::filesystem::remove(file, ignored);
}

}  // namespace dsc::io
