// The lock file of a run folder.
#include "run_lock.hpp"

#include <array>
#include <cerrno>
#include <charconv>
#include <string_view>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <signal.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fmt/format.h>

#include <dsc/base/error.hpp>

namespace dsc::run {
namespace {

std::string this_host() {
    std::array<char, 256> name{};
    return ::gethostname(name.data(), name.size() - 1) == 0 ? std::string(name.data())
                                                            : std::string("unknown");
}

/// The text that the owner wrote: its process and its host.
struct Owner {
    pid_t process = 0;
    std::string host;
};

Owner owner_in(int descriptor) {
    std::array<char, 300> bytes{};
    const ::ssize_t count = ::pread(descriptor, bytes.data(), bytes.size(), 0);
    const std::string_view text(bytes.data(), count > 0 ? static_cast<std::size_t>(count) : 0);
    Owner owner;
    const auto [rest, error] =
        std::from_chars(text.data(), text.data() + text.size(), owner.process);
    if (error == std::errc()) {
        const std::string_view host = text.substr(static_cast<std::size_t>(rest - text.data()));
        const std::size_t begin = host.find_first_not_of(' ');
        if (begin != std::string_view::npos)
            owner.host = host.substr(begin, host.find('\n') - begin);
    }
    return owner;
}

std::string described(const Owner& owner) {
    if (owner.process <= 0) return "another process";
    return fmt::format("process {}{}{}", owner.process, owner.host.empty() ? "" : " on ",
                       owner.host);
}

enum class Taken { yes, by_other, unknown };

Taken lock(int descriptor) {
    // A process that asks for the owner holds the lock for a moment.
    constexpr int most_tries = 10;
    constexpr useconds_t between_us = 10000;
    for (int tries = 0; ::flock(descriptor, LOCK_EX | LOCK_NB) != 0;) {
        if (errno == EINTR) continue;
        if (errno != EWOULDBLOCK) return Taken::unknown;  // a file system without locks
        if (++tries == most_tries) return Taken::by_other;
        ::usleep(between_us);
    }
    return Taken::yes;
}

/// Without locks: whether the owner may still be running.
bool may_live(const Owner& owner) {
    if (owner.process <= 0 || owner.process == ::getpid()) return false;
    return owner.host != this_host() || ::kill(owner.process, 0) == 0 || errno == EPERM;
}

bool is_file(int descriptor, const std::filesystem::path& file) {
    struct ::stat open {};
    struct ::stat named {};
    return ::fstat(descriptor, &open) == 0 && ::stat(file.c_str(), &named) == 0 &&
           open.st_ino == named.st_ino && open.st_dev == named.st_dev;
}

[[noreturn]] void busy(const std::filesystem::path& folder, const Owner& owner) {
    throw UsageError(
        "run.busy", folder.string(),
        fmt::format("is in use by the run of {}; nothing in it was changed", described(owner)),
        "wait for the end of that run or name another folder");
}

}  // namespace

RunLock::RunLock(const std::filesystem::path& folder) : file_(folder / name) {
    while (true) {
        descriptor_ = ::open(file_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
        if (descriptor_ < 0) {
            throw IoError(
                "run.folder", folder.string(), "",
                fmt::format("cannot be locked: {}", std::generic_category().message(errno)),
                "choose another folder with -o or make this one writable");
        }
        const Taken taken = lock(descriptor_);
        const Owner owner = owner_in(descriptor_);
        if (taken == Taken::by_other || (taken == Taken::unknown && may_live(owner))) {
            ::close(descriptor_);
            descriptor_ = -1;
            busy(folder, owner);
        }
        // The last owner may have removed the file between opening and locking.
        if (is_file(descriptor_, file_)) break;
        ::close(descriptor_);
    }
    const std::string text = fmt::format("{} {}\n", ::getpid(), this_host());
    // The text is only for a message; the lock works without it.
    if (::ftruncate(descriptor_, 0) == 0)
        static_cast<void>(::pwrite(descriptor_, text.data(), text.size(), 0));
}

RunLock::RunLock(RunLock&& other) noexcept
    : file_(std::move(other.file_)), descriptor_(std::exchange(other.descriptor_, -1)) {}

RunLock::~RunLock() {
    if (descriptor_ < 0) return;
    ::unlink(file_.c_str());  // before the lock is released: no other process may have made it its
                              // own lock
    ::close(descriptor_);
}

std::string RunLock::owner(const std::filesystem::path& folder) {
    const int descriptor = ::open((folder / name).c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor < 0) return {};
    const Taken taken = lock(descriptor);
    const Owner owner = owner_in(descriptor);
    ::close(descriptor);
    return taken == Taken::by_other || (taken == Taken::unknown && may_live(owner))
               ? described(owner)
               : std::string();
}

}  // namespace dsc::run
