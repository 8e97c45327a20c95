#include "progress.hpp"

#include <chrono>
#include <memory>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "standard_streams.hpp"
#include "time_estimate.hpp"

namespace dsc::app {
namespace {

constexpr double line_seconds = 30.0;    // longest time between two lines of a log
constexpr double rewrite_seconds = 0.1;  // shortest time between two states of the live line

/// "12 s", "3:07 min", "2:05 h".
std::string duration(double seconds) {
    const auto whole = static_cast<long>(seconds + 0.5);
    if (whole < 100) return fmt::format("{} s", whole);
    if (whole < 6000) return fmt::format("{}:{:02} min", whole / 60, whole % 60);
    return fmt::format("{}:{:02} h", whole / 3600, whole / 60 % 60);
}

class Progress {
public:
    enum class Form { live, lines, json };

    Progress(Form form, const run::Experiment& experiment)
        : form_(form), estimate_(experiment.schedule) {}

    void operator()(const run::StepMetrics& row, std::uint64_t planned) {
        const double now = std::chrono::duration<double>(Clock::now() - start_).count();
        estimate_.add(row.step, row.interface_vertices, now);
        switch (form_) {
            case Form::live: return live(row, planned, now);
            case Form::lines: return line(row, planned, now);
            case Form::json: return json(row, planned, now);
        }
    }

private:
    using Clock = std::chrono::steady_clock;

    std::string text(const run::StepMetrics& row, std::uint64_t planned, double now) const {
        std::string text = fmt::format("step {}/{}, {} interface vertices", row.step, planned,
                                       row.interface_vertices);
        if (row.cloud_to_surface_mean)
            text += fmt::format(", cloud to surface {:.5f}", *row.cloud_to_surface_mean);
        text += fmt::format(", least quality {:.3f}, {}", row.min_tet_quality, duration(now));
        if (const auto left = estimate_.remaining(); left && row.step < planned)
            text += fmt::format(", {} left", duration(*left));
        return text;
    }

    void live(const run::StepMetrics& row, std::uint64_t planned, double now) {
        const bool last = row.step >= planned;
        if (!last && now - told_ < rewrite_seconds) return;
        told_ = now;
        // "\r" does not rewrite a line that wraps; the last column stays free, because some
        // terminals already wrap there.
        const unsigned columns = stderr_columns();
        tell(fmt::format("\r{}\x1b[K{}",
                         text(row, planned, now).substr(0, columns > 1 ? columns - 1 : 1),
                         last ? "\n" : ""));
    }

    void line(const run::StepMetrics& row, std::uint64_t planned, double now) {
        const std::uint64_t tenth = planned == 0 ? 10 : 10 * row.step / planned;
        if (row.step == 0 || (tenth == told_tenth_ && now - told_ < line_seconds)) return;
        told_tenth_ = tenth;
        told_ = now;
        tell(text(row, planned, now) + "\n");
    }

    void json(const run::StepMetrics& row, std::uint64_t planned, double now) const {
        nlohmann::ordered_json json = {{"step", row.step},
                                       {"planned", planned},
                                       {"interface_vertices", row.interface_vertices},
                                       {"tets", row.tets},
                                       {"mean_speed", row.mean_speed},
                                       {"max_speed", row.max_speed},
                                       {"volume", row.volume},
                                       {"min_tet_quality", row.min_tet_quality},
                                       {"elapsed_s", now}};
        if (row.vertex_to_cloud_mean) json["vertex_to_cloud_mean"] = *row.vertex_to_cloud_mean;
        if (row.cloud_to_surface_mean) json["cloud_to_surface_mean"] = *row.cloud_to_surface_mean;
        if (const auto left = estimate_.remaining()) json["remaining_s"] = *left;
        tell(json.dump() + "\n");
    }

    Form form_;
    TimeEstimate estimate_;
    Clock::time_point start_ = Clock::now();
    double told_ = 0;
    std::uint64_t told_tenth_ = 0;
};

}  // namespace

void add_progress(CLI::App& command, TerminalOptions& options) {
    command
        .add_option("--progress", options.progress,
                    "Progress: auto (a live line on a terminal, otherwise a line every 10 % or 30 "
                    "s), never, or json (an object per step)")
        ->check(CLI::IsMember({"auto", "never", "json"}))
        ->capture_default_str();
}

std::function<void(const run::StepMetrics&, std::uint64_t)> progress_reporter(
    const TerminalOptions& options, const run::Experiment& experiment) {
    using Form = Progress::Form;
    if (options.progress == "never" || (options.quiet && options.progress != "json")) return {};
    const Form form = options.progress == "json" ? Form::json
                      : stderr_rewrites()        ? Form::live
                                                 : Form::lines;
    const auto progress = std::make_shared<Progress>(form, experiment);
    return [progress](const run::StepMetrics& row, std::uint64_t planned) {
        (*progress)(row, planned);
    };
}

}  // namespace dsc::app
