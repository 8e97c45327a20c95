// You learn how to make labelled tets, make a complex of them and move it with a Deformer.
#include <iostream>
#include <vector>

#include <dsc/generate/shape_mesh.hpp>
#include <dsc/kernel/deformer.hpp>
#include <dsc/mesh/adopt.hpp>
#include <dsc/mesh/validate.hpp>
#include <dsc/surface/surface_view.hpp>

int main() {
    using namespace dsc;

    // A box of tets, 3 units wide. Tets inside the ball have the label 1, all others the label 0.
    const std::vector<generate::Shape> shapes = {
        {.shape = generate::ShapeKind::sphere, .radius = 0.6}};
    const mesh::TetMesh tets = generate::make_shape_mesh({.cells = 16, .box = 1.5}, shapes, "ball");

    // adopt() checks the tets and makes a complex of them. The Deformer keeps the complex valid.
    kernel::Deformer deformer(mesh::adopt(tets, "ball"));
    std::cout << "volume before: " << mesh::labelled_volume(deformer.complex()) << "\n";

    // A view is the interface as flat arrays. Each step needs a new one: a step changes the mesh.
    surface::SurfaceView view;
    for (int step = 1; step <= 5; ++step) {
        surface::build_view(deformer.complex(), view);
        const std::vector<Vec3> displacements(view.vertex_count(), Vec3(0.02, 0.0, 0.0));
        // The policy decides about repairs. An empty policy allows none: vertices only move.
        const kernel::StepReport report =
            deformer.step(view.vertex_ids, displacements, kernel::RepairPolicy{});
        std::cout << "step " << step << ": " << report.arrived << " of " << report.requested
                  << " vertices arrived\n";
    }

    const mesh::ComplexReport check = mesh::validate(deformer.complex());
    std::cout << "volume after: " << mesh::labelled_volume(deformer.complex()) << "\n"
              << "inverted tets: " << check.inverted_tets << ", faults: " << check.faults.size()
              << "\n";
    return check.valid() ? 0 : 1;
}
