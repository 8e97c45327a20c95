// Texts of provenance.json and of `dsc --version`.
#include "dsc/run/provenance.hpp"

#include <array>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>

#include <pwd.h>
#include <sys/resource.h>
#include <sys/utsname.h>
#include <unistd.h>

#include <Eigen/Core>
#include <boost/version.hpp>
#include <nlohmann/json.hpp>

#include <dsc/base/version.hpp>
#include <dsc/plugin/fingerprint.hpp>

namespace dsc::run {
namespace {

using nlohmann::ordered_json;

std::string cpu_model() {
    std::ifstream file("/proc/cpuinfo");
    std::string line;
    while (std::getline(file, line)) {
        if (line.rfind("model name", 0) != 0) continue;
        const std::size_t colon = line.find(':');
        if (colon != std::string::npos && colon + 2 <= line.size()) return line.substr(colon + 2);
    }
    return "unknown";
}

double memory_mb() {
    return static_cast<double>(sysconf(_SC_PHYS_PAGES)) *
           static_cast<double>(sysconf(_SC_PAGESIZE)) / (1024.0 * 1024.0);
}

/// Properties that determine the speed of a run. The name of the host is private and not included.
ordered_json machine(unsigned threads) {
    utsname name{};
    uname(&name);
    return {{"system", name.sysname},
            {"kernel", name.release},
            {"architecture", name.machine},
            {"cpu", cpu_model()},
            {"cores", sysconf(_SC_NPROCESSORS_ONLN)},
            {"memory_mb", std::floor(memory_mb())},
            {"threads", threads}};
}

/// Times and memory of the whole process up to now.
ordered_json usage(double wall_seconds) {
    const Usage so_far = process_usage();
    return {{"wall_s", wall_seconds},
            {"cpu_s", so_far.cpu_seconds},
            {"peak_rss_mb", so_far.peak_rss_mb}};
}

/// The home folder from the environment, the same without symbolic links, and the one of the user's
/// entry: all of them contain the user's name.
std::vector<std::string> home_folders() {
    std::vector<std::string> folders;
    const auto add = [&](std::string folder) {
        while (folder.size() > 1 && folder.back() == '/') folder.pop_back();
        folders.push_back(std::move(folder));
    };
    if (const char* const home = std::getenv("HOME"); home != nullptr) {
        std::error_code error;
        add(home);
        add(std::filesystem::weakly_canonical(home, error).string());
    }
    if (const passwd* const entry = getpwuid(getuid());
        entry != nullptr && entry->pw_dir != nullptr)
        add(entry->pw_dir);
    return folders;
}

std::string without_homes(std::string text, const std::vector<std::string>& homes) {
    for (const std::string& home : homes) text = without_home(std::move(text), home);
    return text;
}

/// A file name as it would be typed here: relative if it is below the current folder, else below
/// "~" or absolute.
std::string shown(const std::filesystem::path& file, const std::vector<std::string>& homes) {
    std::error_code error;
    const std::filesystem::path here = std::filesystem::current_path(error);
    const std::filesystem::path relative = error ? file : file.lexically_relative(here);
    const bool below = !relative.empty() && *relative.begin() != "..";
    return below ? relative.string() : without_homes(file.string(), homes);
}

/// How the points of the input were varied; the quaternion is w, x, y, z.
ordered_json variation(const cloud::Variation& vary, std::uint64_t seed) {
    ordered_json json = {{"random", "Philox-4x32-10"},
                         {"seed", seed},
                         {"subsample", vary.subsample},
                         {"jitter_spacings", vary.jitter},
                         {"rotation", nullptr}};
    if (vary.rotate) json["rotation"] = cloud::drawn_rotation(seed);
    return json;
}

ordered_json versions() {
    return {{"dsc", DSC_VERSION},
            {"compiler", DSC_RUN_COMPILER},
            {"build", DSC_RUN_BUILD},
            {"eigen", DSC_TEXT(EIGEN_WORLD_VERSION) "." DSC_TEXT(EIGEN_MAJOR_VERSION) "." DSC_TEXT(
                          EIGEN_MINOR_VERSION)},
            {"boost", BOOST_LIB_VERSION},
            {"pcl", DSC_RUN_PCL},
            {"openmesh", DSC_RUN_OPENMESH},
            {"vtk", DSC_RUN_VTK},
            {"embree", DSC_RUN_EMBREE},
            {"yaml-cpp", DSC_RUN_YAML},
            {"fmt", DSC_RUN_FMT}};
}

}  // namespace

std::string utc_now() {
    const std::time_t now = std::time(nullptr);
    std::tm parts{};
    gmtime_r(&now, &parts);
    std::array<char, 32> text{};
    std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%SZ", &parts);
    return text.data();
}

Usage process_usage() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    const auto seconds = [](const timeval& t) {
        return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
    };
    return {seconds(usage.ru_utime) + seconds(usage.ru_stime),
            static_cast<double>(usage.ru_maxrss) / 1024.0};
}

