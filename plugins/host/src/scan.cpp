#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <dsc/base/error.hpp>
#include <dsc/host/scan.hpp>
#include <utility>

#include "entry_file.hpp"
#include "library.hpp"

namespace dsc::host {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

// One message of the child: the library that it is done with, and the two texts of a fault (empty for none).
struct Answer {
    std::uint32_t library = 0;
    std::string code;
    std::string message;
};

// ---- the child

void write_all(int to, const void* data, std::size_t size) {
    const char* from = static_cast<const char*>(data);
    while (size > 0) {
        const ssize_t written = write(to, from, size);
        if (written < 0 && errno == EINTR) continue;
        if (written <= 0) _exit(1);
        from += written;
        size -= static_cast<std::size_t>(written);
    }
}

void send(int to, const Answer& answer) {
    const std::array<std::uint32_t, 3> head = {answer.library, static_cast<std::uint32_t>(answer.code.size()),
                                               static_cast<std::uint32_t>(answer.message.size())};
    std::string bytes(reinterpret_cast<const char*>(head.data()), sizeof(head));
    bytes += answer.code + answer.message;
    write_all(to, bytes.data(), bytes.size());
}

// Nothing that a library does shall reach the terminal, leave a core file or live longer than the parent.
void withdraw() {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    const rlimit no_core{0, 0};
    setrlimit(RLIMIT_CORE, &no_core);
    const int null = open("/dev/null", O_RDWR | O_CLOEXEC);
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) dup2(null, stream);
    for (const int number : {SIGINT, SIGTERM, SIGSEGV, SIGABRT, SIGBUS, SIGFPE, SIGILL})
        signal(number, SIG_DFL);
}

[[noreturn]] void rehearse(std::span<const fs::path> libraries, std::size_t first, int to) {
    withdraw();
    for (std::size_t i = first; i < libraries.size(); ++i) {
        Answer answer{static_cast<std::uint32_t>(i), {}, {}};
        try {
            enroll(open_library(libraries[i]), libraries[i]);
        } catch (const Error& error) {
            answer.code = error.code();
            answer.message = error.what();
        }
        send(to, answer);
    }
    _exit(0);
}

// ---- the parent

class Child {
public:
    Child(std::span<const fs::path> libraries, std::size_t first) {
        std::array<int, 2> ends{};
        if (pipe2(ends.data(), O_CLOEXEC) != 0) throw_system("a pipe");
        process_ = fork();
        if (process_ == 0) {
            close(ends[0]);
            rehearse(libraries, first, ends[1]);
        }
        close(ends[1]);
        from_ = ends[0];
        if (process_ < 0) {
            close(from_);
            throw_system("a process");
        }
    }
    ~Child() {
        kill(process_, SIGKILL);
        if (!ended_) wait_for_end();
        close(from_);
    }
    Child(const Child&) = delete;
    Child& operator=(const Child&) = delete;

    enum class End { answered, closed, late };

    // The next message, unless the child ends or the time is over first.
    End next(Answer& answer, Clock::time_point until) {
        std::array<std::uint32_t, 3> head{};
        if (const End end = read_all(head.data(), sizeof(head), until); end != End::answered) return end;
        answer.library = head[0];
        answer.code.resize(head[1]);
        answer.message.resize(head[2]);
        const End end = read_all(answer.code.data(), answer.code.size(), until);
        return end == End::answered ? read_all(answer.message.data(), answer.message.size(), until) : end;
    }

    // How it ended: "ended by signal 11 (Segmentation fault)".
    std::string obituary() {
        const int status = wait_for_end();
        if (WIFSIGNALED(status)) {
            const int number = WTERMSIG(status);
            return "was ended by signal " + std::to_string(number) + " (" + strsignal(number) + ")";
        }
        return "ended itself with exit code " + std::to_string(WEXITSTATUS(status));
    }

private:
    [[noreturn]] static void throw_system(const std::string& what) {
        throw PluginError("plugin.scan", "cannot make " + what + " to try plugins in (" + strerror(errno) +
                                             "); close other programs");
    }

    int wait_for_end() {
        int status = 0;
        while (waitpid(process_, &status, 0) < 0 && errno == EINTR) {
        }
        ended_ = true;
        return status;
    }

    End read_all(void* data, std::size_t size, Clock::time_point until) {
        char* to = static_cast<char*>(data);
        while (size > 0) {
            const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(until - Clock::now());
            pollfd waiting{from_, POLLIN, 0};
            const int ready = poll(&waiting, 1, static_cast<int>(std::max<std::int64_t>(0, left.count())));
            if (ready < 0 && errno == EINTR) continue;
            if (ready == 0) return End::late;
            const ssize_t count = read(from_, to, size);
            if (count < 0 && errno == EINTR) continue;
            if (count <= 0) return End::closed;
            to += count;
            size -= static_cast<std::size_t>(count);
        }
        return End::answered;
    }

    pid_t process_ = -1;
    int from_ = -1;
    bool ended_ = false;
};

Fault fault_of(const fs::path& file, std::string code, const std::string& cause) {
    return {file, std::move(code), file.string() + ": " + cause + "; report this to the plugin's authors"};
}

}  // namespace

std::vector<std::optional<Fault>> scan(std::span<const fs::path> libraries, std::chrono::milliseconds limit) {
    std::vector<std::optional<Fault>> faults(libraries.size());
    std::size_t next = 0;
    while (next < libraries.size()) {
        Child child(libraries, next);
        // As long as the child answers, it goes on to the next library; where it ends, another one takes over.
        for (Child::End end = Child::End::answered; end == Child::End::answered && next < libraries.size();
             ++next) {
            Answer answer;
            end = child.next(answer, Clock::now() + limit);
            const fs::path& file = libraries[next];
            if (end == Child::End::late) {
                faults[next] = fault_of(file, "plugin.hang",
                                        "did not load within " + std::to_string(limit.count() / 1000) +
                                            " s when it was tried in a process of its own");
            } else if (end == Child::End::closed) {
                faults[next] =
                    fault_of(file, "plugin.crash",
                             "crashes when it is loaded: the process that tried it " + child.obituary());
            } else if (!answer.code.empty()) {
                faults[next] = Fault{file, answer.code, answer.message};
            }
        }
    }
    return faults;
}

}  // namespace dsc::host
