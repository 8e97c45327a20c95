// Writes the folders of a sweep: the points first, the table with their names last.
#include <set>

#include <fmt/format.h>

#include <dsc/base/error.hpp>
#include <dsc/base/read_file.hpp>
#include <dsc/io/atomic_file.hpp>
#include <dsc/run/run_folder.hpp>
#include <dsc/sweep/sweep.hpp>
#include <dsc/text/words.hpp>

#include "table.hpp"
#include "truth.hpp"

namespace dsc::sweep {
namespace {

namespace fs = std::filesystem;

void make_folder(const fs::path& folder) {
    std::error_code error;
    fs::create_directories(folder, error);
    if (error) {
        throw IoError("run.folder", folder.string(), "", "cannot be created: " + error.message(),
                      "choose another folder with -o or make this one writable");
    }
}

/// The present table. If there is none, an empty one is written first, so that the folder of an
/// interrupted call is recognised.
std::vector<SweepJob> open_table(const fs::path& folder) {
    std::error_code error;
    if (fs::exists(table_file(folder), error)) return read_table(folder);
    const bool file = fs::exists(folder, error) && !fs::is_directory(folder, error);
    if (file || (fs::is_directory(folder, error) && !io::nothing_but_leftovers(folder, error))) {
        throw UsageError(
            "sweep.folder", folder.string(),
            file ? "is a file; it was not changed"
                 : "is not empty and does not contain a sweep; nothing in it was changed",
            "name another folder with -o or empty this one");
    }
    make_folder(folder);
    io::remove_leftovers(folder);
    io::write_file(table_file(folder), table_text({}));
    return {};
}

enum class Place { fresh, same, other };

/// What exists at the place of a point's experiment.
Place look(const fs::path& file, const std::string& text) {
    std::error_code error;
    if (!fs::exists(file, error)) return Place::fresh;
    return read_file(file) == text ? Place::same : Place::other;
}

/// Experiments of points that were started must not change.
void require_unchanged(const Sweep& sweep, const std::vector<std::string>& experiments,
                       const fs::path& folder) {
    std::size_t count = 0;
    std::string first;
    for (std::size_t i = 0; i < sweep.points.size(); ++i) {
        const fs::path point = folder / point_folder(sweep.points[i].name);
        if (!run::RunFolder::is_ours(point / "run") ||
            look(point / "experiment.yaml", experiments[i]) != Place::other)
            continue;
        if (count++ == 0) first = point.string();
    }
    if (count == 0) return;
    throw UsageError("sweep.changed", folder.string(),
                     fmt::format("{} started ({}{}) and would now be {}: the base, 'set' or this "
                                 "dsc has changed; nothing was written",
                                 text::counted(count, "point was", "points were"), first,
                                 count == 1 ? "" : ", ...",
                                 count == 1 ? "another experiment" : "other experiments"),
                     "expand into another folder with -o, or remove the folders of these points");
}

}  // namespace

Expansion expand_sweep(const Sweep& sweep, const std::vector<std::string>& experiments,
                       const fs::path& folder) {
    std::vector<SweepJob> jobs = open_table(folder);
    require_unchanged(sweep, experiments, folder);
    std::set<std::string> known;
    for (const SweepJob& job : jobs) known.insert(job.name);
    Expansion expansion;
    for (std::size_t i = 0; i < sweep.points.size(); ++i) {
        const SweepPoint& point = sweep.points[i];
        const fs::path file = folder / point_folder(point.name) / "experiment.yaml";
        if (look(file, experiments[i]) != Place::same) {
            make_folder(file.parent_path());
            io::write_file(file, experiments[i]);
        }
        name_truth(file.parent_path(), point.truth.value);
        if (known.insert(point.name).second) {
            jobs.push_back({point.name, point.overrides});
            ++expansion.added;
        } else {
            ++expansion.kept;
        }
    }
    expansion.others = jobs.size() - sweep.points.size();
    if (expansion.added > 0) io::write_file(table_file(folder), table_text(jobs));
    return expansion;
}

}  // namespace dsc::sweep
