#pragma once
// What the tests of whole jobs ask of a run folder.

#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include <dsc/host/host.hpp>
#include <dsc/mesh/tet_mesh.hpp>

#include "../cli/process.hpp"

namespace dsc::test {

/// What must hold of every result, on the files as they are: valid tets that fill the box, a
/// surface that is their interface, a solid, and free of self-intersections as CGAL sees it.
void check_result(const std::filesystem::path& folder);

/// The same where two labels above 0 or more meet: the surface of each label is a solid, the
/// interface as a whole is not.
void check_phases(const std::filesystem::path& folder, const std::vector<mesh::Label>& labels);

nlohmann::json summary_of(const Cli& cli, const std::string& folder);

/// All strategies of this build.
void load_strategies(host::Host& host);

/// Path of an experiment in configs/.
std::string config(const std::string& name);

}  // namespace dsc::test
