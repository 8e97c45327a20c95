// Box and number of cells of a lattice from its options, and the lattice itself.
#include "dsc/generate/lattice.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include <dsc/base/error.hpp>

#include "generate/lattice_frame.hpp"
#include "generate/lattice_octree.hpp"
#include "generate/lattice_tiling.hpp"

namespace dsc::generate {
namespace {

constexpr unsigned cells_of_top = 6;  // least number of the largest cells along the box

// The number of layers of equal cells with which their size grows by `growth` from layer to layer
// on average.
unsigned coarse_layers(double growth) {
    return static_cast<unsigned>(std::ceil(std::log(2.0) / std::log(growth) - 1e-9));
}

}  // namespace

namespace lattice {

unsigned top_level(const LatticeOptions& options) {
    unsigned top = 0;
    if (options.growth > 1.0) {
        while (static_cast<unsigned>(options.wanted_cells()) >> (top + 1) >= cells_of_top) ++top;
    }
    return top;
}

Frame frame_of(const LatticeOptions& options) {
    // Even, so that the centre of the box is a corner of cells; the half_width of a cube relies on
    // this.
    const auto cells = static_cast<unsigned>(options.wanted_cells());
    const unsigned step = std::max(2U, 1U << top_level(options));
    Frame frame{(cells + step - 1) / step * step, options.box, static_cast<double>(options.cells),
                options.box_centre};
    if (options.cell) {
        frame.length = *options.cell;
        frame.units = 2.0;
    }
    return frame;
}

ConfigError too_large(std::string_view name, std::size_t leaves, std::string_view remedy) {
    return ConfigError(
        "lattice.size", name,
        std::to_string(leaves) + " cells, but the limit is " + std::to_string(most_leaves), remedy);
}

}  // namespace lattice

double LatticeOptions::wanted_cells() const {
    return cell ? std::ceil(2 * box / *cell - 1e-9) : static_cast<double>(cells);
}

double finest_cell(const LatticeOptions& options) { return lattice::frame_of(options).cell(); }

Box3 box_of(const LatticeOptions& options) {
    const lattice::Frame frame = lattice::frame_of(options);
    const auto end = static_cast<int>(2 * frame.side);
    return {frame.point({0, 0, 0}), frame.point({end, end, end})};
}

mesh::TetMesh make_lattice(const LatticeOptions& options, const SameWithin& same,
                           std::string_view name, const CancelToken* cancel) {
    const unsigned top = lattice::top_level(options);
    const lattice::Frame frame = lattice::frame_of(options);
    const lattice::Octree octree(frame, top, same, static_cast<unsigned>(options.layers),
                                 top > 0 ? coarse_layers(options.growth) : 0);
    if (octree.leaves() > lattice::most_leaves) {
        throw lattice::too_large(name, octree.leaves(),
                                 "use fewer `cells` or `layers`, or a larger `growth`");
    }
    return lattice::tile(octree, frame, options.finest, cancel);
}

bool labels_touch_box(const mesh::TetMesh& mesh) {
    const Box3 box = bounding_box(mesh.points);
    const auto on_box = [&](std::uint32_t v) {
        const Vec3& p = mesh.points[v];
        return (p.array() <= box.low.array()).any() || (p.array() >= box.high.array()).any();
    };
    for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
        if (mesh.labels[t] != 0 && std::any_of(mesh.tets[t].begin(), mesh.tets[t].end(), on_box))
            return true;
    }
    return false;
}

}  // namespace dsc::generate
