#pragma once
// For generators that start from a file: access to its readers, and the units of its coordinates.

#include <span>

#include <dsc/config/params.hpp>
#include <dsc/hooks/initial_mesh.hpp>

namespace dsc::plugin {

/// Units of a file's coordinates: normalised units, or the units of the experiment's cloud, which
/// the cloud's normalisation converts.
enum class Coordinates { as_they_are, of_input };

/// Declares the parameter `coordinates`. [setup]
template <class Params>
void declare_coordinates(config::ParamSchema<Params>& schema, Coordinates Params::*member) {
    schema
        .choice("coordinates", member,
                {{"as_they_are", Coordinates::as_they_are}, {"of_input", Coordinates::of_input}})
        .doc("Units of the file: 'as_they_are' are normalised units; 'of_input' are the units of "
             "the input's cloud, as in the results of an earlier run.");
}

/// The host's readers. Throws StrategyError "strategy.no_files" if it has none. [setup]
const hooks::MeshFiles& require_files(const hooks::InitialMeshContext& context);

/// Converts a file's points to normalised units. Throws ConfigError "config.no_input" for
/// coordinates of an input if the experiment has no input. [setup]
void place(std::span<Vec3> points, Coordinates coordinates,
           const hooks::InitialMeshContext& context);

}  // namespace dsc::plugin
