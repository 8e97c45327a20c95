#pragma once
// The tables that a run writes during the steps: metrics.csv and events.jsonl.

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>

#include <dsc/run/figures.hpp>
#include <dsc/run/metrics.hpp>

namespace dsc::run {

/// The length of the tables, for a run that continues later.
struct LogState {
    std::uint64_t metrics_bytes = 0;
    std::uint64_t events_bytes = 0;
    std::uint64_t columns = 0;  ///< of the observers
};

/// Every row is flushed, so that a reader can follow the run. Throws IoError "io.write".
class RunLog {
public:
    RunLog(const std::filesystem::path& folder, const cloud::Transform& to_normalised);
    /// Continues after the rows that existed at `from`; later rows are removed. Throws IoError
    /// "io.write" if the files are shorter.
    RunLog(const std::filesystem::path& folder, const cloud::Transform& to_normalised,
           const LogState& from);

    /// Valid after the first step.
    LogState state();

    void add(const StepMetrics& row);
    void add(const kernel::Event& event);
    void add(const ClassFigures& figures);
    /// Writes waiting rows and closes the files.
    void close();

private:
    static void cut(const std::filesystem::path& file, std::uint64_t bytes);
    void write(std::ofstream& stream, const std::filesystem::path& file, const std::string& text);

    std::filesystem::path metrics_file_;
    std::filesystem::path events_file_;
    std::ofstream metrics_;
    std::ofstream events_;
    cloud::Transform to_normalised_;
    std::optional<StepMetrics> waiting_;  // row 0, until the first step shows which figures the
                                          // observers have
    std::optional<std::size_t> columns_;
};

}  // namespace dsc::run
