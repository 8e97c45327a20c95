#pragma once
// The folder of a run: who may be replaced, what stands in it, and when a result counts as finished.

#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>

namespace dsc::run {

/// Writes in such an order that nothing half-done looks finished: status.json says "running" first and "done" last,
/// result/ appears whole by a rename. A folder whose run failed holds no result, no summary and no picture.
class RunFolder {
public:
    /// Creates the folder, or takes over a run folder of ours whose results it removes. Files that no run writes stay,
    /// temporary ones that a killed run has left do not.
    /// Throws UsageError "run.folder" for a file or any other folder that is not empty, IoError "run.folder" when it
    /// cannot be made. [setup]
    explicit RunFolder(std::filesystem::path folder);
    /// The same for a run that goes on: what it has written so far stays, but for results.
    static RunFolder resumed(std::filesystem::path folder);

    /// Whether `folder` is a run folder of ours.
    static bool is_ours(const std::filesystem::path& folder);
    /// What status.json says of the run; nothing where the folder is none of ours.
    struct Status {
        std::string state;  ///< running, done, stopped, failed
        std::string hash;   ///< of its resolved experiment
    };
    static std::optional<Status> status(const std::filesystem::path& folder);

    const std::filesystem::path& path() const noexcept { return folder_; }
    std::filesystem::path file(std::string_view name) const { return folder_ / name; }

    /// Writes a file of the folder atomically. Throws IoError. [step]
    void write(std::string_view name, std::string_view content) const;

    /// Makes an empty folder in it and returns its path. Throws IoError. [step]
    std::filesystem::path make(std::string_view name) const;

    /// The folder in which results are written before publish_results() renames it to result/.
    std::filesystem::path staging() const { return folder_ / ".result.part"; }
    /// Makes an empty staging folder. [step]
    void open_staging() const;
    /// The staged files become result/. [step]
    void publish_results() const;

    /// Removes everything that looks like a result. [step]
    void remove_results() const;

private:
    enum class Keep { nothing, progress };
    RunFolder(std::filesystem::path folder, Keep keep);
    std::filesystem::path folder_;
};

}  // namespace dsc::run
