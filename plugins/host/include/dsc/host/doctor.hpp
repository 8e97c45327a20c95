#pragma once
// Finds out step by step why a file is not a working plugin.

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include <dsc/host/search_path.hpp>

namespace dsc::host {

/// One step of loading. `text` states what was found, or the cause and the remedy if the step
/// failed.
struct Examination {
    enum class Result { ok, note, failed, not_reached };
    std::string step;
    Result result = Result::not_reached;
    std::string text;
};

/// Repeats the steps of Host::load in the same order, and stops at the first step that fails: the
/// file, who may write it, the entry, the build, loading, registering, and that no plugin on
/// `search` has one of its ids. A Python file has neither an entry nor a build. [setup]
std::vector<Examination> examine(const std::filesystem::path& file,
                                 std::span<const SearchEntry> search);

/// Whether no step failed. [setup]
bool healthy(const std::vector<Examination>& examinations);

}  // namespace dsc::host
