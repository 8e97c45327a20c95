#pragma once
// The notes on a plugin, libdsc_NAME.check.yaml beside it or a given file: values that the tests
// cannot guess, and waived tests.
//
//     strategies:
//       - kind: initial_mesh
//         id: my_reader
//         parameters: {file: cube.dsc}             # file names are relative to the notes
//         waive: {param.fuzz: any other file is refused}

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <dsc/config/node.hpp>
#include <dsc/plugin/kind.hpp>

namespace dsc::conformance {

struct StrategyNotes {
    plugin::Kind kind{};
    std::string id;
    config::ConfigNode parameters;             ///< a map, or null
    std::map<std::string, std::string> waive;  ///< test and reason
};

using Notes = std::vector<StrategyNotes>;

/// Throws ConfigError, IoError.
Notes read_notes(const std::filesystem::path& file);
/// The notes beside the plugin in this file; empty if there are none. Throws as read_notes().
Notes notes_beside(const std::filesystem::path& library);

/// The notes on a strategy; null if there are none.
const StrategyNotes* find(const Notes& notes, plugin::Kind kind, const std::string& id);

}  // namespace dsc::conformance
