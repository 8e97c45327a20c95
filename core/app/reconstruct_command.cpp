// dsc reconstruct
#include <algorithm>
#include <memory>
#include <optional>
#include <sstream>

#include <fmt/format.h>

#include <dsc/base/error.hpp>
#include <dsc/base/log.hpp>
#include <dsc/base/read_file.hpp>
#include <dsc/cloud/normalize.hpp>
#include <dsc/io/atomic_file.hpp>
#include <dsc/io/formats.hpp>
#include <dsc/report/report.hpp>
#include <dsc/run/input_files.hpp>
#include <dsc/run/reconstruct.hpp>
#include <dsc/run/run_experiment.hpp>
#include <dsc/text/words.hpp>

#include "commands.hpp"
#include "crash_guard.hpp"
#include "exit_guard.hpp"
#include "files.hpp"
#include "outcome.hpp"
#include "plugins.hpp"
#include "progress.hpp"
#include "standard_streams.hpp"
#include "temporary_folder.hpp"
#include "threads.hpp"

namespace dsc::app {
namespace {

namespace fs = std::filesystem;

struct ReconstructArguments {
    std::string cloud;
    std::vector<std::string> columns;
    std::vector<std::string> outputs;
    std::string detail = "medium";
    std::optional<double> edge_length;
    std::optional<std::uint64_t> vertices;
    std::string smooth = "auto";
    bool trim = false;
    bool strict = false;
    std::string keep_run;
    bool print_config = false;
    unsigned threads = 0;
    std::vector<std::string> plugins;
    TerminalOptions terminal;
};

/// An output and the format that its extension selects.
struct Target {
    fs::path file;
    std::string format;  ///< extension without its dot
    bool volume = false;
};

std::vector<Target> targets(const ReconstructArguments& arguments) {
    std::vector<std::string> names = arguments.outputs;
    if (names.empty()) {
        const std::string stem = fs::path(arguments.cloud).stem().string();
        names = {stem + "_surface.ply", stem + "_volume.vtu"};
    }
    std::vector<Target> list;
    for (const std::string& name : names) {
        const io::Format* format = io::find_format(name);
        if (format == nullptr) {
            throw UsageError("usage.format", name,
                             "does not have the extension of a format that dsc writes",
                             fmt::format("use {} for the surface, {} for the volume",
                                         io::surface_extensions(), io::volume_extensions()));
        }
        require_output(name, arguments.cloud);
        for (const Target& other : list) {
            if (same_file(other.file, name))
                throw UsageError("usage.output", name, "is given twice with -o",
                                 "give each file once");
        }
        list.push_back({name, std::string(format->extension.substr(1)), format->volume});
    }
    return list;
}

/// The formats that a run must write so that every target can be copied from its result.
std::vector<std::string> wanted(const std::vector<Target>& list, bool volume,
                                std::vector<std::string> formats) {
    for (const Target& target : list) {
        if (target.volume == volume &&
            std::find(formats.begin(), formats.end(), target.format) == formats.end())
            formats.push_back(target.format);
    }
    return formats;
}

fs::path source_of(const Target& target, const run::RunOutcome& outcome) {
    for (const fs::path& file : target.volume ? outcome.volumes : outcome.surfaces) {
        if (text::lower_case_extension(file) == "." + target.format) return file;
    }
    throw Error(ExitCode::internal, "reconstruct.format", outcome.folder.string(),
                fmt::format("the run did not write .{}", target.format),
                "please report it with the command");
}

/// Refuses a cloud from which no surface can be made, before anything else happens. The message
/// uses the name that the caller gave: the experiment contains the absolute name, and its filters
/// would be the first to see the cloud. The run uses the cloud that was read here.
std::shared_ptr<run::InputFiles> read_good_cloud(const ReconstructArguments& arguments) {
    const auto files = std::make_shared<run::InputFiles>();
    const cloud::Cloud& cloud = files->cloud(arguments.cloud, arguments.columns).cloud;
    cloud::require_volume(cloud.points, cloud.source.empty() ? arguments.cloud : cloud.source);
    return files;
}

/// The noise of --smooth, in spacings; empty if it is to be measured.
std::optional<double> noise_of(const std::string& smooth) {
    if (smooth == "auto") return std::nullopt;
    std::istringstream text(smooth);
    double value = 0.0;
    if (!(text >> value) || !text.eof() || !(value >= 0.0 && value <= 100.0)) {
        throw UsageError(
            "usage.smooth", "--smooth",
            fmt::format("'{}' is neither auto nor a number from 0 to 100", smooth),
            "give the standard deviation of the points' noise in spacings, such as 0.3");
    }
    return value;
}

run::ReconstructOptions options_of(const ReconstructArguments& arguments) {
    run::ReconstructOptions options;
    options.detail = run::detail_from_name(arguments.detail).value();
    options.columns = arguments.columns;
    options.edge_length = arguments.edge_length;
    options.vertices = arguments.vertices;
    options.noise = noise_of(arguments.smooth);
    options.trim = arguments.trim;
    return options;
}

/// Copies the outputs from the run folder. If one cannot be written, the others are still written
/// and the run folder is kept.
void deliver(const std::vector<Target>& list, const run::RunOutcome& outcome,
             std::optional<TemporaryFolder>& temporary) {
    std::string faults;
    for (const Target& target : list) {
        try {
            io::write_file(target.file, read_file(source_of(target, outcome)));
            data_out() << target.file.string() << "\n";
        } catch (const IoError& error) {
            faults += fmt::format("{}{}", faults.empty() ? "" : "; ", error.what());
        }
    }
    if (faults.empty()) return;
    if (temporary) temporary->keep();
    throw IoError("io.write", "", "", faults,
                  fmt::format("the result is kept in {}", (outcome.folder / "result").string()));
}

/// An experiment is UTF-8 text, but a file name need not be UTF-8: such a file gets a link with a
/// plain name.
fs::path plain_name(const fs::path& cloud, std::optional<TemporaryFolder>& links) {
    const fs::path whole = fs::absolute(cloud);
    if (is_utf8(whole.string())) return whole;
    links.emplace();
    const fs::path link = links->path() / ("cloud" + text::lower_case_extension(cloud));
    fs::create_symlink(whole, link);
    return link;
}

/// Runs the experiment. A run that is stopped before there is a surface leaves nothing behind, and
/// the message states this.
run::RunOutcome carry_out(const run::LoadedExperiment& loaded, const Plugins& plugins,
                          const run::RunOptions& options) {
    try {
        return run::reconstruct(loaded, plugins.host(), options);
    } catch (const CancelledError& error) {
        throw CancelledError(
            fmt::format("{}; it was stopped before there was a surface, so no output was written "
                        "and nothing is kept; with --keep-run FOLDER the run folder is kept even "
                        "if the run is stopped",
                        error.what()));
    }
}

int execute(const ReconstructArguments& arguments, const std::vector<std::string>& command) {
    start_log(arguments.terminal);
    if (!fs::exists(arguments.cloud)) {
        throw IoError("io.missing", arguments.cloud, "", "does not exist",
                      "check the name of the cloud");
    }
    const std::vector<Target> list = targets(arguments);
    const std::shared_ptr<run::InputFiles> files = read_good_cloud(arguments);
    std::optional<TemporaryFolder> links;
    config::ConfigNode root =
        run::reconstruction_of(plain_name(arguments.cloud, links).string(), options_of(arguments));
    const bool kept = !arguments.keep_run.empty();
    using Names = std::vector<std::string>;
    root = run::with_output(
        root, {.surface = wanted(list, false, kept ? Names{"obj", "ply"} : Names{"obj"}),
               .volume = wanted(list, true, kept ? Names{"vtu", "dsc"} : Names{"dsc"}),
               .report = kept});
    Plugins plugins(arguments.plugins);
    run::LoadedExperiment loaded = run::resolve_experiment(root, plugins.loader());
    loaded.files = files;
    guard_exit();
    guard_crashes(plugins.host().plugins());
    if (arguments.print_config) {
        data_out() << run::resolved_text(loaded);
        return 0;
    }

    std::optional<TemporaryFolder> temporary;
    if (!kept) temporary.emplace();
    run::RunOptions options;
    options.folder = kept ? fs::path(arguments.keep_run) : temporary->path() / "run";
    options.picture = options.last_good = kept;
    options.threads = thread_count(arguments.threads);
    options.cancel = &cancel_on_signals();
    options.command = command;
    options.on_step = progress_reporter(arguments.terminal, loaded.experiment);
    options.make_report = report::report_html;
    const run::RunOutcome outcome = carry_out(loaded, plugins, options);
    report(outcome);
    deliver(list, outcome, temporary);
    if (exit_code(outcome) != 0 || !arguments.strict || outcome.totals.warnings.empty())
        return exit_code(outcome);
    log(LogLevel::error, "--strict: the result was written, but there are warnings about it");
    return static_cast<int>(ExitCode::geometry);
}

}  // namespace

void add_reconstruct(CLI::App& app, Context& context) {
    CLI::App* command =
        app.add_subcommand("reconstruct", "Reconstruct a surface and a volume from a point cloud");
    const auto arguments = std::make_shared<ReconstructArguments>();
    command
        ->add_option("CLOUD", arguments->cloud,
                     "Point cloud: .obj .ply .pcd .xyz .txt .asc .pts .csv")
        ->required();
    add_columns(*command, arguments->columns);
    command
        ->add_option(
            "-o,--output", arguments->outputs,
            "Output; may be repeated. The extension selects the format: .obj .ply .off .stl "
            ".glb surface, .vtu .dsc .msh "
            ".mesh volume. Default: STEM_surface.ply and STEM_volume.vtu in the current folder")
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    command->add_option("--detail", arguments->detail, "Level of detail: low, medium or high")
        ->check(CLI::IsMember({"low", "medium", "high"}))
        ->capture_default_str();
    command
        ->add_option("--edge-length", arguments->edge_length,
                     "Edge length of the triangles, in the units of the cloud; replaces --detail")
        ->check(CLI::PositiveNumber)
        ->excludes("--detail");
    command
        ->add_option("--vertices", arguments->vertices,
                     "Number of vertices that the surface may have; replaces --detail")
        ->check(CLI::Range(100, 10000000))
        ->excludes("--detail")
        ->excludes("--edge-length");
    command
        ->add_option("--smooth", arguments->smooth,
                     "Noise of the points: auto (it is measured) or its standard deviation in "
                     "spacings; a larger value makes the surface smoother")
        ->type_name("auto|NUMBER")
        ->capture_default_str();
    command->add_flag("--trim", arguments->trim,
                      "Write the surface without the parts that no points support, such as the "
                      "back of a scan from one side");
    command->add_flag(
        "--strict", arguments->strict,
        "Exit with code 5 if there are warnings about the result; the result is still written");
    command->add_flag("--print-config", arguments->print_config,
                      "Print the experiment that would be run, and run nothing");
    command->add_option("--keep-run", arguments->keep_run, "Keep the run folder under this name");
    add_threads(*command, arguments->threads);
    add_plugins(*command, arguments->plugins);
    add_progress(*command, arguments->terminal);
    add_verbosity(*command, arguments->terminal);
    set_action(*command, context,
               [arguments, &context] { return execute(*arguments, context.command_line); });
}

}  // namespace dsc::app
