#include "dsc/host/scan.hpp"

#include <array>
#include <cerrno>
#include <cstdint>
#include <utility>

#include <fcntl.h>
#include <signal.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fmt/format.h>

#include <dsc/base/error.hpp>
#include <dsc/host/child_process.hpp>

#include "entry_file.hpp"
#include "library.hpp"

namespace dsc::host {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

// One message of the child per library: code, place, cause and remedy of a fault, all empty if
// there is none.
using Answer = std::array<std::string, 4>;
using Sizes = std::array<std::uint32_t, 4>;

// ---- the child

void send(int to, const Answer& answer) {
    Sizes head{};
    for (std::size_t i = 0; i < answer.size(); ++i)
        head[i] = static_cast<std::uint32_t>(answer[i].size());
    std::string bytes(reinterpret_cast<const char*>(head.data()), sizeof(head));
    for (const std::string& text : answer) bytes += text;
    if (!write_all(to, bytes)) _exit(1);
}

[[noreturn]] void trial_load(std::span<const fs::path> libraries, int to) {
    keep_to_itself(open("/dev/null", O_WRONLY | O_CLOEXEC));
    for (const fs::path& library : libraries) {
        Answer answer;
        try {
            enroll(open_library(library), library);
        } catch (const Error& error) {
            answer = {error.code(), error.place(), error.cause(), error.remedy()};
        }
        send(to, answer);
    }
    _exit(0);
}

// ---- the parent

class Child {
public:
    explicit Child(std::span<const fs::path> libraries) {
        std::array<int, 2> ends{};
        if (pipe2(ends.data(), O_CLOEXEC) != 0) throw_system("a pipe");
        process_ = fork();
        if (process_ == 0) {
            close(ends[0]);
            trial_load(libraries, ends[1]);
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
        if (!ended_) wait_for(process_);
        close(from_);
    }
    Child(const Child&) = delete;
    Child& operator=(const Child&) = delete;

    // The next message, unless the child ends or the time limit is reached first.
    ReadEnd next(Answer& answer, Clock::time_point until) const {
        Sizes head{};
        ReadEnd end = read_all(from_, head.data(), sizeof(head), until);
        for (std::size_t i = 0; i < answer.size() && end == ReadEnd::all; ++i) {
            answer[i].resize(head[i]);
            end = read_all(from_, answer[i].data(), answer[i].size(), until);
        }
        return end;
    }

    // How it ended: "was ended by signal 11 (Segmentation fault)".
    std::string exit_description() {
        const int status = wait_for(process_);
        ended_ = true;
        return (WIFSIGNALED(status) ? "was ended by " : "exited with ") + end_text(status);
    }

private:
    [[noreturn]] static void throw_system(const std::string& what) {
        throw PluginError("plugin.scan", "trial load of plugins",
                          fmt::format("cannot create {} ({})", what, strerror(errno)),
                          "close other programs");
    }

    pid_t process_ = -1;
    int from_ = -1;
    bool ended_ = false;
};

Fault fault_of(const fs::path& file, std::string code, const std::string& cause) {
    return {file, PluginError(std::move(code), file.string(), cause,
                              "report this to the plugin's authors")};
}

}  // namespace

std::vector<std::optional<Fault>> scan(std::span<const fs::path> libraries,
                                       std::chrono::milliseconds limit) {
    std::vector<std::optional<Fault>> faults(libraries.size());
    std::size_t next = 0;
    while (next < libraries.size()) {
        Child child(libraries.subspan(next));
        // One child process handles all libraries; if it ends, a new child continues with the next
        // library.
        for (ReadEnd end = ReadEnd::all; end == ReadEnd::all && next < libraries.size(); ++next) {
            Answer answer;
            end = child.next(answer, Clock::now() + limit);
            const fs::path& file = libraries[next];
            if (end == ReadEnd::late) {
                faults[next] = fault_of(file, "plugin.hang",
                                        fmt::format("did not load within {} s in a child process",
                                                    limit.count() / 1000));
            } else if (end == ReadEnd::closed) {
                faults[next] =
                    fault_of(file, "plugin.crash",
                             fmt::format("crashes when it is loaded: the child process {}",
                                         child.exit_description()));
            } else if (const auto& [code, place, cause, remedy] = answer; !code.empty()) {
                faults[next] = Fault{file, PluginError(code, place, cause, remedy)};
            }
        }
    }
    return faults;
}

}  // namespace dsc::host
