#pragma once
// The folder checkpoint/ of a run: states of the run. Each file is complete or absent, and ends
// with its SHA-256.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "run_log.hpp"

namespace dsc::run {

/// One state, and the values that must match before it can be used.
struct Checkpoint {
    std::string hash;  ///< of the resolved experiment
    std::uint64_t steps = 0;
    double seconds = 0.0;  ///< wall time of the run up to this state
    LogState log;
    std::string state;  ///< of the simulation
};

class Checkpoints {
public:
    /// `keep`: number of checkpoints that are kept, the last ones.
    Checkpoints(std::filesystem::path folder, std::size_t keep)
        : folder_(std::move(folder)), keep_(keep) {}

    /// Writes a checkpoint, then removes old ones. Throws IoError. [step]
    void write(const Checkpoint& checkpoint) const;

    /// The last checkpoint that is complete, belongs to this experiment and this build, and for
    /// which `require` does not throw. Warns about each later one. If none is left, `reason` says
    /// what is wrong with the last one; it stays empty if there is no file. [setup]
    std::optional<Checkpoint> last(const std::string& hash,
                                   const std::function<void(const Checkpoint&)>& require,
                                   std::string* reason) const;

private:
    std::filesystem::path folder_;
    std::size_t keep_;
};

}  // namespace dsc::run
