#pragma once
// The tables that a run writes while it goes on: metrics.csv and events.jsonl.

#include <cstdint>
#include <dsc/run/figures.hpp>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>

namespace dsc::run {

/// How far the tables had come, for a run that goes on from there.
struct LogState {
    std::uint64_t metrics_bytes = 0;
    std::uint64_t events_bytes = 0;
    std::uint64_t columns = 0;  ///< of the observers
};

/// Every row is flushed, so that a reader may follow the run. Throws IoError "io.write".
class RunLog {
public:
    RunLog(const std::filesystem::path& folder, const cloud::Transform& to_normalised);
    /// Goes on after the rows that were there at `from`; later ones are cut off. Throws IoError "io.write" where the files are
    /// shorter.
    RunLog(const std::filesystem::path& folder, const cloud::Transform& to_normalised, const LogState& from);

    /// Once there was a step.
    LogState state();

    void add(const StepMetrics& row);
    void add(const kernel::Event& event);
    void add(const ClassFigures& figures);
    /// Writes what still waits and closes the files.
    void close();

private:
    static void cut(const std::filesystem::path& file, std::uint64_t bytes);
    void write(std::ofstream& stream, const std::filesystem::path& file, const std::string& text);

    std::filesystem::path metrics_file_;
    std::filesystem::path events_file_;
    std::ofstream metrics_;
    std::ofstream events_;
    cloud::Transform to_normalised_;
    std::optional<StepMetrics>
        waiting_;  // row 0, until the first step tells which figures the observers have
    std::optional<std::size_t> columns_;
};

}  // namespace dsc::run
