// Reads a complete file into memory.
#include "dsc/base/read_file.hpp"

#include <cerrno>
#include <system_error>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <dsc/base/error.hpp>

namespace dsc {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& file, const char* code, const std::string& cause,
                       const std::string& remedy) {
    throw IoError(code, file.string(), "", cause, remedy);
}

[[noreturn]] void unreadable(const fs::path& file, int error) {
    fail(file, "io.unreadable", "cannot be read: " + std::generic_category().message(error),
         "check its permissions and the disk");
}

/// Devices and pipes are refused, because some of them never end.
void require_regular(const fs::path& file) {
    std::error_code error;
    const fs::file_status status = fs::status(file, error);
    if (fs::is_directory(status)) fail(file, "io.directory", "is a folder", "name a file in it");
    const bool absent = !error || error == std::errc::no_such_file_or_directory ||
                        error == std::errc::not_a_directory;
    if (!fs::exists(status) && absent) fail(file, "io.missing", "does not exist", "check the path");
    if (!error && !fs::is_regular_file(status))
        fail(file, "io.unreadable", "is not a regular file", "copy its content into a file first");
}

}  // namespace

std::string read_file(const fs::path& file) {
    require_regular(file);
    const int descriptor = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor < 0) unreadable(file, errno);
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
    if (failure != 0) unreadable(file, failure);
    content.resize(size);
    return content;
}

}  // namespace dsc
