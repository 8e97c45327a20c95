#include "process.hpp"

#include <fstream>
#include <sstream>
#include <stdexcept>

#include <fcntl.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

namespace dsc::test {
namespace {

namespace fs = std::filesystem;

std::string content(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    std::ostringstream text;
    text << stream.rdbuf();
    return text.str();
}

void replace_all(std::string& text, const std::string& from, const std::string& to) {
    for (std::size_t at = text.find(from); at != std::string::npos;
         at = text.find(from, at + to.size())) {
        text.replace(at, from.size(), to);
    }
}

[[noreturn]] void child(const std::string& file, const std::vector<std::string>& arguments,
                        const fs::path& folder, const fs::path& out, const fs::path& err,
                        const std::map<std::string, std::string>& environment) {
    const auto redirect = [](const char* stream, int to, int flags) {
        const int from = open(stream, flags, 0600);
        if (from < 0 || dup2(from, to) < 0) _exit(127);
    };
    redirect("/dev/null", STDIN_FILENO, O_RDONLY);
    redirect(out.c_str(), STDOUT_FILENO, O_WRONLY | O_CREAT | O_TRUNC);
    redirect(err.c_str(), STDERR_FILENO, O_WRONLY | O_CREAT | O_TRUNC);
    if (chdir(folder.c_str()) != 0) _exit(127);
    for (const auto& [name, value] : environment) {
        if (value.empty()) {
            unsetenv(name.c_str());
        } else {
            setenv(name.c_str(), value.c_str(), 1);
        }
    }
    std::vector<std::string> copy = {file};
    copy.insert(copy.end(), arguments.begin(), arguments.end());
    std::vector<char*> argv;
    for (std::string& argument : copy) argv.push_back(argument.data());
    argv.push_back(nullptr);
    execv(argv[0], argv.data());
    _exit(127);
}

}  // namespace

Cli::Cli()
    : environment{{"DSC_PLUGIN_PATH", ""},
                  {"XDG_DATA_HOME", "/nonexistent"},
                  {"DSC_DATA", ""},
                  {"DSC_SHARE", ""}} {
    std::string pattern = (fs::temp_directory_path() / "dsc-cli-XXXXXX").string();
    if (mkdtemp(pattern.data()) == nullptr) throw std::runtime_error("no scratch folder");
    folder_ = fs::canonical(pattern);
}

Cli::~Cli() {
    std::error_code error;
    fs::remove_all(folder_, error);
}

std::string Cli::write(const std::string& name, const std::string& text) const {
    const fs::path file = folder_ / name;
    fs::create_directories(file.parent_path());
    std::ofstream(file, std::ios::binary) << text;
    return name;
}

std::string Cli::read(const std::string& name) const { return content(folder_ / name); }

Result Cli::dsc(const std::vector<std::string>& arguments) const {
    return program(DSC_TEST_COMMAND, arguments);
}

Result Cli::program(const std::string& file, const std::vector<std::string>& arguments) const {
    const fs::path out = folder_.string() + ".out", err = folder_.string() + ".err";
    const pid_t process = fork();
    if (process < 0) throw std::runtime_error("fork failed");
    if (process == 0) child(file, arguments, folder_, out, err, environment);
    int status = 0;
    waitpid(process, &status, 0);
    Result result;
    result.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    result.out = content(out);
    result.err = content(err);
    fs::remove(out);
    fs::remove(err);
    for (std::string* text : {&result.out, &result.err})
        replace_all(*text, folder_.string(), "DIR");
    return result;
}

bool looks_finished(const fs::path& folder) {
    for (const char* name : {"result", ".result.part", "summary.json", "preview.png"}) {
        if (fs::exists(folder / name)) return true;
    }
    return content(folder / "status.json").find("\"done\"") != std::string::npos;
}

}  // namespace dsc::test
