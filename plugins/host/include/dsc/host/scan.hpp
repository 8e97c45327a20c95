#pragma once
// The dress rehearsal: libraries are opened in a child process first, so that one that crashes or hangs when it is
// loaded takes nobody with it.

#include <chrono>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace dsc::host {

/// Why a library was refused.
struct Fault {
    std::filesystem::path file;
    std::string code;
    std::string message;
};

/// Time that one library may take to load and to register its strategies.
inline constexpr std::chrono::milliseconds scan_limit{10000};

/// Opens every library in a child process and lets it register its strategies; for each one nothing, or what became of
/// it: "plugin.crash" with the signal, "plugin.hang", or the error of Host::load that it ends in. The libraries must have
/// passed the gate. Their output is thrown away. One thread at a time, and none beside it. [setup]
std::vector<std::optional<Fault>> scan(std::span<const std::filesystem::path> libraries,
                                       std::chrono::milliseconds limit = scan_limit);

}  // namespace dsc::host
