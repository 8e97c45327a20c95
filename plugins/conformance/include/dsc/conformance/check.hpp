#pragma once
// `dsc plugin check`: whether a plugin keeps what a plugin promises. Every test runs in a process of its own, so that
// whatever a plugin does ends that process and becomes a line of the report.

#include <chrono>
#include <cstdint>
#include <dsc/host/search_path.hpp>
#include <dsc/plugin/kind.hpp>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace dsc::conformance {

/// How much is asked; each level includes those before it.
enum class Level : std::uint8_t { smoke, standard, strict };
std::string_view name(Level level);
std::optional<Level> find_level(std::string_view name);

enum class Status : std::uint8_t { pass, warn, skip, fail, crash, timeout };
std::string_view name(Status status);
/// Fail, crash or timeout.
bool is_failure(Status status);

/// A test as it is listed.
struct TestInfo {
    std::string id;  ///< "det.threads"
    Level level = Level::smoke;
    bool of_library = false;  ///< once a library; otherwise once a strategy
    std::string doc;          ///< what is asked, one sentence
};

/// All tests in the order in which they run. [setup]
std::vector<TestInfo> tests();

/// What became of one test.
struct Outcome {
    std::string test;
    std::string strategy;  ///< "velocity 'rotate'", empty for a test of the library
    Status status = Status::pass;
    std::string message;  ///< why, unless it passed
    double seconds = 0;
};

/// One strategy of the library.
struct StrategyName {
    plugin::Kind kind{};
    std::string id;
};

struct CheckOptions {
    Level level = Level::standard;
    std::uint64_t seed = 1;                  ///< of all that is random in the tests
    unsigned fuzz = 20;                      ///< random parameter sets
    std::chrono::milliseconds limit{30000};  ///< of one test; ten times as much under a sanitizer
    std::vector<std::string> only;           ///< ids of tests; empty: all of the level
    std::vector<StrategyName> strategies;    ///< empty: all of the library
    std::filesystem::path notes;  ///< empty: libdsc_NAME.check.yaml beside the plugin, where there is one
    std::vector<host::SearchEntry> search;           ///< plugins for strategies that nest others
    bool in_process = false;                         ///< no process of its own, for a debugger
    std::function<void(const Outcome&)> on_outcome;  ///< as soon as it is known
};

struct Report {
    std::filesystem::path file;
    std::string plugin;  ///< name and version; empty where the library does not load
    Level level = Level::standard;
    std::uint64_t seed = 1;
    std::vector<Outcome> outcomes;

    bool passed() const;
    std::size_t count(Status status) const;
};

/// Checks the plugin in `file`. Notes give parameters that have no default and waive
/// tests with a reason (share/doc/write-a-strategy.md). Throws PluginError "plugin.open", UsageError for an unknown test or
/// strategy, ConfigError for faulty notes; what the plugin does becomes outcomes. [setup]
Report check(const std::filesystem::path& file, const CheckOptions& options);

/// A table with a line a test, and a last line of sums. [setup]
std::string text(const Report& report);
/// One line of it, and the last one.
std::string text(const Outcome& outcome);
std::string sums(const Report& report);
/// [setup]
std::string json(const Report& report);
/// JUnit's XML, which build servers read. [setup]
std::string junit(const Report& report);

}  // namespace dsc::conformance
