#pragma once
// The sections of a report, as HTML.

#include <string>
#include <vector>

#include "report_record.hpp"
#include "report_scene.hpp"

namespace dsc::run {

std::string headline_section(const RunRecord& record);
std::string warnings_section(const RunRecord& record);
/// How well the surface explains its points; empty without a cloud.
std::string coverage_section(const RunRecord& record);
/// What filters say of the cloud; empty where they say nothing.
std::string notes_section(const RunRecord& record);
std::string viewer_section(const RunRecord& record, const Scene& scene);
std::string thesis_section(const RunRecord& record);
std::string plots_section(const RunRecord& record, const Scene& scene);
std::string time_section(const RunRecord& record);
std::string topology_section(const RunRecord& record);
/// Statistics of the cloud and what the initial mesh told; empty without both.
std::string cloud_section(const RunRecord& record);
std::string config_section(const RunRecord& record);
std::string provenance_section(const RunRecord& record);

/// A viewer that viewer.js brings to life: the scene and the picture that stands in for it without WebGL. `id` is plain.
std::string viewer(const RunRecord& record, const Scene& scene, const std::string& id);

/// The figures that sum up a run: name and value, both for people.
std::vector<std::pair<std::string, std::string>> key_figures(const RunRecord& record);

/// The phases and their wall seconds, what is left as "other".
std::vector<std::pair<std::string, double>> phases(const RunRecord& record);

std::string section(const std::string& title, const std::string& body, const std::string& classes = "");

}  // namespace dsc::run
