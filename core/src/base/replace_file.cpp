// Replaces a file so that it is complete or unchanged.
#include "dsc/base/replace_file.hpp"

#include <algorithm>
#include <atomic>
#include <cctype>
#include <cerrno>
#include <optional>
#include <string>
#include <system_error>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <dsc/base/error.hpp>

namespace dsc {
namespace {

namespace fs = std::filesystem;
using FileFacts = struct ::stat;

std::string reason_of(int error) { return std::generic_category().message(error); }

[[noreturn]] void fail_replacing(const fs::path& file, const std::string& cause,
                                 const std::string& remedy) {
    throw IoError("io.write", file.string(), "", cause, remedy);
}

const char* replacing_remedy(int error) {
    switch (error) {
        case ENOENT:
        case ENOTDIR: return "create the folder first or name another one";
        case EACCES:
        case EPERM:
        case EROFS: return "name a folder that you may write to";
        case ENOSPC:
        case EDQUOT: return "free some space or name another folder";
        default: return "name another file";
    }
}

[[noreturn]] void fail_replacing(const fs::path& file, int error) {
    fail_replacing(file, "cannot be written: " + reason_of(error), replacing_remedy(error));
}

std::string temporary_name(const fs::path& file, unsigned number) {
    return "." + file.filename().string() + "." + std::to_string(::getpid()) + "-" +
           std::to_string(number) + ".tmp";
}

/// 0, or the errno of the failure.
int write_flushed(int descriptor, std::string_view content) {
    while (!content.empty()) {
        const ::ssize_t count = ::write(descriptor, content.data(), content.size());
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) return errno;
        content.remove_prefix(static_cast<std::size_t>(count));
    }
    // Some file systems do not support fsync. The file is written there as well.
    return ::fsync(descriptor) == 0 || errno == EINVAL || errno == ENOSYS || errno == ENOTSUP
               ? 0
               : errno;
}

/// Closes the descriptor and removes the file unless the file shall stay.
class TemporaryFile {
public:
    explicit TemporaryFile(const fs::path& beside) {
        static std::atomic<unsigned> number{0};
        // Process and counter make the name unique within this program; O_EXCL makes it unique in
        // the folder.
        for (int attempt = 0; attempt < 100 && descriptor_ < 0; ++attempt) {
            path_ = beside.parent_path() / temporary_name(beside, number++);
            descriptor_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
            failure_ = descriptor_ < 0 ? errno : 0;
            if (descriptor_ < 0 && errno != EEXIST) break;
        }
    }
    ~TemporaryFile() {
        if (descriptor_ < 0 && !closed_) return;
        if (!closed_) ::close(descriptor_);
        if (!kept_) ::unlink(path_.c_str());
    }
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;

    /// 0, or the errno of opening the file.
    int failure() const { return failure_; }
    const fs::path& path() const { return path_; }

    int write(std::string_view content) { return write_flushed(descriptor_, content); }

    /// Copies mode and owner of the file that is replaced, as far as the system allows. If the
    /// owner changes, the new owner must not get more rights.
    void take_attributes(const FileFacts& of) {
        const bool owner_kept = ::fchown(descriptor_, of.st_uid, of.st_gid) == 0;
        const bool group_kept =
            owner_kept || ::fchown(descriptor_, static_cast<::uid_t>(-1), of.st_gid) == 0;
        ::mode_t mode = of.st_mode & (owner_kept ? 07777U : 01777U);
        if (!group_kept) mode &= ~static_cast<::mode_t>(02000U);
        static_cast<void>(::fchmod(descriptor_, mode));
    }

    int move_to(const fs::path& file) {
        closed_ = true;
        if (::close(descriptor_) != 0) return errno;
        if (::rename(path_.c_str(), file.c_str()) != 0) return errno;
        kept_ = true;
        return 0;
    }

    void keep() { kept_ = true; }

private:
    fs::path path_;
    int descriptor_ = -1;
    int failure_ = 0;
    bool closed_ = false;
    bool kept_ = false;
};

/// Makes the new name durable. A failure is not an error, because the file exists.
void sync_folder(const fs::path& folder) {
    const int descriptor =
        ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (descriptor < 0) return;
    ::fsync(descriptor);
    ::close(descriptor);
}

/// The file that a name refers to, and what exists there now.
struct Place {
    fs::path file;
    std::optional<FileFacts> facts;

