#include <sys/resource.h>
#include <sys/utsname.h>

#include <Eigen/Core>
#include <array>
#include <boost/version.hpp>
#include <ctime>
#include <dsc/base/version.hpp>
#include <dsc/plugin/fingerprint.hpp>
#include <dsc/run/provenance.hpp>
#include <dsc/run/sha256.hpp>
#include <fstream>
#include <nlohmann/json.hpp>

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

ordered_json machine(unsigned threads) {
    utsname name{};
    uname(&name);
    return {{"host", name.nodename},        {"system", name.sysname}, {"release", name.release},
            {"architecture", name.machine}, {"cpu", cpu_model()},     {"threads", threads}};
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
            {"yaml-cpp", DSC_RUN_YAML}};
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
    return {seconds(usage.ru_utime) + seconds(usage.ru_stime), static_cast<double>(usage.ru_maxrss) / 1024.0};
}

std::string provenance_json(const LoadedExperiment& loaded, const plugin::Catalogue& catalogue,
                            const std::string& hash, const std::vector<std::string>& command,
                            unsigned threads, const std::string& started, const std::string& finished) {
    ordered_json plugins = ordered_json::array();
    for (const plugin::PluginInfo& plugin : catalogue.plugins()) {
        plugins.push_back({{"name", plugin.name},
                           {"version", plugin.version},
                           {"license", plugin.license},
                           {"file", plugin.file.string()},
                           {"sha256", sha256_of_file(plugin.file)},
                           {"fingerprint", plugin.fingerprint}});
    }
    ordered_json inputs = ordered_json::array();
    for (const std::string& file : input_files(loaded, catalogue)) {
        inputs.push_back({{"file", file}, {"sha256", sha256_of_file(file)}});
    }
    const ordered_json root = {{"format", "dsc-provenance-1"},
                               {"name", loaded.experiment.name},
                               {"config_sha256", hash},
                               {"seed", loaded.experiment.seed},
                               {"command", command},
                               {"started", started},
                               {"finished", finished.empty() ? ordered_json() : ordered_json(finished)},
                               {"versions", versions()},
                               {"fingerprint", std::string(plugin::core_fingerprint())},
                               {"machine", machine(threads)},
                               {"inputs", inputs},
                               {"plugins", plugins}};
    return root.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

std::string version_text() {
    std::string text = "dsc " DSC_VERSION "\ncompiler " DSC_RUN_COMPILER ", " DSC_RUN_BUILD "\nfingerprint ";
    text += plugin::core_fingerprint();
    text += "\nEigen " DSC_TEXT(EIGEN_WORLD_VERSION) "." DSC_TEXT(EIGEN_MAJOR_VERSION) "." DSC_TEXT(
        EIGEN_MINOR_VERSION);
    text +=
        ", Boost " BOOST_LIB_VERSION ", PCL " DSC_RUN_PCL ", OpenMesh " DSC_RUN_OPENMESH ", VTK " DSC_RUN_VTK;
    text += ", Embree " DSC_RUN_EMBREE ", yaml-cpp " DSC_RUN_YAML "\n";
    return text;
}

}  // namespace dsc::run
