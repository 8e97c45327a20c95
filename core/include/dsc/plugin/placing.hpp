#pragma once
// For generators that start from a file: its readers, and in whose units its coordinates are.

#include <dsc/config/params.hpp>
#include <dsc/hooks/initial_mesh.hpp>
#include <span>

namespace dsc::plugin {

/// Units of a file's coordinates: normalised ones, or those of the experiment's cloud, which the cloud's normalisation
/// takes to normalised ones.
enum class Coordinates { as_they_are, of_input };

/// Declares the parameter `coordinates`. [setup]
template <class Params>
void declare_coordinates(config::ParamSchema<Params>& schema, Coordinates Params::*member) {
    schema
        .choice("coordinates", member,
                {{"as_they_are", Coordinates::as_they_are}, {"of_input", Coordinates::of_input}})
        .doc(
            "Units of the file: 'as_they_are' are normalised units, 'of_input' those of the input's cloud, as in the "
            "results of a former run.");
}

/// The host's readers; throws StrategyError "strategy.no_files" where it has none. [setup]
const hooks::MeshFiles& require_files(const hooks::InitialMeshContext& context);

/// Takes a file's points to normalised units. Throws ConfigError "config.no_input" for coordinates of an input where the
/// experiment has none. [setup]
void place(std::span<Vec3> points, Coordinates coordinates, const hooks::InitialMeshContext& context);

}  // namespace dsc::plugin
