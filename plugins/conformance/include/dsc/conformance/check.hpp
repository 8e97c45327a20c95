#pragma once
// `dsc plugin check`: runs the conformance tests on a plugin. Every test runs in its own process,
// so that a plugin can at worst end that process, and the report states this.

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <dsc/host/search_path.hpp>
#include <dsc/plugin/kind.hpp>

namespace dsc::conformance {

/// How much is tested; each level includes the levels before it.
enum class Level : std::uint8_t { smoke, standard, strict };
std::string_view name(Level level);
std::optional<Level> find_level(std::string_view name);

enum class Status : std::uint8_t { pass, warn, skip, fail, crash, timeout };
std::string_view name(Status status);
/// Whether the status is fail, crash or timeout.
bool is_failure(Status status);

/// A test as shown in the list.
struct TestInfo {
    std::string id;  ///< "det.threads"
    Level level = Level::smoke;
    bool of_library = false;  ///< runs once per library; otherwise once per strategy
    std::string doc;          ///< what is required, one sentence
};

/// All tests in the order in which they run. [setup]
std::vector<TestInfo> tests();

/// The outcome of one test.
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
    std::uint64_t seed = 1;                  ///< random seed of the tests
    unsigned fuzz = 20;                      ///< number of random parameter sets
    std::chrono::milliseconds limit{30000};  ///< time limit per test; ten times as much under a
                                             ///< sanitizer
    std::vector<std::string> only;           ///< ids of tests; empty: all tests of the level
    std::vector<StrategyName> strategies;    ///< empty: all strategies of the library
    std::filesystem::path notes;  ///< empty: libdsc_NAME.check.yaml beside the plugin, if it exists
    std::vector<host::SearchEntry> search;  ///< where to find plugins for nested strategies
    bool in_process = false;                ///< all tests run in this process, for debugging
    std::function<void(const Outcome&)> on_outcome;  ///< called as soon as an outcome is known
};

struct Report {
    std::filesystem::path file;
    std::string plugin;  ///< name and version; empty if the library does not load
    Level level = Level::standard;
    std::uint64_t seed = 1;
    std::vector<Outcome> outcomes;

    bool passed() const;
    std::size_t count(Status status) const;
};

/// Checks the plugin in `file`. The notes contain values for parameters without a default, and
/// waive tests with a reason (share/doc/write-a-strategy.md). Throws PluginError "plugin.open",
/// UsageError for an unknown test or strategy, ConfigError for faulty notes; everything that the
/// plugin does becomes an outcome. [setup]
Report check(const std::filesystem::path& file, const CheckOptions& options);

/// A table with one line per test, and a last line with sums. [setup]
std::string text(const Report& report);
/// One line of the table, and its last line.
std::string text(const Outcome& outcome);
std::string sums(const Report& report);
/// [setup]
std::string json(const Report& report);
/// JUnit XML, which build servers read. [setup]
std::string junit(const Report& report);

}  // namespace dsc::conformance
