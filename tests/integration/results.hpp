#pragma once
// What the tests of whole jobs ask of a run folder.

#include <dsc/host/host.hpp>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "../cli/process.hpp"

namespace dsc::test {

/// What must hold of every result, on the files as they are: valid tets that fill the box, a surface that is their
/// interface, a solid, and free of self-intersections as CGAL sees it.
void check_result(const std::filesystem::path& folder);

nlohmann::json summary_of(const Cli& cli, const std::string& folder);

/// All strategies of this build.
void load_strategies(host::Host& host);

/// Path of an experiment in configs/.
std::string config(const std::string& name);

}  // namespace dsc::test
