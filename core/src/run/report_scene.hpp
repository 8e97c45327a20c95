#pragma once
// What the report's viewer draws: surfaces, cloud and tets in few bytes, positions in 16 bits a coordinate.

#include <dsc/base/workers.hpp>
#include <dsc/mesh/tet_mesh.hpp>
#include <dsc/plugin/catalogue.hpp>
#include <dsc/run/input.hpp>
#include <dsc/surface/triangle_mesh.hpp>
#include <filesystem>
#include <string>
#include <vector>

#include "report_record.hpp"

namespace dsc::run {

/// Bounds of what goes into a page. Files are never thinned, pages are, and they say so.
struct SceneLimits {
    std::size_t faces = 40000;        ///< of the result
    std::size_t frame_faces = 6000;   ///< of a surface on the way
    std::size_t frames = 11;          ///< surfaces on the way
    std::size_t points = 20000;       ///< of the cloud
    std::size_t tets = 120000;        ///< for the cut; 0: no cut
    std::size_t attributes = 6;       ///< to colour a surface by
};

/// Where the cloud comes from: it is read and filtered again unless it is given.
struct SceneInput {
    const plugin::Catalogue& catalogue;  ///< makes the filters
    const LoadedInput* loaded = nullptr;
};

struct Scene {
    std::string json;                ///< for viewer.js
    std::vector<std::string> notes;  ///< what is thinned or left out, and why
    bool empty = true;               ///< nothing to draw
    std::vector<double> qualities;   ///< of all tets of the result, where it has a volume file
    std::vector<double> distances;   ///< from the cloud's points to the surface, normalised units
};

/// Reads result/, series/ and the cloud that the configuration names. What cannot be read becomes a note. [setup]
Scene make_scene(const RunRecord& record, const SceneLimits& limits, const SceneInput& input, Workers* workers);

/// The first file of the result with one of these extensions; empty where there is none.
std::filesystem::path result_file(const std::filesystem::path& run_folder, const std::string& stem,
                                  const std::vector<std::string>& extensions);

}  // namespace dsc::run
