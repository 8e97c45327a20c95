// Claims, clears and fills the folder of a run.
#include "dsc/run/run_folder.hpp"

#include <array>
#include <fstream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <dsc/base/error.hpp>
#include <dsc/io/atomic_file.hpp>

#include "run_lock.hpp"

namespace dsc::run {
namespace {

namespace fs = std::filesystem;

/// The files that a run writes. Those that look like a result come first.
constexpr std::array result_names = {"result", ".result.part", "summary.json", "preview.png",
                                     "report.html"};
constexpr std::array other_names = {"metrics.csv",     "events.jsonl", "config.resolved.yaml",
                                    "provenance.json", "checkpoint",   "last_good",
                                    "series"};

[[noreturn]] void cannot(const fs::path& folder, const char* what, const std::error_code& error) {
    throw IoError("run.folder", folder.string(), "", fmt::format("{}: {}", what, error.message()),
                  "choose another folder with -o or make this one writable");
}

void discard(const fs::path& path) {
    std::error_code error;
    fs::remove_all(path, error);
    if (error) cannot(path, "cannot be removed", error);
}

}  // namespace

std::optional<RunFolder::Status> RunFolder::status(const fs::path& folder) {
    std::ifstream file(folder / "status.json");
    if (!file) return std::nullopt;
    const nlohmann::json status = nlohmann::json::parse(file, nullptr, false);
    const auto text = [&status](const char* key) {
        const auto found = status.find(key);
        return found != status.end() && found->is_string() ? found->get<std::string>()
                                                           : std::string();
    };
    if (!status.is_object() || text("format") != "dsc-run-1") return std::nullopt;
    Status found{text("state"), text("config_sha256")};
    const auto strategies = status.find("strategies");
    if (strategies != status.end() && strategies->is_object()) {
        for (const auto& item : strategies->items()) {
            if (item.value().is_string())
                found.strategies[item.key()] = item.value().get<std::string>();
        }
    }
    return found;
}

bool RunFolder::is_ours(const fs::path& folder) { return status(folder).has_value(); }

RunFolder::RunFolder(fs::path folder, std::unique_ptr<RunLock> lock)
    : folder_(std::move(folder)), lock_(std::move(lock)) {}

RunFolder::RunFolder(fs::path folder) : RunFolder(claimed(std::move(folder))) {
    clear(Keep::nothing);
}

RunFolder::~RunFolder() = default;
RunFolder::RunFolder(RunFolder&&) noexcept = default;

RunFolder RunFolder::claimed(fs::path folder) {
    std::error_code error;
    const fs::file_status status = fs::status(folder, error);
    if (fs::exists(status) && !fs::is_directory(status)) {
        throw UsageError("run.folder", folder.string(), "is a file", "name a folder with -o");
    }
    if (fs::is_directory(status)) {
        // A run that was killed before it wrote that it is running leaves only its lock.
        const bool empty = io::nothing_but_leftovers(folder, error, RunLock::name);
        if (error) cannot(folder, "cannot be read", error);
        if (!empty && !is_ours(folder)) {
            throw UsageError("run.folder", folder.string(),
                             "is not empty and no run wrote it; nothing in it was changed",
                             "name another folder with -o or empty this one");
        }
    }
    fs::create_directories(folder, error);
    if (error) cannot(folder, "cannot be created", error);
    auto lock = std::make_unique<RunLock>(folder);
    return {std::move(folder), std::move(lock)};
}

std::string RunFolder::owner(const fs::path& folder) { return RunLock::owner(folder); }

void RunFolder::clear(Keep keep) const {
    remove_results();
    io::remove_leftovers(folder_);
    for (const char* name : other_names) {
        keep == Keep::progress ? io::remove_leftovers(folder_ / name) : discard(folder_ / name);
    }
}

void RunFolder::write(std::string_view name, std::string_view content) const {
    io::write_file(file(name), content);
}

fs::path RunFolder::make(std::string_view name) const {
    const fs::path folder = file(name);
    discard(folder);
    std::error_code error;
    fs::create_directory(folder, error);
    if (error) cannot(folder, "cannot be created", error);
    return folder;
}

void RunFolder::open_staging() const {
    discard(staging());
    std::error_code error;
    fs::create_directory(staging(), error);
    if (error) cannot(staging(), "cannot be created", error);
}

void RunFolder::publish_results() const {
    discard(file("result"));
    std::error_code error;
    fs::rename(staging(), file("result"), error);
    if (error) cannot(file("result"), "cannot be created", error);
}

void RunFolder::remove_results() const {
    for (const char* name : result_names) discard(folder_ / name);
}

fs::path result_surface(const fs::path& run_folder) {
    std::error_code error;
    for (const char* name : {"surface.obj", "surface.ply", "surface.off", "surface.stl"}) {
        const fs::path file = run_folder / "result" / name;
        if (fs::exists(file, error)) return file;
    }
    return {};
}

}  // namespace dsc::run
