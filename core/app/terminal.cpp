#include "terminal.hpp"

#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <dsc/base/log.hpp>
#include <memory>
#include <nlohmann/json.hpp>

namespace dsc::app {
namespace {

CancelToken cancel_token;

extern "C" void on_signal(int signal) {
    cancel_token.cancel();
    std::signal(signal, SIG_DFL);
}

spdlog::level::level_enum spdlog_level(LogLevel level) {
    switch (level) {
        case LogLevel::debug:
            return spdlog::level::debug;
        case LogLevel::info:
            return spdlog::level::info;
        case LogLevel::warning:
            return spdlog::level::warn;
        case LogLevel::error:
            return spdlog::level::err;
    }
    return spdlog::level::err;
}

void print_line(const run::StepMetrics& row, std::uint64_t planned) {
    const std::string distance =
        row.cloud_to_surface_mean ? fmt::format("{:.5f}", *row.cloud_to_surface_mean) : "-";
    fmt::print(stderr, "\rstep {}/{}  {} vertices  {} tets  speed {:.2e}  cloud to surface {}  \x1b[K",
               row.step, planned, row.interface_vertices, row.tets, row.mean_speed, distance);
    if (row.step >= planned) fmt::print(stderr, "\n");
    std::fflush(stderr);
}

void print_json(const run::StepMetrics& row, std::uint64_t planned) {
    nlohmann::ordered_json json = {{"step", row.step},
                                   {"planned", planned},
                                   {"interface_vertices", row.interface_vertices},
                                   {"tets", row.tets},
                                   {"mean_speed", row.mean_speed},
                                   {"max_speed", row.max_speed},
                                   {"volume", row.volume},
                                   {"min_tet_quality", row.min_tet_quality}};
    if (row.vertex_to_cloud_mean) json["vertex_to_cloud_mean"] = *row.vertex_to_cloud_mean;
    if (row.cloud_to_surface_mean) json["cloud_to_surface_mean"] = *row.cloud_to_surface_mean;
    fmt::print(stderr, "{}\n", json.dump());
}

}  // namespace

void add_verbosity(CLI::App& command, TerminalOptions& options) {
    auto* verbose = command.add_flag("-v,--verbose", options.verbose, "Say more on stderr");
    command.add_flag("-q,--quiet", options.quiet, "Say only errors on stderr")->excludes(verbose);
}

void add_progress(CLI::App& command, TerminalOptions& options) {
    command
        .add_option("--progress", options.progress,
                    "auto (a line on a terminal), never, or json (a line a step)")
        ->check(CLI::IsMember({"auto", "never", "json"}))
        ->capture_default_str();
}

void start_log(const TerminalOptions& options) {
    const auto logger =
        std::make_shared<spdlog::logger>("dsc", std::make_shared<spdlog::sinks::stderr_color_sink_mt>());
    logger->set_pattern("%^%l%$: %v");
    logger->set_level(options.quiet     ? spdlog::level::err
                      : options.verbose ? spdlog::level::debug
                                        : spdlog::level::info);
    logger->flush_on(spdlog::level::debug);
    set_log_sink([logger](LogLevel level, std::string_view message) {
        logger->log(spdlog_level(level), "{}", message);
    });
}

std::function<void(const run::StepMetrics&, std::uint64_t)> progress_reporter(
    const TerminalOptions& options) {
    if (options.progress == "json") return print_json;
    if (options.progress == "never" || options.quiet || isatty(STDERR_FILENO) == 0) return {};
    using Clock = std::chrono::steady_clock;
    const auto last = std::make_shared<Clock::time_point>();
    return [last](const run::StepMetrics& row, std::uint64_t planned) {
        const Clock::time_point now = Clock::now();
        if (row.step < planned && now - *last < std::chrono::milliseconds(100)) return;
        *last = now;
        print_line(row, planned);
    };
}

const CancelToken& cancel_on_signals() {
    std::signal(SIGINT, on_signal);
    std::signal(SIGTERM, on_signal);
    return cancel_token;
}

}  // namespace dsc::app
