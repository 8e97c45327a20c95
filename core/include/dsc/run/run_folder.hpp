#pragma once
// The folder of a run: who may be replaced, what stands in it, and when a result counts as finished.

#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace dsc::run {

class RunLock;

/// Writes in such an order that nothing half-done looks finished: status.json says "running" first and "done" last,
/// result/ appears whole by a rename. A folder whose run failed holds no result, no summary and no picture.
class RunFolder {
public:
    /// claimed() and clear(Keep::nothing). [setup]
    explicit RunFolder(std::filesystem::path folder);

    /// Creates the folder, or takes over a run folder of ours, and owns it from then on; changes nothing in it.
    /// Throws UsageError "run.folder" for a file or any other folder that is not empty, UsageError "run.busy" where another
    /// run owns it, IoError "run.folder" when it cannot be made. [setup]
    static RunFolder claimed(std::filesystem::path folder);
    ~RunFolder();
    RunFolder(RunFolder&&) noexcept;
    RunFolder& operator=(RunFolder&&) = delete;

    /// What stays of a run that was there before: nothing, or for a run that goes on all but results. Files that no run
    /// writes stay always, temporary ones that a killed run has left never do. [setup]
    enum class Keep { nothing, progress };
    void clear(Keep keep) const;

    /// Who owns the folder now, "process 4711 on HOST"; empty where no run does. [setup]
    static std::string owner(const std::filesystem::path& folder);

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
    RunFolder(std::filesystem::path folder, std::unique_ptr<RunLock> lock);
    std::filesystem::path folder_;
    std::unique_ptr<RunLock> lock_;
};

}  // namespace dsc::run
