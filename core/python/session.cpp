// The plugins of a call.
#include "session.hpp"

#include <utility>

#include "declaration.hpp"

namespace dsc::python {

void Session::add_own(run::InputFiles& files) {
    const py::object groups = py::module_::import("dsc._strategies").attr("own_strategies")();
    for (const py::handle group : groups) {
        const plugin::PluginInfo info = info_of(group.attr("about"));
        const py::object text = group.attr("text");
        if (!text.is_none()) files.add_text(info.file, text.cast<std::string>());
        host_.add(info, records_of(group.attr("classes")));
    }
}

run::PluginLoader Session::loader() {
    return [this](const std::vector<std::string>& experiment) -> const config::StrategyLookup& {
        host::SearchOptions options;
        options.command_line.assign(plugins_.begin(), plugins_.end());
        options.experiment.assign(experiment.begin(), experiment.end());
        host_.load_all(host::search_path(options));
        return host_;
    };
}

}  // namespace dsc::python
