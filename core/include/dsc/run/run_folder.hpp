#pragma once
// The folder of a run: which folders may be replaced, what they contain, and when a result counts
// as finished.

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace dsc::run {

/// The first of result/surface.obj, .ply, .off and .stl in a run folder; empty if there is none.
/// [setup]
std::filesystem::path result_surface(const std::filesystem::path& run_folder);

class RunLock;

/// Writes in an order that never makes an incomplete run look finished: status.json says "running"
/// first and "done" last; result/ appears complete by a rename. The folder of a failed run contains
/// no result, no summary and no picture.
class RunFolder {
public:
    /// claimed() and clear(Keep::nothing). [setup]
    explicit RunFolder(std::filesystem::path folder);

    /// Creates the folder, or takes over an existing run folder, and owns it from then on; changes
    /// nothing in it. Throws UsageError "run.folder" for a file or any other folder that is not
    /// empty, UsageError "run.busy" if another run owns it, IoError "run.folder" if it cannot be
    /// created. [setup]
    static RunFolder claimed(std::filesystem::path folder);
    ~RunFolder();
    RunFolder(RunFolder&&) noexcept;
    RunFolder& operator=(RunFolder&&) = delete;

    /// What to keep of an earlier run: nothing, or, for a run that is continued, everything except
    /// results. Files that no run writes are always kept; temporary files of a killed run never
    /// are. [setup]
    enum class Keep { nothing, progress };
    void clear(Keep keep) const;

    /// The present owner of the folder, "process 4711 on HOST"; empty if no run owns it. [setup]
    static std::string owner(const std::filesystem::path& folder);

    /// Whether `folder` is a run folder of this program.
    static bool is_ours(const std::filesystem::path& folder);
    /// The run's state in status.json; empty if the folder is not a run folder of this program.
    struct Status {
        std::string state;  ///< running, done, stopped, failed
        std::string hash;   ///< of its resolved experiment
        /// SHA-256 of the plugin of each strategy, by "KIND ID"; empty for a run of an older
        /// version.
        std::map<std::string, std::string> strategies{};
    };
    static std::optional<Status> status(const std::filesystem::path& folder);

    const std::filesystem::path& path() const noexcept { return folder_; }
    std::filesystem::path file(std::string_view name) const { return folder_ / name; }

    /// Writes a file of the folder atomically. Throws IoError. [step]
    void write(std::string_view name, std::string_view content) const;

    /// Creates an empty folder in it and returns its path. Throws IoError. [step]
    std::filesystem::path make(std::string_view name) const;

    /// The folder in which results are written before publish_results() renames it to result/.
    std::filesystem::path staging() const { return folder_ / ".result.part"; }
    /// Creates an empty staging folder. [step]
    void open_staging() const;
    /// Renames the staging folder to result/. [step]
    void publish_results() const;

    /// Removes all results. [step]
    void remove_results() const;

private:
    RunFolder(std::filesystem::path folder, std::unique_ptr<RunLock> lock);
    std::filesystem::path folder_;
    std::unique_ptr<RunLock> lock_;
};

}  // namespace dsc::run
