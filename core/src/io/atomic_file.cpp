#include <dsc/io/atomic_file.hpp>

#include <dsc/base/error.hpp>
#include <dsc/base/replace_file.hpp>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <vector>

namespace dsc::io {
namespace {

std::string reason(int error) { return std::generic_category().message(error); }

}  // namespace

void write_file(const std::filesystem::path& file, std::string_view content) { replace_file(file, content); }

bool nothing_but_leftovers(const std::filesystem::path& folder, std::error_code& error, std::string_view but) {
    std::filesystem::directory_iterator entry(folder, error);
    while (!error && entry != std::filesystem::directory_iterator()) {
        if (!is_replacement_leftover(entry->path()) && (but.empty() || entry->path().filename() != but)) return false;
        entry.increment(error);
    }
    return !error;
}

void remove_leftovers(const std::filesystem::path& folder) {
    std::error_code error, ignored;
    std::vector<std::filesystem::path> found;
    std::filesystem::directory_iterator entry(folder, error);
    while (!error && entry != std::filesystem::directory_iterator()) {
        if (is_replacement_leftover(entry->path()) && entry->is_regular_file(ignored)) found.push_back(entry->path());
        entry.increment(error);
    }
    for (const auto& file : found) std::filesystem::remove(file, ignored);
}

std::string read_file(const std::filesystem::path& file) {
    const auto fail_read = [&](const char* code, const std::string& cause, const std::string& remedy) {
        throw IoError(code, file.string(), "", cause, remedy);
    };
    std::error_code error;
    const auto status = std::filesystem::status(file, error);
    if (std::filesystem::is_directory(status)) fail_read("io.directory", "is a directory", "name a file");
    if (!std::filesystem::exists(status) &&
        (!error || error == std::errc::no_such_file_or_directory || error == std::errc::not_a_directory)) {
        fail_read("io.missing", "does not exist", "check the path");
    }
    if (!error && !std::filesystem::is_regular_file(status)) {
        fail_read("io.unreadable", "is not a regular file", "copy its content to a file first");
    }
    const int descriptor = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor < 0)
        fail_read("io.unreadable", "cannot be read: " + reason(errno), "check its permissions");
    std::string content;
    struct ::stat facts {};
    if (::fstat(descriptor, &facts) == 0 && facts.st_size > 0)
        content.resize(static_cast<std::size_t>(facts.st_size));
    std::size_t size = 0;
    int failure = 0;
    while (true) {
        if (size == content.size()) content.resize(size + 65536);
        const ::ssize_t count = ::read(descriptor, content.data() + size, content.size() - size);
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) failure = errno;
        if (count <= 0) break;
        size += static_cast<std::size_t>(count);
    }
    ::close(descriptor);
    if (failure != 0) fail_read("io.unreadable", "cannot be read: " + reason(failure), "check the disk");
    content.resize(size);
    return content;
}

}  // namespace dsc::io
