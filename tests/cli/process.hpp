#pragma once
// Runs the real `dsc` in a folder of its own and keeps what it said.

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace dsc::test {

struct Result {
    int code = -1;  ///< exit code; 128 + signal for a killed process
    std::string out;
    std::string err;
};

/// A scratch folder and the command run inside it.
class Cli {
public:
    Cli();
    ~Cli();
    Cli(const Cli&) = delete;
    Cli& operator=(const Cli&) = delete;

    const std::filesystem::path& folder() const { return folder_; }
    /// Name of the file, made with its folders.
    std::string write(const std::string& name, const std::string& content) const;
    std::string read(const std::string& name) const;
    bool exists(const std::string& name) const { return std::filesystem::exists(folder_ / name); }

    /// Variables of the next calls; an empty value removes one.
    std::map<std::string, std::string> environment;

    /// `dsc` with these arguments, the scratch folder as the current one. The folder's path is
    /// shown as "DIR" in what was said.
    Result dsc(const std::vector<std::string>& arguments) const;
    /// Another program instead of `dsc`.
    Result program(const std::string& file, const std::vector<std::string>& arguments) const;

private:
    std::filesystem::path folder_;
};

/// Whether `folder` holds anything that looks like the result of a run.
bool looks_finished(const std::filesystem::path& folder);

}  // namespace dsc::test
