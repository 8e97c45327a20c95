#include <dsc/io/atomic_file.hpp>

#include <dsc/base/error.hpp>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cctype>
#include <cerrno>
#include <system_error>
#include <vector>

namespace dsc::io {
namespace {

std::string reason(int error) { return std::generic_category().message(error); }

[[noreturn]] void fail_write(const std::filesystem::path& file, const std::string& cause,
                             const std::string& remedy) {
    throw IoError("io.write", file.string(), "", cause, remedy);
}

std::string remedy_for(int error) {
    switch (error) {
        case ENOENT:
        case ENOTDIR:
            return "create the folder first or name another one";
        case EACCES:
        case EPERM:
        case EROFS:
            return "name a folder that you may write to";
        case ENOSPC:
        case EDQUOT:
            return "free some space or name another folder";
        default:
            return "name another file";
    }
}

/// A temporary file's name is .NAME.PROCESS-NUMBER.tmp, beside NAME.
std::string temporary_name(const std::filesystem::path& file, unsigned number) {
    return "." + file.filename().string() + "." + std::to_string(::getpid()) + "-" + std::to_string(number) + ".tmp";
}

bool is_temporary(const std::filesystem::path& file) {
    const auto is_number = [](std::string_view text) {
        return !text.empty() && std::all_of(text.begin(), text.end(), [](unsigned char c) { return std::isdigit(c) != 0; });
    };
    const std::string name = file.stem().string();
    const std::size_t dot = name.rfind('.'), dash = name.rfind('-');
    return file.extension() == ".tmp" && name.front() == '.' && dot > 0 && dash != std::string::npos && dash > dot &&
           is_number(std::string_view(name).substr(dot + 1, dash - dot - 1)) && is_number(std::string_view(name).substr(dash + 1));
}

/// Closes the descriptor and removes the file unless told that it has its final name.
class TemporaryFile {
public:
    explicit TemporaryFile(const std::filesystem::path& beside) {
        static std::atomic<unsigned> number{0};
        // Process and counter make the name unique among ourselves; O_EXCL makes it so among all.
        for (int attempt = 0; attempt < 100 && descriptor_ < 0; ++attempt) {
            path_ = beside.parent_path() / temporary_name(beside, number++);
            descriptor_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
            if (descriptor_ < 0 && errno != EEXIST) break;
        }
    }
    ~TemporaryFile() {
        if (descriptor_ < 0 && !closed_) return;
        const int saved = errno;
        if (!closed_) ::close(descriptor_);
        if (!kept_) ::unlink(path_.c_str());
        errno = saved;
    }
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;

    bool open() const { return descriptor_ >= 0; }

    bool write(std::string_view content) {
        while (!content.empty()) {
            const ::ssize_t count = ::write(descriptor_, content.data(), content.size());
            if (count < 0 && errno == EINTR) continue;
            if (count < 0) return false;
            content.remove_prefix(static_cast<std::size_t>(count));
        }
        // Some file systems have no fsync; that is no reason to lose the file.
        return ::fsync(descriptor_) == 0 || errno == EINVAL || errno == ENOSYS || errno == ENOTSUP;
    }

    bool move_to(const std::filesystem::path& file) {
        closed_ = true;
        if (::close(descriptor_) != 0) return false;
        if (::rename(path_.c_str(), file.c_str()) != 0) return false;
        kept_ = true;
        return true;
    }

private:
    std::filesystem::path path_;
    int descriptor_ = -1;
    bool closed_ = false;
    bool kept_ = false;
};

/// Makes the new name durable. Failure is no error: the file is there.
void sync_folder(const std::filesystem::path& folder) {
    const int descriptor = ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (descriptor < 0) return;
    ::fsync(descriptor);
    ::close(descriptor);
}

}  // namespace

void write_file(const std::filesystem::path& file, std::string_view content) {
    std::error_code error;
    std::filesystem::path target = file;
    if (std::filesystem::is_symlink(file, error)) {
        const auto resolved = std::filesystem::weakly_canonical(file, error);
        if (!error) target = resolved;
    }
    const auto status = std::filesystem::status(target, error);
    if (std::filesystem::is_directory(status)) fail_write(file, "is a directory", "name a file");
    if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)) {
        fail_write(file, "is not a regular file", "name a file that may be replaced");
    }
    if (target.filename().empty()) fail_write(file, "names no file", "name a file");
    TemporaryFile temporary(target);
    if (!temporary.open()) {
        const int code = errno;
        fail_write(file, "cannot be written: " + reason(code), remedy_for(code));
    }
    if (!temporary.write(content) || !temporary.move_to(target)) {
        const int code = errno;
        fail_write(file, "cannot be written: " + reason(code), remedy_for(code));
    }
    sync_folder(target.parent_path());
}

bool nothing_but_leftovers(const std::filesystem::path& folder, std::error_code& error) {
    std::filesystem::directory_iterator entry(folder, error);
    while (!error && entry != std::filesystem::directory_iterator()) {
        if (!is_temporary(entry->path())) return false;
        entry.increment(error);
    }
    return !error;
}

void remove_leftovers(const std::filesystem::path& folder) {
    std::error_code error, ignored;
    std::vector<std::filesystem::path> found;
    std::filesystem::directory_iterator entry(folder, error);
    while (!error && entry != std::filesystem::directory_iterator()) {
        if (is_temporary(entry->path()) && entry->is_regular_file(ignored)) found.push_back(entry->path());
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
