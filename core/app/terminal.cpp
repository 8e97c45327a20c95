#include "terminal.hpp"

#include <csignal>
#include <cstdlib>
#include <memory>

#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <dsc/base/log.hpp>

#include "standard_streams.hpp"

namespace dsc::app {
namespace {

CancelToken cancel_token;

extern "C" void on_signal(int signal) {
    cancel_token.cancel();
    // A user who asks twice wants the program to end at once. The other signals may come twice for
    // one reason: SIGXCPU comes every second of time over the limit, SIGHUP from the shell and from
    // the terminal.
    if (signal == SIGINT || signal == SIGTERM) std::signal(signal, SIG_DFL);
}

spdlog::level::level_enum spdlog_level(LogLevel level) {
    switch (level) {
        case LogLevel::debug: return spdlog::level::debug;
        case LogLevel::info: return spdlog::level::info;
        case LogLevel::warning: return spdlog::level::warn;
        case LogLevel::error: return spdlog::level::err;
    }
    return spdlog::level::err;
}

}  // namespace

void add_verbosity(CLI::App& command, TerminalOptions& options) {
    auto* verbose =
        command.add_flag("-v,--verbose", options.verbose, "Print more messages on stderr");
    command.add_flag("-q,--quiet", options.quiet, "Print only errors on stderr")->excludes(verbose);
}

void start_log(const TerminalOptions& options) {
    const auto sink = std::make_shared<spdlog::sinks::stderr_color_sink_mt>();
    // https://no-color.org: if the variable is set and not empty, use no colours.
    const char* no_color = std::getenv("NO_COLOR");
    if (!stderr_rewrites() || (no_color != nullptr && *no_color != '\0'))
        sink->set_color_mode(spdlog::color_mode::never);
    const auto logger = std::make_shared<spdlog::logger>("dsc", sink);
    logger->set_pattern("%^%l%$: %v");
    logger->set_level(options.quiet     ? spdlog::level::err
                      : options.verbose ? spdlog::level::debug
                                        : spdlog::level::info);
    logger->flush_on(spdlog::level::debug);
    set_log_sink([logger](LogLevel level, std::string_view message) {
        logger->log(spdlog_level(level), "{}", message);
    });
}

const CancelToken& cancel_on_signals() {
    for (const int signal : {SIGINT, SIGTERM, SIGUSR1, SIGXCPU}) std::signal(signal, on_signal);
    // Under nohup the signal is ignored, and stays ignored.
    if (std::signal(SIGHUP, on_signal) == SIG_IGN) std::signal(SIGHUP, SIG_IGN);
    return cancel_token;
}

}  // namespace dsc::app
