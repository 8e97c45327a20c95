#include "process.hpp"

#include <array>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <iostream>

#include <fcntl.h>
#include <signal.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include <fmt/core.h>

#include <dsc/base/error.hpp>
#include <dsc/host/child_process.hpp>

#include "call_note.hpp"
#include "guarded_input.hpp"

namespace dsc::conformance {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

int printed = -1;  // in a child: the memory file that receives its standard output and error

std::string read_file(int file, std::size_t begin, std::size_t most) {
    std::string text(most, '\0');
    const ssize_t count = pread(file, text.data(), most, static_cast<off_t>(begin));
    text.resize(count < 0 ? 0 : static_cast<std::size_t>(count));
    return text;
}

std::size_t size_of(int file) {
    const off_t end = lseek(file, 0, SEEK_END);
    return end < 0 ? 0 : static_cast<std::size_t>(end);
}

// An empty folder that is removed together with its owner.
class Scratch {
public:
    Scratch() {
        std::string pattern = (fs::temp_directory_path() / "dsc-check-XXXXXX").string();
        if (mkdtemp(pattern.data()) == nullptr)
            throw IoError("check.scratch", pattern, "", strerror(errno),
                          "set TMPDIR to a writable folder");
        path_ = pattern;
    }
    ~Scratch() {
        std::error_code error;
        fs::remove_all(path_, error);
    }
    Scratch(const Scratch&) = delete;
    Scratch& operator=(const Scratch&) = delete;
    const fs::path& path() const { return path_; }

private:
    fs::path path_;
};

int answer_to = -1;  // in a child: where its verdict goes
Verdict beyond_input;

[[noreturn]] void answer(const Verdict& verdict) {
    host::write_all(answer_to, std::string(1, static_cast<char>(verdict.status)) + verdict.message);
    _exit(0);
}

void end_beyond_input(const std::string& what) {
    answer({beyond_input.status, beyond_input.message + what});
}

[[noreturn]] void live(const std::function<Verdict()>& body, int to, int output,
                       const fs::path& folder, const Verdict& beyond) {
    setpgid(0, 0);
    host::keep_to_itself(output);
    printed = output;
    answer_to = to;
    beyond_input = beyond;
    if (chdir(folder.c_str()) != 0) _exit(1);
    guard_input(end_beyond_input);
    const Verdict verdict = body();
    std::cout.flush();
    std::fflush(nullptr);
    answer(verdict);
}

std::string last_line(const std::string& text) {
    std::size_t end = text.find_last_not_of("\n ");
    if (end == std::string::npos) return {};
    const std::size_t begin = text.find_last_of('\n', end);
    return text.substr(begin == std::string::npos ? 0 : begin + 1,
                       end - (begin == std::string::npos ? 0 : begin + 1) + 1);
}

// The line of a sanitizer's report that names the error; empty if there is none.
std::string sanitizer_report(const std::string& output) {
    for (const char* sign : {"ERROR: AddressSanitizer", "ERROR: LeakSanitizer",
                             "WARNING: ThreadSanitizer", "runtime error:"}) {
        const std::size_t at = output.find(sign);
        if (at == std::string::npos) continue;
        const std::size_t begin = output.rfind('\n', at);
        return output.substr(begin == std::string::npos ? 0 : begin + 1,
                             output.find('\n', at) - at + 1);
    }
    return {};
}

Verdict verdict_of(int status, bool in_time, const std::string& bytes, const std::string& output,
                   std::chrono::milliseconds limit) {
    const std::string call = call_in_progress();
    const std::string where = call.empty() ? "" : " in " + call;
    if (!in_time)
        return {Status::timeout,
                fmt::format("it did not end within {} s{}", limit.count() / 1000, where)};
    if (const std::string report = sanitizer_report(output); !report.empty())
        return {Status::fail, report};
    const std::string said = last_line(output);
    const std::string last_words = said.empty() ? "" : "; it printed: " + said;
    if (WIFSIGNALED(status)) return {Status::crash, host::end_text(status) + where + last_words};
    if (bytes.empty() || WEXITSTATUS(status) != 0)
        return {Status::crash,
                "it ended the process with " + host::end_text(status) + where + last_words};
    return {static_cast<Status>(bytes[0]), bytes.substr(1)};
}

}  // namespace

std::size_t printed_so_far() {
    if (printed < 0) return 0;
    std::cout.flush();
    std::cerr.flush();
    std::fflush(nullptr);
    return size_of(printed);
}

std::string printed_since(std::size_t begin) {
    return printed < 0 ? std::string() : read_file(printed, begin, 200);
}

double cpu_seconds() {
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

Verdict run_in_child(const std::function<Verdict()>& body, std::chrono::milliseconds limit,
                     const Verdict& beyond) {
    const Scratch scratch;
    std::array<int, 2> ends{};
    const int output = memfd_create("output", MFD_CLOEXEC);
    if (output < 0 || pipe2(ends.data(), O_CLOEXEC) != 0)
        throw PluginError("check.process", "process of a test",
                          fmt::format("cannot create a pipe ({})", strerror(errno)),
                          "close other programs");
    std::cout.flush();
    std::fflush(nullptr);
    share_call_note();
    const pid_t child = fork();
    if (child == 0) {
        close(ends[0]);
        live(body, ends[1], output, scratch.path(), beyond);
    }
    close(ends[1]);
    std::string bytes;
    const bool in_time = child > 0 && host::read_to_end(ends[0], bytes, Clock::now() + limit) ==
                                          host::ReadEnd::closed;
    int status = 0;
    if (child > 0) {
        if (!in_time) kill(child, SIGKILL);
        status = host::wait_for(child);
        kill(-child, SIGKILL);  // also ends the processes that it has started
    }
    const std::string said = read_file(output, 0, std::size_t{1} << 20U);
    close(ends[0]);
    close(output);
    if (child < 0)
        throw PluginError("check.process", "process of a test",
                          fmt::format("cannot be started ({})", strerror(errno)),
                          "close other programs");
    return verdict_of(status, in_time, bytes, said, limit);
}

}  // namespace dsc::conformance