std::string without_home(std::string text, const std::string& home) {
    if (home.size() < 2) return text;
    for (std::size_t at = text.find(home); at != std::string::npos; at = text.find(home, at + 1)) {
        // Only complete folder names match: the home of ann is not that of anna, nor a folder
        // elsewhere with the same ending.
        const std::size_t end = at + home.size();
        const auto part_of_name = [](char c) {
            return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-' ||
                   c == '.' || c == '/';
        };
        if (end < text.size() && text[end] != '/' && part_of_name(text[end])) continue;
        if (at > 0 && part_of_name(text[at - 1])) continue;
        text.replace(at, home.size(), "~");
    }
    return text;
}

std::string provenance_json(const LoadedExperiment& loaded, const plugin::Catalogue& catalogue,
                            const std::string& hash, const std::vector<std::string>& command,
                            unsigned threads, const std::string& started,
                            const std::string& finished, double wall_seconds) {
    const std::vector<std::string> homes = home_folders();
    ordered_json plugins = ordered_json::array();
    for (const plugin::PluginInfo& plugin : catalogue.plugins()) {
        plugins.push_back({{"name", plugin.name},
                           {"version", plugin.version},
                           {"license", plugin.license},
                           {"file", shown(plugin.file, homes)},
                           {"sha256", loaded.files->sha256(plugin.file)},
                           {"fingerprint", plugin.fingerprint}});
    }
    ordered_json inputs = ordered_json::array();
    for (const std::string& file : input_files(loaded, catalogue)) {
        inputs.push_back({{"file", shown(file, homes)},
                          {"bytes", loaded.files->bytes(file)},
                          {"sha256", loaded.files->sha256(file)}});
    }
    ordered_json typed = ordered_json::array();
    for (const std::string& word : command) typed.push_back(without_homes(word, homes));
    ordered_json root = {{"format", "dsc-provenance-1"},
                         {"name", loaded.experiment.name},
                         {"config_sha256", hash},
                         {"seed", loaded.experiment.seed},
                         {"command", typed},
                         {"started", started},
                         {"finished", finished.empty() ? ordered_json() : ordered_json(finished)},
                         {"usage", usage(wall_seconds)},
                         {"versions", versions()},
                         {"fingerprint", std::string(plugin::core_fingerprint())},
                         {"machine", machine(threads)},
                         {"inputs", inputs},
                         {"plugins", plugins}};
    if (const auto& input = loaded.experiment.input; input && input->cloud.vary)
        root["variation"] = variation(*input->cloud.vary, loaded.experiment.seed);
    return root.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

std::string version_text() {
    std::string text =
        "dsc " DSC_VERSION "\ncompiler " DSC_RUN_COMPILER ", " DSC_RUN_BUILD "\nfingerprint ";
    text += plugin::core_fingerprint();
    text += "\nEigen " DSC_TEXT(EIGEN_WORLD_VERSION) "." DSC_TEXT(EIGEN_MAJOR_VERSION) "." DSC_TEXT(
        EIGEN_MINOR_VERSION);
    text += ", Boost " BOOST_LIB_VERSION ", PCL " DSC_RUN_PCL ", OpenMesh " DSC_RUN_OPENMESH
            ", VTK " DSC_RUN_VTK;
    text += ", Embree " DSC_RUN_EMBREE ", yaml-cpp " DSC_RUN_YAML ", fmt " DSC_RUN_FMT "\n";
    return text;
}

}  // namespace dsc::run
