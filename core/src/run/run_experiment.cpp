// A complete run, from a loaded experiment to its folder.
#include "dsc/run/run_experiment.hpp"

#include <algorithm>
#include <array>
#include <iterator>
#include <span>
#include <string_view>

#include <fmt/format.h>

#include <dsc/base/error.hpp>
#include <dsc/base/log.hpp>
#include <dsc/base/stopwatch.hpp>
#include <dsc/io/picture.hpp>
#include <dsc/io/write.hpp>
#include <dsc/run/provenance.hpp>
#include <dsc/run/run_folder.hpp>
#include <dsc/surface/surface_view.hpp>

#include "checkpoints.hpp"
#include "result_files.hpp"
#include "resume.hpp"
#include "run_log.hpp"
#include "running.hpp"
#include "state_series.hpp"
#include "summary.hpp"

namespace dsc::run {
namespace {

namespace fs = std::filesystem;

void require_valid(const RunOutcome& outcome) {
    const VolumeMeasure& v = outcome.volume;
    if (v.inverted_tets == 0 && v.adjacency_valid() && outcome.conforms) return;
    throw GeometryError(
        "run.invalid_result", "result",
        fmt::format("as written it is not valid: it has {} inverted tets and {} wrong "
                    "faces, and its surface is {}the interface of its volume",
                    v.inverted_tets, v.overused_faces + v.folded_faces,
                    outcome.conforms ? "" : "not "),
        "if the coordinates are huge, move the input closer to the origin");
}

/// Warnings about parts of the surface that trimming removes.
constexpr std::array<std::string_view, 3> about_unsupported_parts = {
    "cloud.open", "cloud.one_sided", "coverage.unsupported"};

bool settled_by_trimming(const hooks::Warning& warning) {
    return std::find(about_unsupported_parts.begin(), about_unsupported_parts.end(),
                     warning.code) != about_unsupported_parts.end();
}

fs::path folder_of(const LoadedExperiment& loaded, const std::string& hash) {
    return fs::path("runs") / loaded.experiment.name / hash.substr(0, 12);
}

/// The up axis is z for the built-in shapes and y for most models in files.
void draw(const RunFolder& folder, const surface::TriangleMesh& surface, bool sampled,
          Workers& workers) {
    io::RenderOptions options;
    options.width = 800;
    options.height = 600;
    options.up = sampled ? io::UpAxis::z : io::UpAxis::y;
    options.workers = &workers;
    io::write_png(folder.file("preview.png"), io::render(surface, options));
}

/// The end of the time budget, which begins now.
std::optional<CancelToken::Clock::time_point> deadline_of(const RunOptions& options) {
    if (!options.time_budget) return std::nullopt;
    // A budget above `longest` would overflow the clock. It is reduced to `longest`, 31 years.
    constexpr double longest = 1e9;
    const std::chrono::duration<double> budget(std::min(*options.time_budget, longest));
    return CancelToken::Clock::now() +
           std::chrono::duration_cast<CancelToken::Clock::duration>(budget);
}

/// The work between "running" and "done" in status.json.
class ExperimentRun {
public:
    ExperimentRun(const LoadedExperiment& loaded, const plugin::Catalogue& catalogue,
                  const RunOptions& options)
        : loaded_(loaded),
          catalogue_(catalogue),
          options_(options),
          workers_(std::max(1U, options.threads)),
          stop_(options.cancel, deadline_of(options)) {}

    RunOutcome run() {
        state_.state = "running";
        state_.started = utc_now();
        state_.hash = config_hash(loaded_, catalogue_);
        for (const UsedStrategy& used : used_strategies(loaded_, catalogue_))
            state_.strategies[used.key()] = used.sha256;
        Strategies strategies = make_strategies(loaded_.experiment, catalogue_);
        const fs::path path =
            options_.folder.empty() ? folder_of(loaded_, state_.hash) : options_.folder;
        const Checkpoints checkpoints(path / "checkpoint", kept_checkpoints());
        const RunFolder folder = RunFolder::claimed(path);
        if (options_.resume)
            resumed_ = checkpoint_to_resume(path, checkpoints, loaded_, catalogue_, state_.hash);
        folder.clear(resumed_ ? RunFolder::Keep::progress : RunFolder::Keep::nothing);
        if (options_.resume) {
            log(LogLevel::info,
                resumed_
                    ? fmt::format("continuing after step {}", resumed_->steps)
                    : fmt::format(
                          "{} contains no checkpoint of this experiment: starting at the beginning",
                          path.string()));
        }
        folder.write("status.json", status_json(state_));
        Running running([this, &folder](const Error& error) {
            fail(folder, static_cast<int>(error.exit_code()), error.code(), error.what());
        });
        try {
            RunOutcome outcome = work(folder, strategies, checkpoints, running);
            state_.finished = utc_now();
            state_.state = outcome.totals.status == Status::cancelled ? "stopped" : "done";
            state_.exit_code =
                static_cast<int>(state_.state == "done" ? ExitCode::ok : ExitCode::stopped);
            state_.totals = outcome.totals;
            folder.write("provenance.json", provenance(state_.finished));
            if (options_.make_report && loaded_.experiment.output.report.value_or(false))
                write_report(folder, outcome);
            folder.write("status.json", status_json(state_));
            return outcome;
        } catch (const Error& error) {
            fail(folder, static_cast<int>(error.exit_code()), error.code(), error.what());
            throw;
        } catch (const std::exception& error) {
            fail(folder, static_cast<int>(ExitCode::internal), "internal", error.what());
            throw;
        }
    }

private:
    std::size_t kept_checkpoints() const {
        const auto& wanted = loaded_.experiment.output.checkpoint;
        return wanted ? wanted->keep : 1;
    }

