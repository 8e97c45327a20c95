// Initial mesh `@NAME@`: a torus around the z axis in a box of tets.
//
//     inside: hypot(hypot(x, y) - ring, z) < tube
//
// A tet gets label 1 if its centre is inside.
#include <array>
#include <cmath>
#include <utility>

#include <dsc/hooks/initial_mesh.hpp>
#include <dsc/plugin/plugin.hpp>

namespace {

using dsc::Vec3;

class @CLASS@ final : public dsc::hooks::InitialMesh {
public:
    /// The parameters that an experiment may set; the values here are the defaults.
    struct Params {
        int cells = 24;
        double ring = 0.8;
        double tube = 0.35;
    };
    static void declare(dsc::config::ParamSchema<Params>& schema) {
        schema.integer("cells", &Params::cells)
            .range(4, 100, "dimensionless")
            .doc("Number of cells along each edge of the box.");
        schema.real("ring", &Params::ring)
            .range(0, 1.4, "length")
            .doc("Radius of the circle that the tube follows.");
        schema.real("tube", &Params::tube)
            .range(0, 1.4, "length")
            .open_low()
            .doc("Radius of the tube.");
        schema.check([](const Params& p) { return p.tube < p.ring; },
                     "tube must be less than ring, otherwise there is no hole");
        schema.check([](const Params& p) { return p.ring + p.tube <= 1.4; },
                     "ring + tube must be at most 1.4, to stay in the box");
    }

    @CLASS@(const Params& params, const dsc::plugin::Setup&) : params_(params) {}

    // Called once, before the first step: returns plain arrays, which the kernel checks and adopts.
    dsc::mesh::TetMesh build(const dsc::hooks::InitialMeshContext& context) override {
        const auto cells = static_cast<unsigned>(params_.cells);
        dsc::mesh::TetMesh mesh;
        add_points(mesh, cells);
        for (unsigned k = 0; k < cells; ++k) {
            if (context.cancel != nullptr && context.cancel->cancelled())
                throw dsc::CancelledError("the run was stopped while it made its initial mesh");
            for (unsigned j = 0; j < cells; ++j) {
                for (unsigned i = 0; i < cells; ++i) add_cell(mesh, cells, {i, j, k});
            }
        }
        return mesh;
    }

private:
    static constexpr double half = 1.5;  // of the edge of the box

    static void add_points(dsc::mesh::TetMesh& mesh, unsigned cells) {
        const auto coordinate = [cells](unsigned i) { return half * (2.0 * i / cells - 1.0); };
        for (unsigned k = 0; k <= cells; ++k) {
            for (unsigned j = 0; j <= cells; ++j) {
                for (unsigned i = 0; i <= cells; ++i)
                    mesh.points.emplace_back(coordinate(i), coordinate(j), coordinate(k));
            }
        }
    }

    // Six tets, one for each path along the edges of the cell from its lowest to its highest
    // corner. All cells are cut in the same way, so neighbours have the same diagonal on the face
    // between them.
    void add_cell(dsc::mesh::TetMesh& mesh, unsigned cells,
                  const std::array<unsigned, 3>& lowest) const {
        constexpr std::array<std::array<std::size_t, 3>, 6> ways = {
            {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {1, 0, 2}, {2, 1, 0}}};
        for (std::size_t w = 0; w < ways.size(); ++w) {
            std::array<unsigned, 3> corner = lowest;
            std::array<std::uint32_t, 4> tet{};
            tet[0] = index(corner, cells);
            for (std::size_t c = 0; c < 3; ++c) {
                ++corner[ways[w][c]];
                tet[c + 1] = index(corner, cells);
            }
            // The last three are mirror images: make them positive.
            if (w >= 3) std::swap(tet[2], tet[3]);
            Vec3 centre = Vec3::Zero();
            for (const std::uint32_t v : tet) centre += 0.25 * mesh.points[v];
            mesh.tets.push_back(tet);
            mesh.labels.push_back(inside(centre) ? 1 : 0);
        }
    }

    static std::uint32_t index(const std::array<unsigned, 3>& corner, unsigned cells) {
        return corner[0] + (cells + 1) * (corner[1] + (cells + 1) * corner[2]);
    }

    bool inside(const Vec3& p) const {
        return std::hypot(std::hypot(p.x(), p.y()) - params_.ring, p.z()) < params_.tube;
    }

    Params params_;
};

}  // namespace

DSC_PLUGIN("@NAME@", "0.1.0", "BSD-3-Clause", "Initial mesh @NAME@") {
    registrar.add<@CLASS@>("@NAME@", "a torus around the z axis in a box of tets");
}
