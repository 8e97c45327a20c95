#pragma once
// Diagnostics: collects every fault of a configuration, so that a user sees all faults at once.

#include <cstddef>
#include <string>
#include <vector>

#include <dsc/config/source.hpp>

namespace dsc::config {

enum class Severity { warning, error };

/// One fault. The hint is printed after the caret; each note is printed on its own line.
struct Diagnostic {
    Severity severity = Severity::error;
    std::string code;  ///< stable: "config.unknown_key"
    SourcePosition position;
    std::string message;
    std::string hint;                ///< may be empty
    std::vector<std::string> notes;  ///< may be empty
};

/// One diagnostic as text, lines ended by '\n':
/// ```
/// a.yaml:14:5: error: unknown key 'alhpa' in velocity 'point_cloud'
///    14 |     alhpa: 0.3
///       |     ^~~~~  did you mean 'alpha'? (real, (0, 1], default 0.2)
///       note: accepted keys: alpha, beta
/// ```
/// A value from the command line or made by code has no line to show; its hint becomes a note.
std::string format(const Diagnostic& diagnostic);

/// Collects diagnostics. [setup]
class Diagnostics {
public:
    void error(std::string code, SourcePosition position, std::string message,
               std::string hint = {}, std::vector<std::string> notes = {});
    void warning(std::string code, SourcePosition position, std::string message,
                 std::string hint = {}, std::vector<std::string> notes = {});

    std::size_t error_count() const noexcept { return errors_; }
    bool has_errors() const noexcept { return errors_ > 0; }
    /// In the order in which they were found.
    const std::vector<Diagnostic>& all() const noexcept { return all_; }
    /// Texts of all diagnostics of one severity, sorted by place within each file; after 100 only
    /// their number.
    std::string text(Severity severity) const;
    /// Throws ConfigError with all errors and the last line "N errors; nothing was run". Its code
    /// is the code of the only error, or "config.invalid" for several. Does nothing if there is no
    /// error.
    void throw_if_errors() const;

private:
    std::vector<Diagnostic> all_;
    std::size_t errors_ = 0;
};

/// Throws ConfigError with this one diagnostic, in the same form. For a fault after which nothing
/// else can be checked.
[[noreturn]] void fail(std::string code, SourcePosition position, std::string message,
                       std::string hint = {}, std::vector<std::string> notes = {});

}  // namespace dsc::config
