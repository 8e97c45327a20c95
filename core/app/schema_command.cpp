// dsc schema
#include <memory>

#include "commands.hpp"
#include "json_schema.hpp"
#include "plugins.hpp"
#include "standard_streams.hpp"

namespace dsc::app {

void add_schema(CLI::App& app, Context& context) {
    CLI::App* command = app.add_subcommand(
        "schema",
        "Print the JSON Schema (draft-07) of an experiment, for editors and other checkers");
    const auto paths = std::make_shared<std::vector<std::string>>();
    add_plugins(*command, *paths);
    set_action(*command, context, [paths] {
        Plugins plugins(*paths);
        data_out() << json_schema(all_strategies(plugins.load())).dump(2) << "\n";
        return 0;
    });
}

}  // namespace dsc::app