    /// Of the whole run, including the time before a checkpoint.
    double run_seconds() const { return watch_.seconds() + (resumed_ ? resumed_->seconds : 0.0); }

    RunOutcome work(const RunFolder& folder, Strategies& strategies, const Checkpoints& checkpoints,
                    Running& running) {
        const Experiment& experiment = loaded_.experiment;
        folder.write("config.resolved.yaml", resolved_text(loaded_));
        folder.write("provenance.json", provenance(""));
        std::optional<LoadedInput>& input = input_;
        if (experiment.input) {
            input = load_input(*experiment.input, experiment.seed, catalogue_, *loaded_.files,
                               &workers_, &stop_);
            report_input(input->report);
        }
        const cloud::TargetCloud* target = input ? &input->target : nullptr;
        const cloud::Transform to_normalised =
            target != nullptr ? target->transform() : cloud::Transform{};

        RunLog run_log = resumed_ ? RunLog(folder.path(), to_normalised, resumed_->log)
                                  : RunLog(folder.path(), to_normalised);
        SimulationOptions simulation_options;
        if (resumed_) simulation_options.resume = resumed_->state;
        if (experiment.output.checkpoint)
            simulation_options.checkpoint_every = experiment.output.checkpoint->every;
        simulation_options.on_checkpoint = [&](std::string state, std::uint64_t steps) {
            checkpoints.write(
                {state_.hash, steps, run_seconds(), run_log.state(), std::move(state)});
        };
        simulation_options.workers = &workers_;
        simulation_options.cancel = &stop_;
        simulation_options.on_step = [&](const StepMetrics& row, std::uint64_t planned) {
            run_log.add(row);
            if (options_.on_step) options_.on_step(row, planned);
        };
        simulation_options.on_event = [&](const kernel::Event& event) { run_log.add(event); };
        simulation_options.on_repairs = [&](const ClassFigures& figures) { run_log.add(figures); };
        StateSeries states(experiment, catalogue_, folder.path());
        if (states.active()) {
            simulation_options.on_state = [&](const hooks::StepContext& context,
                                              const mesh::Complex& complex) {
                states.add(context, complex);
            };
        }
        simulation_options.on_strategy_failure = [&](const mesh::TetMesh& mesh,
                                                     std::uint64_t steps) {
            if (!options_.last_good) return;
            save_last_good(folder, to_input(mesh, to_normalised), steps);
        };
        simulation_options.on_rescue = [&running](std::function<void()> rescue) {
            running.set_rescue(std::move(rescue));
        };
        SimulationResult end = simulate(experiment, strategies, target, simulation_options);
        run_log.close();

        RunOutcome outcome;
        outcome.folder = folder.path();
        outcome.totals = end.totals;
        const Stopwatch io_watch;
        std::optional<surface::CloudEvaluation> distances;
        if (target != nullptr && !end.surface.faces.empty())
            distances = measure_cloud_distances(end.surface, *target, outcome);
        ResultFiles files(folder, experiment.output, workers_);
        const mesh::TetMesh volume = to_input(end.mesh, to_normalised);
        const auto gaps = outcome.coverage ? std::span<const double>(outcome.coverage->gaps)
                                           : std::span<const double>();
        files.write(volume, end.attributes, target, gaps, outcome);
        files.measure_files(outcome);
        require_valid(outcome);
        if (options_.picture && experiment.output.preview.value_or(true) &&
            !outcome.surfaces.empty()) {
            draw(folder, files.surface(), experiment.input && experiment.input->cloud.sample,
                 workers_);
            outcome.picture = folder.file("preview.png");
        }
        outcome.totals.seconds.io += io_watch.elapsed();
        folder.publish_results();
        folder.write("summary.json",
                     summary_json({loaded_, state_.hash, input ? &*input : nullptr, distances,
                                   outcome, to_normalised, run_seconds(), process_usage()}));
        if (options_.on_result) {
            options_.on_result({volume, files.surface(), files.vertex_of(), end.attributes, gaps});
        }
        return outcome;
    }

