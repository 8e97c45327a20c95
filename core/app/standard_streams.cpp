#include "standard_streams.hpp"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <ostream>
#include <streambuf>
#include <string>
#include <system_error>

#include <fcntl.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <fmt/format.h>

#include <dsc/base/error.hpp>

namespace dsc::app {
namespace {

constexpr int lowest_private = 10;  // shells leave the descriptors below to scripts

/// Writes all of the text, in spite of interruptions and also to non-blocking descriptors. Returns
/// 0, or the errno of the failure.
int write_whole(int to, std::string_view text, int patience_ms) noexcept {
    while (!text.empty()) {
        const ::ssize_t count = ::write(to, text.data(), text.size());
        if (count >= 0) {
            text.remove_prefix(static_cast<std::size_t>(count));
        } else if (errno == EAGAIN || errno == EWOULDBLOCK) {
            pollfd ready{to, POLLOUT, 0};
            if (::poll(&ready, 1, patience_ms) == 0) return EAGAIN;
        } else if (errno != EINTR) {
            return errno;
        }
    }
    return 0;
}

/// A buffer for a descriptor; it remembers the first failure.
class DescriptorBuffer : public std::streambuf {
public:
    int descriptor = STDOUT_FILENO;
    int failure = 0;

protected:
    int_type overflow(int_type c) override {
        if (traits_type::eq_int_type(c, traits_type::eof())) return traits_type::not_eof(c);
        const char one = traits_type::to_char_type(c);
        return xsputn(&one, 1) == 1 ? c : traits_type::eof();
    }
    std::streamsize xsputn(const char* text, std::streamsize count) override {
        waiting_.append(text, static_cast<std::size_t>(count));
        constexpr std::size_t most = std::size_t{1} << 16U;
        return waiting_.size() >= most && sync() != 0 ? 0 : count;
    }
    int sync() override {
        if (failure == 0) failure = write_whole(descriptor, waiting_, -1);
        waiting_.clear();
        return failure == 0 ? 0 : -1;
    }

private:
    std::string waiting_;
};

/// Neither is ever destroyed: a process that exit() ends during a job may still write.
DescriptorBuffer& data_buffer() {
    static auto* const buffer = new DescriptorBuffer;
    return *buffer;
}

}  // namespace

void take_standard_streams() {
    for (const int number : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
        // open() uses the lowest free number, which is this one: those below are open.
        if (::fcntl(number, F_GETFD) < 0 && errno == EBADF) {
            static_cast<void>(::open("/dev/null", number == STDIN_FILENO ? O_RDONLY : O_WRONLY));
        }
    }
    std::signal(SIGPIPE, SIG_IGN);
    const int ours = ::fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, lowest_private);
    if (ours < 0) return;  // no free descriptor: stdout stays shared
    ::dup2(STDERR_FILENO, STDOUT_FILENO);
    data_buffer().descriptor = ours;
}

std::ostream& data_out() {
    static auto* const stream = new std::ostream(&data_buffer());
    return *stream;
}

void flush_data() {
    data_out().flush();
    const int failure = data_buffer().failure;
    if (failure == 0) return;
    if (failure == EPIPE) {
        std::signal(SIGPIPE, SIG_DFL);
        static_cast<void>(std::raise(SIGPIPE));
    }
    throw IoError("io.write", "stdout", "",
                  fmt::format("cannot be written: {}", std::generic_category().message(failure)),
                  "check the file or program that receives it");
}

void tell(std::string_view text) noexcept {
    constexpr int patience_ms = 1000;
    static_cast<void>(write_whole(STDERR_FILENO, text, patience_ms));
}

bool stderr_rewrites() {
    const char* const kind = std::getenv("TERM");
    return ::isatty(STDERR_FILENO) != 0 && kind != nullptr && *kind != '\0' &&
           std::string_view(kind) != "dumb";
}

unsigned stderr_columns() {
    ::winsize size{};
    constexpr unsigned usual = 80;
    return ::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : usual;
}

}  // namespace dsc::app
