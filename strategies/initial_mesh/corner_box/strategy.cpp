// Initial mesh `corner_box`: a sphere or box joined to the corners of the outer box, with no
// vertices between them.
//
// This is the initial mesh of the Illinois DSC [Saul2015, ch. 3, figure 3.2]: every vertex of the
// interface is joined to the nearest corner of the box, whose octant contains it; a vertex on a
// border of octants is joined to each of their corners. Outside the solid there are only the box's
// eight vertices. solid.cpp builds the tets of the solid.
#include <algorithm>

#include <dsc/base/version.hpp>
#include <dsc/geometry/predicates.hpp>
#include <dsc/hooks/initial_mesh.hpp>
#include <dsc/plugin/plugin.hpp>

#include "solid.hpp"

namespace {

using dsc::Vec3;
using dsc::corner_box::Octant;
using dsc::corner_box::Solid;

// Fills the space between a solid and the corners of the box.
class Shell {
public:
    Shell(const Solid& solid, double half)
        : mesh_{solid.points, solid.tets, std::vector<dsc::mesh::Label>(solid.tets.size(), 1)} {
        first_corner_ = static_cast<std::uint32_t>(solid.points.size());
        for (unsigned octant = 0; octant < 8; ++octant) {
            mesh_.points.push_back(
                half * Vec3(octant & 1U ? 1 : -1, octant & 2U ? 1 : -1, octant & 4U ? 1 : -1));
        }
        for (const auto& face : solid.faces)
            add({face.corners[0], face.corners[1], face.corners[2], corner(face.octant)});
        join_octants(solid);
        close_sides(solid);
        for (auto& tet : mesh_.tets) orient(tet);
    }
    dsc::mesh::TetMesh take() { return std::move(mesh_); }

private:
    std::uint32_t corner(unsigned octant) const { return first_corner_ + octant; }
    void add(const std::array<std::uint32_t, 4>& tet) {
        mesh_.tets.push_back(tet);
        mesh_.labels.push_back(0);
    }
    void orient(std::array<std::uint32_t, 4>& tet) const {
        const auto& p = mesh_.points;
        if (dsc::geometry::orient3d(p[tet[0]], p[tet[1]], p[tet[2]], p[tet[3]]) < 0)
            std::swap(tet[2], tet[3]);
    }

    // A tet of an edge of the surface on the border of two octants and the edge of the box between
    // their corners.
    void join_octants(const Solid& solid) {
        struct Side {
            std::uint32_t a, b;
            Octant octant;
        };
        std::vector<Side> sides;
        for (const auto& face : solid.faces) {
            for (std::size_t k = 0; k < 3; ++k) {
                const std::uint32_t a = face.corners[k], b = face.corners[(k + 1) % 3];
                sides.push_back({std::min(a, b), std::max(a, b), face.octant});
            }
        }
        std::sort(sides.begin(), sides.end(), [](const Side& x, const Side& y) {
            return x.a != y.a ? x.a < y.a : x.b != y.b ? x.b < y.b : x.octant < y.octant;
        });
        for (std::size_t i = 0; i + 1 < sides.size(); i += 2) {
            const Side &one = sides[i], &other = sides[i + 1];
            if (one.octant != other.octant)
                add({one.a, one.b, corner(one.octant), corner(other.octant)});
        }
    }

    // Four octants meet at a pole: two tets with the two triangles of the box's side in front of
    // it.
    void close_sides(const Solid& solid) {
        for (unsigned axis = 0; axis < 3; ++axis) {
            const unsigned u = 1U << ((axis + 1) % 3), v = 1U << ((axis + 2) % 3);
            for (const unsigned end : {0U, 1U}) {
                const unsigned base = end == 0 ? 1U << axis : 0U;
                const std::uint32_t pole = solid.poles[axis][end];
                add({pole, corner(base), corner(base | u), corner(base | u | v)});
                add({pole, corner(base), corner(base | u | v), corner(base | v)});
            }
        }
    }

    dsc::mesh::TetMesh mesh_;
    std::uint32_t first_corner_ = 0;
};

class CornerBox final : public dsc::hooks::InitialMesh {
public:
    enum class Shape { sphere, box };

    /// The parameters that an experiment may set; the values here are the defaults.
    struct Params {
        Shape shape = Shape::sphere;
        double radius = 1.0;
        Vec3 half_size = Vec3::Constant(0.8);
        Vec3 centre = Vec3::Zero();
        int divisions = 12;
        double box = 1.5;

        Vec3 extent() const {
            return shape == Shape::sphere ? Vec3(Vec3::Constant(radius)) : half_size;
        }
    };
    static void declare(dsc::config::ParamSchema<Params>& schema) {
        schema.choice("shape", &Params::shape, {{"sphere", Shape::sphere}, {"box", Shape::box}})
            .doc("Solid with label 1.");
        schema.real("radius", &Params::radius).greater(0, "length").doc("Radius of the sphere.");
        schema.vec3("half_size", &Params::half_size)
            .unit("length")
            .doc("Half the edge lengths of the solid box.");
        schema.vec3("centre", &Params::centre).unit("length").doc("Centre of the solid.");
        schema.integer("divisions", &Params::divisions)
            .range(1, 200, "dimensionless")
            .costly()
            .doc("Number of edges along an axis from the centre of the solid to its surface.");
        schema.real("box", &Params::box)
            .greater(0, "length")
            .doc("Half the edge length of the outer box, which is centred at 0.");
        schema.check([](const Params& p) { return p.half_size.minCoeff() > 0; },
                     "half_size must be above 0");
        schema.check(
            [](const Params& p) { return (p.centre.cwiseAbs() + p.extent()).maxCoeff() < p.box; },
            "the solid must lie inside the box and not touch it");
    }

    CornerBox(const Params& params, const dsc::plugin::Setup&) : params_(params) {}

    /// All tets are positive; the tets of the solid come first and have label 1.
    dsc::mesh::TetMesh build(const dsc::hooks::InitialMeshContext&) override {
        const auto divisions = static_cast<unsigned>(params_.divisions);
        const Solid solid =
            params_.shape == Shape::sphere
                ? dsc::corner_box::sphere(params_.centre, params_.radius, divisions)
                : dsc::corner_box::box(params_.centre, params_.half_size, divisions);
        return Shell(solid, params_.box).take();
    }

private:
    Params params_;
};

}  // namespace

DSC_PLUGIN("corner_box", DSC_VERSION, "BSD-3-Clause",
           "Start from a sphere or box joined to the corners of the outer box") {
    registrar.add<CornerBox>("corner_box", "a sphere or box joined to the eight corners of the "
                                           "outer box, with no vertices between them");
}
