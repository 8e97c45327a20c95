#pragma once
// One owner per run folder.

#include <filesystem>
#include <string>

namespace dsc::run {

/// The lock of a run folder, the file .lock in it. It is held by the process, so it is gone however the process ends; the
/// file that a killed process leaves is stale, and the next owner takes it over. It holds "PID HOST" for the message. On a
/// file system without locks that text decides: a process of this host that does not exist any more owns nothing.
class RunLock {
public:
    static constexpr const char* name = ".lock";

    /// Throws UsageError "run.busy" where another run owns the folder, IoError "run.folder" where the lock cannot be made.
    /// [setup]
    explicit RunLock(const std::filesystem::path& folder);
    ~RunLock();
    RunLock(RunLock&& other) noexcept;
    RunLock& operator=(RunLock&&) = delete;

    /// Who owns the folder, "process 4711 on HOST"; empty where nobody does. [setup]
    static std::string owner(const std::filesystem::path& folder);

private:
    std::filesystem::path file_;
    int descriptor_ = -1;
};

}  // namespace dsc::run