    /// Measures the distances between surface and points, and adds the warnings about them.
    surface::CloudEvaluation measure_cloud_distances(const surface::TriangleMesh& surface,
                                                     const cloud::TargetCloud& target,
                                                     RunOutcome& outcome) {
        const surface::CloudDistances distances =
            surface::cloud_distances(surface, target.points(), &workers_);
        outcome.coverage =
            measure_coverage(surface, target.points(), distances, target.statistics(&workers_),
                             input_->removed, &workers_);
        hooks::Warnings& warnings = outcome.totals.warnings;
        hooks::Warnings found = warnings_of(*outcome.coverage, target.transform());
        warnings.insert(warnings.end(), std::make_move_iterator(found.begin()),
                        std::make_move_iterator(found.end()));
        if (loaded_.experiment.output.trim) std::erase_if(warnings, settled_by_trimming);
        return surface::evaluate_cloud(distances);
    }

    /// Made from the folder, as `dsc report` does. A result without its page is still a valid
    /// result.
    void write_report(const RunFolder& folder, RunOutcome& outcome) {
        try {
            folder.write("report.html", options_.make_report(folder.path(), catalogue_, &workers_,
                                                             input_ ? &*input_ : nullptr));
            outcome.report = folder.file("report.html");
        } catch (const Error& error) {
            log(LogLevel::warning,
                fmt::format("the report could not be written: {}", error.what()));
        }
    }

    /// Saves the last state before a strategy failed. A fault in this function must not hide the
    /// strategy's error.
    void save_last_good(const RunFolder& folder, const mesh::TetMesh& mesh, std::uint64_t steps) {
        try {
            const fs::path place = folder.make("last_good");
            io::write_volume(place / "volume.dsc", mesh);
            const surface::TriangleMesh surface = surface::extract_interface(mesh);
            if (!surface.faces.empty()) io::write_surface(place / "surface.obj", surface);
            log(LogLevel::warning,
                fmt::format("the state after step {} is kept in {}", steps, place.string()));
        } catch (const std::exception& error) {
            log(LogLevel::warning,
                fmt::format("the last good state could not be kept: {}", error.what()));
        }
    }

    std::string provenance(const std::string& finished) const {
        return provenance_json(loaded_, catalogue_, state_.hash, options_.command,
                               workers_.threads(), state_.started, finished, watch_.seconds());
    }

    static void report_input(const InputReport& report) {
        std::string text = fmt::format("{}: {} points", report.source, report.points);
        if (report.dropped > 0)
            text += fmt::format(", {} with NaN or infinity dropped", report.dropped);
        if (report.variation) {
            text += fmt::format(", variation left out {}{}", report.variation->left_out,
                                report.variation->rotation ? " and rotated the others" : "");
        }
        for (const cloud::FilterReport& filter : report.filters) {
            text += fmt::format(", {} removed {}", filter.filter, filter.removed);
        }
        log(report.dropped > 0 ? LogLevel::warning : LogLevel::info, text);
        for (const cloud::FilterReport& filter : report.filters)
            for (const std::string& note : filter.notes) log(LogLevel::info, note);
    }

    /// Writes to the folder that the run failed, or was stopped before there was a result, and
    /// removes all results. The first error is kept: a further error here (for example a full disk)
    /// must not hide it.
    void fail(const RunFolder& folder, int exit_code, const std::string& code,
              const std::string& message) {
        state_.state = exit_code == static_cast<int>(ExitCode::stopped) ? "stopped" : "failed";
        state_.finished = utc_now();
        state_.exit_code = exit_code;
        state_.error_code = code;
        state_.error = message;
        try {
            folder.remove_results();
            folder.write("status.json", status_json(state_));
        } catch (const std::exception& second) {
            log(LogLevel::warning, second.what());
        }
    }

    const LoadedExperiment& loaded_;
    const plugin::Catalogue& catalogue_;
    const RunOptions& options_;
    Workers workers_;
    Stopwatch watch_;
    CancelToken stop_;  // on request, or when the time is over
    RunState state_;
    std::optional<Checkpoint> resumed_;
    std::optional<LoadedInput> input_;  // made by work(), kept for the report
};

}  // namespace

RunOutcome run_experiment(const LoadedExperiment& loaded, const plugin::Catalogue& catalogue,
                          const RunOptions& options) {
    return ExperimentRun(loaded, catalogue, options).run();
}

bool is_finished(const fs::path& folder, const LoadedExperiment& loaded,
                 const plugin::Catalogue& catalogue) {
    const std::optional<RunFolder::Status> status = RunFolder::status(folder);
    if (!status || status->state != "done" || status->hash != config_hash(loaded, catalogue))
        return false;
    // A finished run stays finished when the program, with the strategies in it, is updated.
    std::vector<UsedStrategy> changed =
        changed_strategies(used_strategies(loaded, catalogue), *status);
    std::erase_if(changed, [](const UsedStrategy& strategy) { return strategy.installed; });
    return changed.empty();
}

fs::path default_folder(const LoadedExperiment& loaded, const config::StrategyLookup& lookup) {
    return folder_of(loaded, config_hash(loaded, lookup));
}

mesh::TetMesh to_input(const mesh::TetMesh& mesh, const cloud::Transform& to_normalised) {
    mesh::TetMesh result = mesh;
    if (to_normalised.identity()) return result;
    for (Vec3& p : result.points) p = to_normalised.inverse(p);
    return result;
}

}  // namespace dsc::run