    bool linked() const { return facts && facts->st_nlink > 1; }
};

Place place_of(const fs::path& file) {
    Place place{file, std::nullopt};
    constexpr int most_links = 40;
    std::error_code error;
    for (int links = 0; fs::is_symlink(fs::symlink_status(place.file, error)); ++links) {
        if (links == most_links) fail_replacing(file, ELOOP);
        const fs::path next = fs::read_symlink(place.file, error);
        if (error) fail_replacing(file, error.value());
        place.file = next.is_absolute() ? next : place.file.parent_path() / next;
    }
    if (place.file.filename().empty()) fail_replacing(file, "names no file", "name a file");
    FileFacts facts{};
    if (::stat(place.file.c_str(), &facts) != 0) return place;
    if (S_ISDIR(facts.st_mode)) fail_replacing(file, "is a directory", "name a file");
    if (!S_ISREG(facts.st_mode))
        fail_replacing(file, "is not a regular file", "name a file that may be replaced");
    place.facts = facts;
    return place;
}

/// Whether a file that cannot be replaced for this reason may still be writable.
bool worth_writing_in_place(int error) {
    return error == EACCES || error == EPERM || error == EBUSY || error == EXDEV || error == EROFS;
}

int write_in_place(const fs::path& file, std::string_view content) {
    const int descriptor = ::open(file.c_str(), O_WRONLY | O_CLOEXEC);
    if (descriptor < 0) return errno;
    int failure = write_flushed(descriptor, content);
    if (failure == 0 && ::ftruncate(descriptor, static_cast<::off_t>(content.size())) != 0)
        failure = errno;
    if (failure == 0 && ::fsync(descriptor) != 0 && errno == EIO) failure = EIO;
    if (::close(descriptor) != 0 && failure == 0) failure = errno;
    return failure;
}

bool can_be_opened(const fs::path& file) {
    const int descriptor = ::open(file.c_str(), O_WRONLY | O_CLOEXEC);
    if (descriptor < 0) return false;
    ::close(descriptor);
    return true;
}

}  // namespace

void replace_file(const fs::path& file, std::string_view content) {
    const Place place = place_of(file);
    TemporaryFile temporary(place.file);
    if (const int error = temporary.failure(); error != 0) {
        if (!place.facts || !worth_writing_in_place(error) ||
            write_in_place(place.file, content) != 0)
            fail_replacing(file, error);
        return;
    }
    if (const int error = temporary.write(content); error != 0) fail_replacing(file, error);
    if (place.facts) temporary.take_attributes(*place.facts);
    if (!place.linked()) {
        const int error = temporary.move_to(place.file);
        if (error == 0) return sync_folder(place.file.parent_path());
        if (!place.facts || !worth_writing_in_place(error)) fail_replacing(file, error);
    }
    if (const int error = write_in_place(place.file, content); error != 0) {
        temporary.keep();
        fail_replacing(file, "cannot be written: " + reason_of(error),
                       "the whole new content is kept in " + temporary.path().string());
    }
}

void require_replaceable(const fs::path& file) {
    const Place place = place_of(file);
    const TemporaryFile temporary(place.file);
    const int error = temporary.failure();
    if (error == 0 && !place.linked()) return;
    if (place.facts && (error == 0 || worth_writing_in_place(error)) && can_be_opened(place.file))
        return;
    fail_replacing(file, error == 0 ? EACCES : error);
}

bool is_replacement_leftover(const fs::path& file) {
    const auto is_number = [](std::string_view text) {
        return !text.empty() && std::all_of(text.begin(), text.end(),
                                            [](unsigned char c) { return std::isdigit(c) != 0; });
    };
    const std::string name = file.stem().string();
    const std::size_t dot = name.rfind('.'), dash = name.rfind('-');
    return file.extension() == ".tmp" && name.front() == '.' && dot > 0 &&
           dash != std::string::npos && dash > dot &&
           is_number(std::string_view(name).substr(dot + 1, dash - dot - 1)) &&
           is_number(std::string_view(name).substr(dash + 1));
}

}  // namespace dsc
