// You learn how to extract surfaces from labelled tets, measure them and write them to files.
#include <iostream>

#include <dsc/generate/shape_mesh.hpp>
#include <dsc/io/read.hpp>
#include <dsc/io/write.hpp>
#include <dsc/mesh/adopt.hpp>
#include <dsc/surface/analysis.hpp>
#include <dsc/surface/measure.hpp>
#include <dsc/surface/surface_view.hpp>

using namespace dsc;

void print(const char* what, const surface::TriangleMesh& mesh) {
    const surface::SurfaceReport report = surface::analyse(mesh);
    std::cout << what << ": " << report.faces << " faces, volume " << report.volume << ", "
              << (report.closed_manifold() ? "closed" : "open") << "\n";
}

int main() {
    // Two phases: a box with the label 1, in it a ball with the label 2. The last shape decides.
    const std::vector<generate::Shape> shapes = {
        {.shape = generate::ShapeKind::box, .half_size = {0.8, 0.8, 0.8}, .label = 1},
        {.shape = generate::ShapeKind::sphere, .radius = 0.5, .label = 2}};
    const mesh::Complex complex = mesh::adopt(
        generate::make_shape_mesh({.cells = 24}, shapes, "box and ball"), "box and ball");

    // Plain arrays. The interface consists of all faces between tets with different labels.
    const mesh::TetMesh tets = complex.to_mesh();
    const surface::TriangleMesh interface = surface::extract_interface(tets);
    std::cout << "interface: " << interface.faces.size() << " faces\n";
    print("label 1", surface::extract_phase(tets, 1));
    print("label 2", surface::extract_phase(tets, 2));

    // The extension decides the format. A file is complete or it is not there.
    io::write_surface("interface.ply", interface, {}, surface::vertex_normals(interface));
    io::write_surface("label_2.obj", surface::extract_phase(tets, 2));
    io::write_volume("volume.vtu", tets);
    const bool equal = io::read_surface("interface.ply").points == interface.points;
    std::cout << "points read back are " << (equal ? "equal" : "different") << "\n";
}
