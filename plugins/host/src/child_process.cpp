#include "dsc/host/child_process.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fmt/format.h>

namespace dsc::host {
namespace {

using Clock = std::chrono::steady_clock;

// Reads up to `size` bytes; returns 0 at the end, -1 when the time limit is reached.
ssize_t read_some(int from, void* data, std::size_t size, Clock::time_point until) {
    for (;;) {
        const auto left =
            std::chrono::duration_cast<std::chrono::milliseconds>(until - Clock::now());
        pollfd waiting{from, POLLIN, 0};
        const int ready =
            poll(&waiting, 1, static_cast<int>(std::max<std::int64_t>(0, left.count())));
        if (ready < 0 && errno == EINTR) continue;
        if (ready == 0) return -1;
        const ssize_t count = read(from, data, size);
        if (count < 0 && errno == EINTR) continue;
        return std::max<ssize_t>(count, 0);
    }
}

}  // namespace

void keep_to_itself(int output) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    const rlimit no_core{0, 0};
    setrlimit(RLIMIT_CORE, &no_core);
    for (const int number : {SIGINT, SIGTERM, SIGHUP, SIGUSR1, SIGXCPU, SIGPIPE, SIGSEGV, SIGABRT,
                             SIGBUS, SIGFPE, SIGILL})
        signal(number, SIG_DFL);
    dup2(open("/dev/null", O_RDONLY | O_CLOEXEC), STDIN_FILENO);
    dup2(output, STDOUT_FILENO);
    dup2(output, STDERR_FILENO);
}

bool write_all(int to, std::string_view bytes) {
    while (!bytes.empty()) {
        const ssize_t count = write(to, bytes.data(), bytes.size());
        if (count < 0 && errno == EINTR) continue;
        if (count <= 0) return false;
        bytes.remove_prefix(static_cast<std::size_t>(count));
    }
    return true;
}

ReadEnd read_all(int from, void* data, std::size_t size, Clock::time_point until) {
    char* to = static_cast<char*>(data);
    while (size > 0) {
        const ssize_t count = read_some(from, to, size, until);
        if (count <= 0) return count < 0 ? ReadEnd::late : ReadEnd::closed;
        to += count;
        size -= static_cast<std::size_t>(count);
    }
    return ReadEnd::all;
}

ReadEnd read_to_end(int from, std::string& bytes, Clock::time_point until) {
    std::array<char, 4096> buffer{};
    for (;;) {
        const ssize_t count = read_some(from, buffer.data(), buffer.size(), until);
        if (count <= 0) return count < 0 ? ReadEnd::late : ReadEnd::closed;
        bytes.append(buffer.data(), static_cast<std::size_t>(count));
    }
}

int wait_for(int process) {
    int status = 0;
    while (waitpid(process, &status, 0) < 0 && errno == EINTR) {
    }
    return status;
}

std::string end_text(int status) {
    if (!WIFSIGNALED(status)) return fmt::format("exit code {}", WEXITSTATUS(status));
    const int number = WTERMSIG(status);
    return fmt::format("signal {} ({})", number, strsignal(number));
}

}  // namespace dsc::host
