// The `dsc` command: parses, dispatches, and turns every error into one message and an exit code.
#include <exception>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include <dsc/base/error.hpp>
#include <dsc/base/heap.hpp>
#include <dsc/run/provenance.hpp>

#include "commands.hpp"
#include "exit_guard.hpp"
#include "standard_streams.hpp"
#include "terminal.hpp"
#include "usage.hpp"

namespace {

/// Diagnostics of a configuration already contain severity and place; every other message gets
/// "error:".
void print_error(const dsc::Error& error) {
    std::string_view text = error.what();
    while (!text.empty() && text.back() == '\n') text.remove_suffix(1);
    const bool diagnostics = text.find(": error: ") != std::string_view::npos;
    dsc::app::tell(fmt::format("{}{}\n", diagnostics ? "" : "error: ", text));
}

/// Adds `dsc help` and `dsc version`, for users who try these before --help and --version.
void add_help(CLI::App& app, dsc::app::Context& context) {
    CLI::App* help = app.add_subcommand("help", "Show the help of a command");
    const auto words = std::make_shared<std::vector<std::string>>();
    help->add_option("COMMAND", *words,
                     "Command, such as run or plugin check; default: all commands");
    help->callback([&app, &context, words] {
        context.action = [&app, words] {
            dsc::app::data_out() << dsc::app::help_text(app, *words);
            return 0;
        };
    });
    app.add_subcommand("version", "Show the version, like --version")->callback([&context] {
        context.action = [] {
            dsc::app::data_out() << dsc::run::version_text() << "\n";
            return 0;
        };
    });
}

/// Readers ask the user to choose columns; each command has its own way to do so.
dsc::Error with_choice_of_columns(const CLI::App& app, const dsc::Error& error) {
    const std::string& remedy = error.remedy();
    constexpr std::string_view request = "by their numbers from 1";
    if (remedy.size() < request.size() ||
        remedy.compare(remedy.size() - request.size(), request.size(), request) != 0)
        return error;
    const auto commands = app.get_subcommands();
    const bool option =
        !commands.empty() && commands.front()->get_option_no_throw("--columns") != nullptr;
    return {error.exit_code(), error.code(), error.place(), error.cause(),
            remedy + (option ? ": --columns X,Y,Z" : ": input.cloud.columns")};
}

/// Writes the remaining data. If this fails, the exit code of a job that has failed is kept.
void finish_data(int code) {
    try {
        dsc::app::flush_data();
    } catch (const dsc::Error& error) {
        if (code == 0) throw;
        print_error(error);
    }
}

int run(int argc, char** argv) {
    CLI::App app(
        "Turns point clouds without normals into watertight surfaces and conforming tet meshes.",
        "dsc");
    app.set_version_flag("--version", dsc::run::version_text);
    app.require_subcommand(1);
    app.footer("Exit codes: 0 ok, 1 defect of dsc, 2 wrong call, 3 wrong experiment, 4 plugin or "
               "strategy, 5 geometry, 6 file, 75 stopped.");
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
    add_help(app, context);
    if (argc < 2) {
        dsc::app::data_out() << app.help();
        dsc::app::flush_data();
        return static_cast<int>(dsc::ExitCode::usage);
    }
    try {
        app.parse(argc, argv);
    } catch (const CLI::Success& success) {
        app.exit(success, dsc::app::data_out());  // --help, --version
        dsc::app::flush_data();
        return 0;
    } catch (const CLI::ParseError& error) {
        const std::vector<std::string> words(argv + 1, argv + argc);
        dsc::app::tell(fmt::format("error: {}\n", dsc::app::usage_text(app, words, error)));
        return static_cast<int>(dsc::ExitCode::usage);
    }
    int code = 0;
    try {
        code = context.action();
    } catch (const dsc::Error& error) {
        dsc::app::data_out().flush();  // output from before the error
        throw with_choice_of_columns(app, error);
    } catch (...) {
        dsc::app::data_out().flush();
        throw;
    }
    finish_data(code);
    return code;
}

/// The exit code of the command; every error has become a message.
int run_and_explain(int argc, char** argv) {
    try {
        return run(argc, argv);
    } catch (const dsc::Error& error) {
        print_error(error);
        return static_cast<int>(error.exit_code());
    } catch (const std::bad_alloc&) {
        dsc::app::tell("error: out of memory; use a smaller cloud or a coarser mesh\n");
    } catch (const std::exception& error) {
        dsc::app::tell(
            fmt::format("error: internal: {}; please report it with the command\n", error.what()));
    } catch (...) {
        dsc::app::tell("error: internal: unknown exception; please report it with the command\n");
    }
    return static_cast<int>(dsc::ExitCode::internal);
}

}  // namespace

int main(int argc, char** argv) {
    dsc::app::take_standard_streams();
    dsc::app::guard_exit();
    dsc::give_back_large_blocks();
    dsc::app::start_log({});
    return dsc::app::leave(run_and_explain(argc, argv));
}
