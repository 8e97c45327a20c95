// The `dsc` command: parses, dispatches, and turns every error into one message and an exit code.
#include <cstdio>
#include <dsc/base/error.hpp>
#include <dsc/run/provenance.hpp>
#include <exception>
#include <iostream>
#include <string_view>

#include "commands.hpp"
#include "terminal.hpp"

namespace {

/// Diagnostics of a configuration name severity and place themselves; every other message gets "error:".
void print_error(const dsc::Error& error) {
    std::string_view text = error.what();
    while (!text.empty() && text.back() == '\n') text.remove_suffix(1);
    const bool diagnostics = text.find(": error: ") != std::string_view::npos;
    std::fprintf(stderr, "%s%.*s\n", diagnostics ? "" : "error: ", static_cast<int>(text.size()),
                 text.data());
}

int usage_error(const CLI::App& app, const CLI::ParseError& error) {
    const CLI::App* command = &app;
    for (auto given = command->get_subcommands(); !given.empty(); given = command->get_subcommands())
        command = given.front();
    std::string name = "dsc";
    if (command != &app) name += " " + command->get_name();
    std::fprintf(stderr, "error: %s; see %s --help\n", error.what(), name.c_str());
    return static_cast<int>(dsc::ExitCode::usage);
}

int run(int argc, char** argv) {
    CLI::App app("Point clouds without normals to watertight surfaces and conforming tet meshes.", "dsc");
    app.set_version_flag("--version", dsc::run::version_text);
    app.require_subcommand(1);
    app.footer(
        "Exit codes: 0 ok, 1 internal, 2 usage, 3 config, 4 plugin or strategy, 5 geometry, 6 input/output, "
        "75 stopped.");
    dsc::app::Context context;
    context.command_line.assign(argv, argv + argc);
    dsc::app::add_run(app, context);
    dsc::app::add_reconstruct(app, context);
    dsc::app::add_sample(app, context);
    dsc::app::add_info(app, context);
    dsc::app::add_evaluate(app, context);
    dsc::app::add_render(app, context);
    dsc::app::add_convert(app, context);
    dsc::app::add_report(app, context);
    dsc::app::add_plugin(app, context);
    dsc::app::add_schema(app, context);
    dsc::app::add_sweep(app, context);
    try {
        app.parse(argc, argv);
    } catch (const CLI::Success& success) {
        return app.exit(success);  // --help, --version: on stdout
    } catch (const CLI::ParseError& error) {
        return usage_error(app, error);
    }
    const int code = context.action();
    if (!std::cout.flush()) {
        throw dsc::IoError("io.write", "stdout cannot be written; check where it goes");
    }
    return code;
}

}  // namespace

int main(int argc, char** argv) {
    dsc::app::start_log({});
    try {
        return run(argc, argv);
    } catch (const dsc::Error& error) {
        print_error(error);
        return static_cast<int>(error.exit_code());
    } catch (const std::bad_alloc&) {
        std::fprintf(stderr, "error: out of memory; use a smaller cloud or a coarser mesh\n");
    } catch (const std::exception& error) {
        std::fprintf(stderr, "error: internal: %s; please report it with the command\n", error.what());
    } catch (...) {
        std::fprintf(stderr, "error: internal: unknown exception; please report it with the command\n");
    }
    return static_cast<int>(dsc::ExitCode::internal);
}
