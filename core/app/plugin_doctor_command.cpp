// dsc plugin doctor FILE
#include <memory>

#include <nlohmann/json.hpp>

#include <dsc/base/error.hpp>
#include <dsc/host/doctor.hpp>

#include "commands.hpp"
#include "load_guard.hpp"
#include "plugins.hpp"
#include "standard_streams.hpp"

namespace dsc::app {
namespace {

struct DoctorArguments {
    std::string file;
    bool json = false;
};

std::string_view name(host::Examination::Result result) {
    switch (result) {
        case host::Examination::Result::ok: return "ok";
        case host::Examination::Result::note: return "note";
        case host::Examination::Result::failed: return "FAIL";
        case host::Examination::Result::not_reached: return "-";
    }
    return "?";
}

std::string text(const std::vector<host::Examination>& examinations) {
    std::string all;
    for (const host::Examination& e : examinations) {
        std::string row(name(e.result));
        row.resize(6, ' ');
        row += e.step;
        row.resize(19, ' ');
        all += row + e.text + "\n";
    }
    return all;
}

std::string json(const std::string& file, const std::vector<host::Examination>& examinations) {
    nlohmann::ordered_json steps = nlohmann::ordered_json::array();
    for (const host::Examination& e : examinations) {
        steps.push_back(
            {{"step", e.step}, {"result", std::string(name(e.result))}, {"text", e.text}});
    }
    return nlohmann::ordered_json{
               {"file", file}, {"healthy", host::healthy(examinations)}, {"steps", steps}}
               .dump(2, ' ', false, nlohmann::json::error_handler_t::replace) +
           "\n";
}

int execute(const DoctorArguments& arguments) {
    const auto examinations = [&arguments] {
        const LoadGuard guard;
        return host::examine(arguments.file, Plugins({}).search_path());
    }();
    data_out() << (arguments.json ? json(arguments.file, examinations) : text(examinations));
    if (host::healthy(examinations)) return 0;
    return static_cast<int>(ExitCode::plugin);
}

}  // namespace

void add_plugin_doctor(CLI::App& plugin, Context& context) {
    CLI::App* command =
        plugin.add_subcommand("doctor", "Find out step by step why a file is not a working plugin");
    const auto arguments = std::make_shared<DoctorArguments>();
    command->add_option("FILE", arguments->file, "Plugin library, libdsc_NAME.so, or Python file")
        ->required();
    command->add_flag("--json", arguments->json, "Print JSON instead of text");
    set_action(*command, context, [arguments] { return execute(*arguments); });
}

}  // namespace dsc::app
