#pragma once
// One owner per run folder.

#include <filesystem>
#include <string>

namespace dsc::run {

/// The lock of a run folder: the file .lock in it. The process holds the lock, so it is released
/// however the process ends. If a killed process leaves the file, it is stale, and the next owner
/// takes it over. The file contains "PID HOST" for the message. On a file system without locks this
/// text decides: a process of this host that no longer exists owns nothing.
class RunLock {
public:
    static constexpr const char* name = ".lock";

    /// Throws UsageError "run.busy" if another run owns the folder, IoError "run.folder" if the
    /// lock cannot be created. [setup]
    explicit RunLock(const std::filesystem::path& folder);
    ~RunLock();
    RunLock(RunLock&& other) noexcept;
    RunLock& operator=(RunLock&&) = delete;

    /// The owner of the folder, "process 4711 on HOST"; empty if there is none. [setup]
    static std::string owner(const std::filesystem::path& folder);

private:
    std::filesystem::path file_;
    int descriptor_ = -1;
};

}  // namespace dsc::run
