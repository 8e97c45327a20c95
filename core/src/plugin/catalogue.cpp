// Creates strategies from their ids and parameters.
#include "dsc/plugin/catalogue.hpp"

#include <fmt/format.h>

#include <dsc/base/random.hpp>
#include <dsc/config/spelling.hpp>
#include <dsc/plugin/guarded.hpp>

#include "plugin/checked.hpp"

namespace dsc::plugin {
namespace {

template <class Hook>
std::unique_ptr<Hook> as(std::unique_ptr<hooks::Strategy> strategy) {
    return std::unique_ptr<Hook>(static_cast<Hook*>(strategy.release()));
}

std::unique_ptr<hooks::Strategy> check(std::unique_ptr<hooks::Strategy> made,
                                       Attribution attribution) {
    switch (attribution.who.kind) {
        case Kind::velocity:
            return check_velocity(as<hooks::VelocityField>(std::move(made)),
                                  std::move(attribution));
        case Kind::curvature:
            return check_curvature(as<hooks::CurvatureEstimator>(std::move(made)),
                                   std::move(attribution));
        case Kind::refinement:
            return check_refinement(as<hooks::RefinementPolicy>(std::move(made)),
                                    std::move(attribution));
        case Kind::initial_mesh:
            return check_initial_mesh(as<hooks::InitialMesh>(std::move(made)),
                                      std::move(attribution));
        case Kind::improvement:
            return check_improvement(as<hooks::Improvement>(std::move(made)),
                                     std::move(attribution));
        case Kind::observer:
            return check_observer(as<hooks::Observer>(std::move(made)), std::move(attribution));
        case Kind::filter:
            return check_filter(as<hooks::CloudFilter>(std::move(made)), std::move(attribution));
    }
    throw Error(ExitCode::internal, "plugin.kind", "catalogue", "a strategy has an unknown kind",
                "please report it with the experiment");
}

std::string place_of(const config::ConfigNode& params) {
    return params.position().known() ? params.position().describe() : std::string();
}

[[noreturn]] void unknown_strategy(const Catalogue& catalogue, Kind kind, const std::string& id,
                                   const std::string& path) {
    const std::string name(kind_name(kind));
    const std::vector<std::string> known = catalogue.ids(name);
    if (known.empty()) {
        throw PluginError("plugin.unknown_strategy", path,
                          fmt::format("there is no {} '{}', and no plugin with a strategy of this "
                                      "kind is loaded",
                                      name, id),
                          "use --plugin or DSC_PLUGIN_PATH to load one");
    }
    throw PluginError("plugin.unknown_strategy", path, fmt::format("there is no {} '{}'", name, id),
                      fmt::format("{}loaded are {}; --plugin and DSC_PLUGIN_PATH load others",
                                  config::did_you_mean(id, known), config::join(known)));
}

}  // namespace

Registrar::~Registrar() = default;
Catalogue::~Catalogue() = default;

const config::Schema* Catalogue::find_schema(const std::string& kind, const std::string& id) const {
    const auto known = find_kind(kind);
    const auto found = known ? find(*known, id) : std::nullopt;
    return found ? found->strategy->schema.get() : nullptr;
}

std::vector<std::string> Catalogue::ids(const std::string& kind) const {
    std::vector<std::string> result;
    const auto known = find_kind(kind);
    for (const StrategyInfo& info : list()) {
        if (known && info.strategy->kind == *known) result.push_back(info.strategy->id);
    }
    return result;
}

std::unique_ptr<hooks::Strategy> Catalogue::create(Kind kind, const config::StrategyConfig& config,
                                                   const std::string& path) const {
    const auto found = find(kind, config.type);
    if (!found) unknown_strategy(*this, kind, config.type, path);
    const std::string owner = std::string(kind_name(kind)) + " '" + config.type + "'";
    config::Diagnostics diagnostics;
    const config::ConfigNode resolved =
        config::validate(config.params, *found->strategy->schema, *this, diagnostics, owner);
    diagnostics.throw_if_errors();

    const Setup setup(*this, path);
    Attribution attribution{{kind, config.type, path, found->plugin->name, found->plugin->version,
                             found->plugin->file.string(), place_of(config.params)},
                            setup.instance()};
    const Call call = attribution.call("constructor");
    auto made = guarded(call, [&] { return found->strategy->make(resolved, setup); });
    return check(std::move(made), std::move(attribution));
}

Setup::Setup(const Catalogue& catalogue, std::string path)
    : catalogue_(&catalogue), path_(std::move(path)), instance_(stream_id(path_)) {}

}  // namespace dsc::plugin
