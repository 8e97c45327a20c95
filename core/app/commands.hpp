#pragma once
// The commands of `dsc`. Each function adds one to the parser; its action, run after parsing,
// returns the exit code.

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>

namespace dsc::app {

/// What all commands share.
struct Context {
    std::vector<std::string> command_line;  ///< as typed
    std::function<int()> action;            ///< action of the command that was given
};

/// Makes the command run this action, which returns the exit code.
inline void set_action(CLI::App& command, Context& context, std::function<int()> action) {
    command.callback([&context, action = std::move(action)] { context.action = action; });
}

void add_run(CLI::App& app, Context& context);
void add_reconstruct(CLI::App& app, Context& context);
void add_sample(CLI::App& app, Context& context);
void add_info(CLI::App& app, Context& context);
void add_evaluate(CLI::App& app, Context& context);
void add_render(CLI::App& app, Context& context);
void add_convert(CLI::App& app, Context& context);
void add_report(CLI::App& app, Context& context);
void add_schema(CLI::App& app, Context& context);
void add_plugin(CLI::App& app, Context& context);
void add_sweep(CLI::App& app, Context& context);
/// Subcommands of `dsc plugin`.
void add_plugin_new(CLI::App& plugin, Context& context);
void add_plugin_check(CLI::App& plugin, Context& context);
void add_plugin_doctor(CLI::App& plugin, Context& context);

}  // namespace dsc::app
