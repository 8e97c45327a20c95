#pragma once
// The exceptions that the library throws. Library code throws; it never prints and never exits.

#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>

namespace dsc {

/// Exit codes of the `dsc` command; each error class belongs to one.
enum class ExitCode : int { ok = 0, internal = 1, usage = 2, config = 3, plugin = 4, geometry = 5, io = 6, stopped = 75 };

/// Base of all errors. `code` is stable and documented ("io.truncated"). `what()` is one message for a person; it names the
/// file, the place, the cause and the remedy.
class Error : public std::runtime_error {
public:
    Error(ExitCode exit_code, std::string code, const std::string& message)
        : std::runtime_error(message), exit_code_(exit_code), code_(std::move(code)) {}
    ~Error() override;
    ExitCode exit_code() const noexcept { return exit_code_; }
    const std::string& code() const noexcept { return code_; }

private:
    ExitCode exit_code_;
    std::string code_;
};

/// A wrong call on the command line.
class UsageError : public Error {
public:
    UsageError(std::string code, const std::string& message) : Error(ExitCode::usage, std::move(code), message) {}
    ~UsageError() override;
};

/// A wrong experiment. The message may contain several diagnostics of one or more lines each.
class ConfigError : public Error {
public:
    ConfigError(std::string code, const std::string& message) : Error(ExitCode::config, std::move(code), message) {}
    ~ConfigError() override;
};

/// A plugin that does not load or does not fit this build.
class PluginError : public Error {
public:
    PluginError(std::string code, const std::string& message) : Error(ExitCode::plugin, std::move(code), message) {}
    ~PluginError() override;
};

/// A strategy that threw, returned NaN or returned the wrong size.
class StrategyError : public Error {
public:
    StrategyError(std::string code, const std::string& message) : Error(ExitCode::plugin, std::move(code), message) {}
    ~StrategyError() override;
};

/// Geometry or numbers that the program cannot use: inverted tets, coplanar clouds, non-manifold labels.
class GeometryError : public Error {
public:
    GeometryError(std::string code, const std::string& message) : Error(ExitCode::geometry, std::move(code), message) {}
    ~GeometryError() override;
};

/// A file that cannot be read or written.
class IoError : public Error {
public:
    IoError(std::string code, const std::string& message) : Error(ExitCode::io, std::move(code), message) {}
    /// Message "FILE:PLACE: CAUSE; REMEDY". `place` is a line ("12") or a byte range and may be empty.
    IoError(std::string code, std::string_view file, std::string_view place, std::string_view cause,
            std::string_view remedy);
    ~IoError() override;
};

/// The caller asked to stop.
class CancelledError : public Error {
public:
    explicit CancelledError(const std::string& message) : Error(ExitCode::stopped, "run.cancelled", message) {}
    ~CancelledError() override;
};

}  // namespace dsc
