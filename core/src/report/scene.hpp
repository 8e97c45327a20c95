#pragma once
// The data of the report's viewer: surfaces, cloud and tets in few bytes, positions with 16 bits
// per coordinate.

#include <filesystem>
#include <string>
#include <vector>

#include <dsc/base/workers.hpp>
#include <dsc/plugin/catalogue.hpp>
#include <dsc/run/input.hpp>

#include "record.hpp"

namespace dsc::report {

/// Limits of the contents of a page. Files are never thinned; pages are, and they say so.
struct SceneLimits {
    std::size_t faces = 40000;       ///< of the result
    std::size_t frame_faces = 6000;  ///< of an intermediate surface
    std::size_t frames = 11;         ///< number of intermediate surfaces
    std::size_t points = 20000;      ///< of the cloud
    std::size_t tets = 120000;       ///< for the cut; 0: no cut
    std::size_t attributes = 6;      ///< number of attributes for colouring a surface
};

/// The source of the cloud: it is read and filtered again unless `input` is given.
struct SceneInput {
    const plugin::Catalogue& catalogue;  ///< makes the filters
    const run::LoadedInput* loaded = nullptr;
};

struct Scene {
    std::string json;                ///< for viewer.js
    std::vector<std::string> notes;  ///< what is thinned or left out, and why
    bool empty = true;               ///< true: there is nothing to draw
    std::vector<double> qualities;   ///< of all tets of the result, if it has a volume file
    std::vector<double> distances;   ///< from the cloud's points to the surface, normalised units
};

/// Reads result/, series/ and the cloud of the configuration. Files that cannot be read become
/// notes. [setup]
Scene make_scene(const RunRecord& record, const SceneLimits& limits, const SceneInput& input,
                 Workers* workers);

/// The first file of the result with one of these extensions; empty if there is none.
std::filesystem::path result_file(const std::filesystem::path& run_folder, const std::string& stem,
                                  const std::vector<std::string>& extensions);

}  // namespace dsc::report
