// You learn how to write your own loop: your own velocity, repairs by a plugin, changes of
// topology.
#include <iostream>

#include <dsc/generate/shape_mesh.hpp>
#include <dsc/host/host.hpp>
#include <dsc/kernel/deformer.hpp>
#include <dsc/mesh/adopt.hpp>
#include <dsc/mesh/validate.hpp>
#include <dsc/run/repair_policy.hpp>

using namespace dsc;

/// The displacement of a vertex per step. The normals point out of the solid, so the solid grows.
Vec3 velocity(const surface::SurfaceView& view, std::size_t vertex) {
    return 0.02 * view.normals[vertex];
}

int main() {
    // The host finds the plugins of the installation and creates strategies by their names.
    host::Host host;
    host.load_all(host::search_path({}));
    const auto improvement =
        host.create<hooks::Improvement>({.type = "dsc", .params = {}}, "improvement");

    const std::vector<generate::Shape> balls = {{.centre = {-0.55, 0.0, 0.0}, .radius = 0.4},
                                                {.centre = {0.55, 0.0, 0.0}, .radius = 0.4}};
    kernel::Deformer deformer(
        mesh::adopt(generate::make_shape_mesh({.cells = 20}, balls, "balls"), "balls"));

    surface::SurfaceView view;
    std::vector<Vec3> displacements;
    for (std::uint64_t step = 1; step <= 12; ++step) {
        surface::build_view(deformer.complex(), view);
        displacements.resize(view.vertex_count());
        for (std::size_t v = 0; v < displacements.size(); ++v) displacements[v] = velocity(view, v);

        // The kernel asks which repairs to try and which changes of topology to accept.
        const hooks::StepContext context{.step = step,
                                         .surface = view,
                                         .target_length = deformer.target_length(),
                                         .box = deformer.complex().box()};
        const kernel::RepairPolicy policy = run::repair_policy(*improvement, context);
        for (const kernel::Event& event :
             deformer.step(view.vertex_ids, displacements, policy).events) {
            std::cout << "step " << step << ": " << kernel::name(event.kind) << "\n";
        }
    }

    const mesh::InterfaceCounts counts = mesh::count_interface(deformer.complex());
    std::cout << "shells: " << counts.shells << ", genus: " << counts.genus() << "\n"
              << "volume: " << mesh::labelled_volume(deformer.complex()) << "\n";
}
