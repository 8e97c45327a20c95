#pragma once
// The trial load: libraries are opened in a child process first, so that a library that crashes or
// hangs when it is loaded does not affect this process.

#include <chrono>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <dsc/base/error.hpp>

namespace dsc::host {

/// Why a library was refused.
struct Fault {
    std::filesystem::path file;
    PluginError error;
};

/// Time that one library may take to load and to register its strategies.
inline constexpr std::chrono::milliseconds scan_limit{10000};

/// Opens every library in a child process and lets it register its strategies; returns for each
/// library nothing, or its fault: "plugin.crash" with the signal, "plugin.hang", or the error of
/// Host::load. The libraries must have passed the gate. Their output is dropped. No other thread
/// may run at the same time. [setup]
std::vector<std::optional<Fault>> scan(std::span<const std::filesystem::path> libraries,
                                       std::chrono::milliseconds limit = scan_limit);

}  // namespace dsc::host
