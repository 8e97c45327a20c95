#pragma once
// The sections of a report, as HTML.

#include <string>
#include <vector>

#include "record.hpp"
#include "scene.hpp"

namespace dsc::report {

std::string headline_section(const RunRecord& record);
std::string warnings_section(const RunRecord& record);
/// Agreement of the surface with its points; empty without a cloud.
std::string coverage_section(const RunRecord& record);
/// The notes of the filters; empty if there are none.
std::string notes_section(const RunRecord& record);
std::string viewer_section(const RunRecord& record, const Scene& scene);
std::string thesis_section(const RunRecord& record);
std::string plots_section(const RunRecord& record, const Scene& scene);
std::string time_section(const RunRecord& record);
std::string topology_section(const RunRecord& record);
/// What each refinement asked for, and what is left of it; empty without refinements.
std::string refinement_section(const RunRecord& record);
/// Statistics of the cloud and figures of the initial mesh; empty if there are neither.
std::string cloud_section(const RunRecord& record);
std::string config_section(const RunRecord& record);
std::string provenance_section(const RunRecord& record);

/// A viewer for viewer.js: the scene, and a picture for browsers without WebGL. `id` must be a
/// plain word.
std::string viewer(const RunRecord& record, const Scene& scene, const std::string& id);

/// The main figures of a run: names and values for people.
std::vector<std::pair<std::string, std::string>> key_figures(const RunRecord& record);

/// The phases and their wall seconds; the rest is "other".
std::vector<std::pair<std::string, double>> phases(const RunRecord& record);

std::string section(const std::string& title, const std::string& body,
                    const std::string& classes = "");

}  // namespace dsc::report
