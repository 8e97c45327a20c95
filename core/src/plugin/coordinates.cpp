// Readers and units for generators that start from a file.
#include "dsc/plugin/coordinates.hpp"

#include <dsc/base/error.hpp>

namespace dsc::plugin {

const hooks::MeshFiles& require_files(const hooks::InitialMeshContext& context) {
    if (context.files != nullptr) return *context.files;
    throw StrategyError("strategy.no_files", "initial mesh",
                        "it reads a file, but the host provides no readers",
                        "set InitialMeshContext::files");
}

void place(std::span<Vec3> points, Coordinates coordinates,
           const hooks::InitialMeshContext& context) {
    if (coordinates == Coordinates::as_they_are) return;
    if (context.cloud == nullptr) {
        throw ConfigError("config.no_input", "initial_mesh",
                          "`coordinates` is 'of_input', but the experiment has no input",
                          "leave `coordinates` out, or add input: {cloud: {file: ...}}");
    }
    for (Vec3& p : points) p = context.cloud->transform().apply(p);
}

}  // namespace dsc::plugin
