#include "usage.hpp"

#include <algorithm>
#include <optional>
#include <regex>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <dsc/base/error.hpp>
#include <dsc/config/spelling.hpp>

namespace dsc::app {
namespace {

std::vector<std::string> names_of(const std::vector<const CLI::App*>& commands) {
    std::vector<std::string> names;
    for (const CLI::App* command : commands) names.push_back(command->get_name());
    return names;
}

std::vector<const CLI::App*> below(const CLI::App& command) {
    return command.get_subcommands([](const CLI::App*) { return true; });
}

/// The only name that begins with the word, otherwise the name with the most similar spelling.
std::optional<std::string> meant(const std::string& word, const std::vector<std::string>& names) {
    std::vector<std::string> longer;
    for (const std::string& name : names) {
        if (!word.empty() && name.rfind(word, 0) == 0) longer.push_back(name);
    }
    return longer.size() == 1 ? longer.front() : config::closest(word, names);
}

std::string hint(const std::optional<std::string>& name) {
    return name ? fmt::format("; did you mean '{}'?", *name) : std::string();
}

/// The innermost command that the words name, and the first word after it that is not an option of
/// it.
struct Reached {
    const CLI::App* command;
    std::string name;     ///< "dsc plugin"
    std::string unknown;  ///< empty if the words end or an option follows
};

Reached reach(const CLI::App& app, const std::vector<std::string>& words) {
    Reached at{&app, app.get_name(), ""};
    for (const std::string& word : words) {
        const std::vector<const CLI::App*> commands = below(*at.command);
        const auto found = std::find_if(commands.begin(), commands.end(),
                                        [&](const CLI::App* c) { return c->get_name() == word; });
        if (found == commands.end()) {
            if (!commands.empty() && word.rfind("-", 0) != 0) at.unknown = word;
            break;
        }
        at.command = *found;
        at.name += " " + word;
    }
    return at;
}

UsageError unknown_command(const Reached& at) {
    const std::vector<std::string> names = names_of(below(*at.command));
    const std::optional<std::string> near = meant(at.unknown, names);
    return UsageError("usage.command", at.name, fmt::format("there is no command '{}'", at.unknown),
                      near ? fmt::format("did you mean '{}'?", *near)
                           : fmt::format("the commands are {}", config::join(names)));
}

/// The first option of the call that the command does not have; empty if there is none.
std::string unknown_option(const CLI::App& app, const Reached& at) {
    for (const std::string& word : app.remaining(true)) {
        if (word.size() < 2 || word.front() != '-' || word == "--") continue;
        const std::string name = word.substr(0, word.find('='));
        std::vector<std::string> names;
        for (const CLI::Option* option : at.command->get_options()) {
            for (const std::string& known : option->get_lnames()) names.push_back("--" + known);
        }
        const std::string wanted =
            "--" + name.substr(std::min(name.find_first_not_of('-'), name.size()));
        return fmt::format("{} has no option '{}'{}; see {} --help", at.name, name,
                           hint(meant(wanted, names)), at.name);
    }
    return {};
}

using Turns = std::vector<std::pair<std::regex, const char*>>;

std::string replaced(std::string text, const Turns& turns) {
    for (const auto& [pattern, plain] : turns) text = std::regex_replace(text, pattern, plain);
    return text;
}

/// The parser's message in the words of the other messages.
std::string plain_text(const std::string& message) {
    static const Turns turns = {
        {std::regex("\n"), " "},
        {std::regex("^(\\S+) is required$"), "the argument $1 is missing"},
        {std::regex("^(\\S+): 1 required .* missing$"), "$1 needs a value"},
        {std::regex("^(\\S+): At Most 1 required but received \\d+$"), "$1 may be given only once"},
        {std::regex("^(\\S+): Value (.*) not in range 0 to 1797693\\d+$"),
         "$1: '$2' is not a number above 0"},
        {std::regex("^(\\S+): Value (.*) not in range (.*) to (.*)$"),
         "$1: '$2' is not a number from $3 to $4"},
        {std::regex("^The following arguments? w\\w+ not expected: (.*)$"),
         "the command does not accept '$1'"},
        {std::regex("^Could not convert: (\\S+) = (.*)$"), "$1: '$2' is not a valid number"},
        {std::regex("^(\\S+) excludes (\\S+)$"), "$1 and $2 cannot be used together"},
    };
    static const Turns zeros = {{std::regex("(\\.[0-9]*[1-9]|\\.)0+(?![0-9])"), "$1"},
                                {std::regex("([0-9])\\.(?![0-9])"), "$1"}};
    static const std::regex choice("^(\\S+): (.*) not in \\{(.*)\\}$");
    std::smatch parts;
    if (std::regex_match(message, parts, choice)) {
        return fmt::format("{}: '{}' is not one of {}", parts.str(1), parts.str(2),
                           std::regex_replace(parts.str(3), std::regex(","), ", "));
    }
    const bool range = message.find(" not in range ") != std::string::npos;
    return replaced(range ? replaced(message, zeros) : message, turns);
}

}  // namespace

std::string usage_text(const CLI::App& app, const std::vector<std::string>& words,
                       const CLI::ParseError& error) {
    const Reached at = reach(app, words);
    if (!at.unknown.empty())
        return fmt::format("{}; see {} --help", unknown_command(at).what(), at.name);
    if (std::string option = unknown_option(app, at); !option.empty()) return option;
    const std::vector<const CLI::App*> commands = below(*at.command);
    if (!commands.empty() && dynamic_cast<const CLI::RequiredError*>(&error) != nullptr) {
        return fmt::format("{} needs a command: {}; see {} --help", at.name,
                           config::join(names_of(commands)), at.name);
    }
    return fmt::format("{}; see {} --help", plain_text(error.what()), at.name);
}

std::string help_text(const CLI::App& app, const std::vector<std::string>& words) {
    const Reached at = reach(app, words);
    if (!at.unknown.empty()) throw unknown_command(at);
    // Not help(): after `dsc help` was parsed, it returns the help of the command `help`.
    return at.command->get_formatter()->make_help(at.command, at.name, CLI::AppFormatMode::Normal);
}

}  // namespace dsc::app
