#pragma once
// The exceptions that the library throws. Library code throws; it never prints and never exits.

#include <stdexcept>
#include <string>
#include <string_view>

namespace dsc {

/// Exit codes of the `dsc` command; each error class belongs to one.
enum class ExitCode : int {
    ok = 0,
    internal = 1,
    usage = 2,
    config = 3,
    plugin = 4,
    geometry = 5,
    io = 6,
    stopped = 75
};

/// Base of all errors. `code` is stable and documented ("io.truncated"). `what()` is one message
/// for a person: "PLACE: CAUSE; REMEDY". The place is a file with its line, the name of a cloud or
/// of a strategy; it and the remedy may be empty.
class Error : public std::runtime_error {
public:
    Error(ExitCode exit_code, std::string code, std::string_view place, std::string_view cause,
          std::string_view remedy);
    /// A message without parts, such as a list of diagnostics: all of it is the cause.
    Error(ExitCode exit_code, std::string code, const std::string& message)
        : std::runtime_error(message),
          exit_code_(exit_code),
          code_(std::move(code)),
          cause_(message) {}
    ~Error() override;
    ExitCode exit_code() const noexcept { return exit_code_; }
    const std::string& code() const noexcept { return code_; }
    const std::string& place() const noexcept { return place_; }
    const std::string& cause() const noexcept { return cause_; }
    const std::string& remedy() const noexcept { return remedy_; }

private:
    ExitCode exit_code_;
    std::string code_, place_, cause_, remedy_;
};

/// A wrong call on the command line.
class UsageError : public Error {
public:
    UsageError(std::string code, const std::string& message)
        : Error(ExitCode::usage, std::move(code), message) {}
    UsageError(std::string code, std::string_view place, std::string_view cause,
               std::string_view remedy)
        : Error(ExitCode::usage, std::move(code), place, cause, remedy) {}
    ~UsageError() override;
};

/// A wrong experiment. The message may contain several diagnostics of one or more lines each.
class ConfigError : public Error {
public:
    ConfigError(std::string code, const std::string& message)
        : Error(ExitCode::config, std::move(code), message) {}
    ConfigError(std::string code, std::string_view place, std::string_view cause,
                std::string_view remedy)
        : Error(ExitCode::config, std::move(code), place, cause, remedy) {}
    ~ConfigError() override;
};

/// A plugin that does not load or does not fit this build.
class PluginError : public Error {
public:
    PluginError(std::string code, const std::string& message)
        : Error(ExitCode::plugin, std::move(code), message) {}
    PluginError(std::string code, std::string_view place, std::string_view cause,
                std::string_view remedy)
        : Error(ExitCode::plugin, std::move(code), place, cause, remedy) {}
    ~PluginError() override;
};

/// A strategy that threw, returned NaN or returned the wrong size.
class StrategyError : public Error {
public:
    StrategyError(std::string code, const std::string& message)
        : Error(ExitCode::plugin, std::move(code), message) {}
    StrategyError(std::string code, std::string_view place, std::string_view cause,
                  std::string_view remedy)
        : Error(ExitCode::plugin, std::move(code), place, cause, remedy) {}
    ~StrategyError() override;
};

/// Geometry or numbers that the program cannot use: inverted tets, coplanar clouds, non-manifold
/// labels.
class GeometryError : public Error {
public:
    GeometryError(std::string code, const std::string& message)
        : Error(ExitCode::geometry, std::move(code), message) {}
    GeometryError(std::string code, std::string_view place, std::string_view cause,
                  std::string_view remedy)
        : Error(ExitCode::geometry, std::move(code), place, cause, remedy) {}
    ~GeometryError() override;
};

/// A file that cannot be read or written.
class IoError : public Error {
public:
    IoError(std::string code, const std::string& message)
        : Error(ExitCode::io, std::move(code), message) {}
    /// Message "FILE:LINE: CAUSE; REMEDY". `line` may also be a byte range, or empty.
    IoError(std::string code, std::string_view file, std::string_view line, std::string_view cause,
            std::string_view remedy);
    ~IoError() override;
};

/// The caller asked to stop.
class CancelledError : public Error {
public:
    explicit CancelledError(const std::string& message)
        : Error(ExitCode::stopped, "run.cancelled", message) {}
    ~CancelledError() override;
};

}  // namespace dsc
