#pragma once
// The intermediate states in the folder of a run: which ones a report shows, and which ones exist.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include <dsc/io/series.hpp>

namespace dsc::run {

/// Number of surfaces that a report shows, including the result.
inline constexpr std::size_t report_frames = 12;

/// The steps whose surfaces are kept for a report if there is no `output.series`, without the
/// result. They are close together at the start, where the surface changes most.
std::set<std::uint64_t> report_steps(std::uint64_t planned);

/// The states of `kind` ("surface", "volume") in a run folder, by step.
std::vector<io::SeriesEntry> kept_states(const std::filesystem::path& run_folder,
                                         const std::string& kind);

}  // namespace dsc::run
