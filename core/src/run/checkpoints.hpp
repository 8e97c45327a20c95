#pragma once
// checkpoint/ of a run folder: states of the run, each a file that is whole or not there, sealed by its SHA-256.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "run_log.hpp"

namespace dsc::run {

/// One state, and what must fit for it to be of use.
struct Checkpoint {
    std::string hash;  ///< of the resolved experiment
    std::uint64_t steps = 0;
    double seconds = 0.0;  ///< wall time of the run so far
    LogState log;
    std::string state;  ///< of the driver
};

class Checkpoints {
public:
    /// `keep`: how many are kept, the last ones.
    Checkpoints(std::filesystem::path folder, std::size_t keep) : folder_(std::move(folder)), keep_(keep) {}

    /// Writes it, then removes those that are too old. Throws IoError. [step]
    void write(const Checkpoint& checkpoint) const;

    /// The last one that is whole, of this experiment and of this build, and that `require` does not throw for; warns of each
    /// later one. Where none is left, `reason` tells what is wrong with the last; it stays empty where there is no file. [setup]
    std::optional<Checkpoint> last(const std::string& hash, const std::function<void(const Checkpoint&)>& require,
                                   std::string* reason) const;

private:
    std::filesystem::path folder_;
    std::size_t keep_;
};

}  // namespace dsc::run
