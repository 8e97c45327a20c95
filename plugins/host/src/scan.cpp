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

#include <dsc/base/error.hpp>
#include <dsc/host/child_process.hpp>

#include "entry_file.hpp"
#include "library.hpp"

namespace dsc::host {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

// One message of the child per library: the two texts of a fault, both empty if there is none.
struct Answer {
    std::string code;
    std::string message;
};

// ---- the child

void send(int to, const Answer& answer) {
    const std::array<std::uint32_t, 2> head = {static_cast<std::uint32_t>(answer.code.size()),
                                               static_cast<std::uint32_t>(answer.message.size())};
    std::string bytes(reinterpret_cast<const char*>(head.data()), sizeof(head));
    bytes += answer.code + answer.message;
    if (!write_all(to, bytes)) _exit(1);
}

[[noreturn]] void trial_load(std::span<const fs::path> libraries, int to) {
    keep_to_itself(open("/dev/null", O_WRONLY | O_CLOEXEC));
    for (const fs::path& library : libraries) {
        Answer answer;
        try {
            enroll(open_library(library), library);
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
        std::array<std::uint32_t, 2> head{};
        if (const ReadEnd end = read_all(from_, head.data(), sizeof(head), until);
            end != ReadEnd::all)
            return end;
        answer.code.resize(head[0]);
        answer.message.resize(head[1]);
        const ReadEnd end = read_all(from_, answer.code.data(), answer.code.size(), until);
        return end == ReadEnd::all
                   ? read_all(from_, answer.message.data(), answer.message.size(), until)
                   : end;
    }

    // How it ended: "was ended by signal 11 (Segmentation fault)".
    std::string exit_description() {
        const int status = wait_for(process_);
        ended_ = true;
        return (WIFSIGNALED(status) ? "was ended by " : "exited with ") + end_text(status);
    }

private:
    [[noreturn]] static void throw_system(const std::string& what) {
        throw PluginError("plugin.scan", "cannot create " + what +
                                             " for the trial load of plugins (" + strerror(errno) +
                                             "); close other programs");
    }

    pid_t process_ = -1;
    int from_ = -1;
    bool ended_ = false;
};

Fault fault_of(const fs::path& file, std::string code, const std::string& cause) {
    return {file, std::move(code),
            file.string() + ": " + cause + "; report this to the plugin's authors"};
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
                faults[next] =
                    fault_of(file, "plugin.hang",
                             "did not load within " + std::to_string(limit.count() / 1000) +
                                 " s in a child process");
            } else if (end == ReadEnd::closed) {
                faults[next] = fault_of(
                    file, "plugin.crash",
                    "crashes when it is loaded: the child process " + child.exit_description());
            } else if (!answer.code.empty()) {
                faults[next] = Fault{file, answer.code, answer.message};
            }
        }
    }
    return faults;
}

}  // namespace dsc::host
