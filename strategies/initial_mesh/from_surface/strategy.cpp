// Initial mesh `from_surface`: a graded box of tets whose interface lies on a closed surface from a
// file.
//
// The tets of a lattice are labelled by the solid that the surface bounds (solid.cpp). Then the
// vertices of the interface move onto the surface and onto its sharp edges and corners, as far as
// the quality of the tets allows (features.cpp, snapping.cpp). At the end the distances between
// interface and surface are measured (deviation.cpp).
#include <algorithm>
#include <optional>
#include <string>

#include <dsc/base/version.hpp>
#include <dsc/base/workers.hpp>
#include <dsc/generate/lattice.hpp>
#include <dsc/geometry/point_text.hpp>
#include <dsc/hooks/initial_mesh.hpp>
#include <dsc/mesh/adopt.hpp>
#include <dsc/plugin/coordinates.hpp>
#include <dsc/plugin/lattice_params.hpp>
#include <dsc/plugin/plugin.hpp>
#include <dsc/surface/analysis.hpp>
#include <dsc/surface/surface_view.hpp>
#include <dsc/text/numbers.hpp>
#include <dsc/text/words.hpp>

#include "deviation.hpp"
#include "features.hpp"
#include "snapping.hpp"

namespace {

using dsc::Vec3;

namespace from_surface = dsc::strategies::from_surface;
using from_surface::Deviation;
using from_surface::Features;
using from_surface::Solid;

constexpr const char* name = "initial mesh 'from_surface'";
/// A tet belongs to the solid if no vertex is farther outside than this fraction of a finest cell.
/// So no tet outside has four vertices on the interface, and the interface must move as far inwards
/// as outwards.
constexpr double reach = 0.4;
/// Distance between the sample points for distances, in finest cells.
constexpr double probe_spacing = 0.5;
constexpr std::size_t block = 1024;  // points
constexpr double pi = 3.14159265358979323846;
constexpr double rounding = 1e-12;

void centre_and_scale(std::vector<Vec3>& points, const Vec3& centre, double half_extent) {
    const dsc::Box3 box = dsc::bounding_box(points);
    const Vec3 middle = box.centre();
    const double scale = half_extent / (0.5 * box.size().maxCoeff());
    for (Vec3& p : points) p = centre + (p - middle) * scale;
}

/// Factor by which a point may be farther from a sharp edge or a corner than from a plane, so that
/// the solid grown by a layer also has sharp edges and corners. It is exact where two or three
/// planes meet at right angles.
double mitre(const Features& features, const Vec3& on_surface) {
    if (features.empty() || features.nearest(on_surface).distance > rounding * on_surface.norm())
        return 1.0;
    return features.corner(on_surface) ? 1.7320508 : 1.4142136;
}

std::string topology(const dsc::surface::SurfaceReport& report) {
    return dsc::text::counted(report.shells, "shell") + " of genus " + std::to_string(report.genus);
}

class FromSurface final : public dsc::hooks::InitialMesh {
public:
    /// The parameters that an experiment may set; the values here are the defaults.
    struct Params : dsc::generate::LatticeOptions {
        Params() { layers = 3; }
        std::string file;
        dsc::plugin::Coordinates coordinates = dsc::plugin::Coordinates::as_they_are;
        std::optional<double> fit;
        dsc::mesh::Label label = 1;
        double tolerance = 1.5;
        double sharp = 40.0;
        int intersections = 0;
    };
    static void declare(dsc::config::ParamSchema<Params>& schema) {
        schema.file("file", &Params::file)
            .required()
            .extensions({".obj", ".ply", ".off", ".stl"})
            .doc("Closed, manifold surface whose faces are oriented alike; it may have several "
                 "shells and cavities.");
        dsc::plugin::declare_coordinates(schema, &Params::coordinates);
        schema.real("fit", &Params::fit)
            .greater(0, "length")
            .doc("Longest half-extent to which the surface is scaled after it is centred in the "
                 "box; unset: the surface is not moved.");
        schema.integer("label", &Params::label)
            .range(1, 1000, "dimensionless")
            .doc("Label of the tets inside.");
        schema.real("tolerance", &Params::tolerance)
            .greater(0, "finest cells")
            .doc("Greatest distance allowed between surface and interface, in both directions; an "
                 "initial mesh that exceeds it is refused.");
        schema.real("sharp", &Params::sharp)
            .range(0, 180, "degrees")
            .doc("Angle between the faces of an edge above which vertices of the interface are "
                 "moved onto the edge and its corners; 180: none are.");
        schema.integer("intersections", &Params::intersections)
            .range(0, 1000000, "dimensionless")
            .doc("Number of pairs of faces that may intersect; the solid contains all points that "
                 "the surface winds around.");
        dsc::plugin::declare_lattice(schema, "the surface");
        schema.check(
            [](const Params& p) {
                return !p.fit || p.coordinates == dsc::plugin::Coordinates::as_they_are;
            },
            "fit moves the surface away from the input's cloud; leave out fit or 'coordinates: "
            "of_input'");
    }

    FromSurface(const Params& params, const dsc::plugin::Setup&) : params_(params) {}

    /// Throws IoError, GeometryError as from_surface::require_solid() and "from_surface.tolerance",
    /// ConfigError if the surface reaches the box or the mesh would be too large, CancelledError.
    dsc::mesh::TetMesh build(const dsc::hooks::InitialMeshContext& context) override {
        const Solid solid(read(context));
        const double cell = dsc::generate::finest_cell(params_);
        const Features features(solid.surface(), params_.sharp * pi / 180);
        dsc::mesh::Complex complex =
            dsc::mesh::adopt(labelled(solid, features, context), name, nullptr, 0.0);
        const dsc::generate::ProjectReport snapped =
            from_surface::snap(complex, solid, features, cell);
        dsc::mesh::TetMesh out = complex.to_mesh();
        const dsc::surface::TriangleMesh interface = dsc::surface::extract_interface(out);
        if (interface.faces.empty()) {
            throw dsc::GeometryError(
                "from_surface.vanished", name,
                params_.file + " is smaller than a cell of the lattice, so it contains no tet",
                "use more `cells` or `fit` it into the box");
        }
        const dsc::surface::SurfaceReport given = dsc::surface::analyse(solid.surface()),
                                          made = dsc::surface::analyse(interface);
        const Deviation found =
            from_surface::deviation(interface, solid, probe_spacing * cell, context.workers);
        figures_ = {{"finest_cell", cell},
                    {"interface_vertices", static_cast<double>(snapped.vertices)},
                    {"vertices_off_surface", static_cast<double>(snapped.off_surface)},
                    {"min_tet_quality", snapped.min_quality},
                    {"vertex_distance", found.of_vertices / cell},
                    {"interface_to_surface", found.of_interface / cell},
                    {"surface_to_interface", found.of_surface / cell},
                    {"surface_shells", static_cast<double>(given.shells)},
                    {"interface_shells", static_cast<double>(made.shells)},
                    {"surface_genus", static_cast<double>(given.genus)},
                    {"interface_genus", static_cast<double>(made.genus)},
                    {"surface_volume", std::abs(given.volume)},
                    {"interface_volume", made.volume}};
        check_deviation(found, cell);
        if (given.shells != made.shells || given.genus != made.genus) {
            dsc::log(dsc::LogLevel::warning,
                     std::string(name) + ": the surface has " + topology(given) +
                         ", but the mesh has " + topology(made) +
                         "; use more `cells` if gaps or walls are thinner than two cells");
        }
        return out;
    }

    /// Figures of the fit between mesh and surface; lengths in finest cells.
    dsc::hooks::Figures figures() const override { return figures_; }

private:
    dsc::surface::TriangleMesh read(const dsc::hooks::InitialMeshContext& context) const {
        dsc::surface::TriangleMesh mesh =
            dsc::plugin::require_files(context).read_surface(params_.file);
        dsc::plugin::place(mesh.points, params_.coordinates, context);
        if (params_.fit) centre_and_scale(mesh.points, params_.box_centre, *params_.fit);
        return from_surface::require_solid(
            mesh, params_.file, static_cast<std::size_t>(params_.intersections), context.workers);
    }

    dsc::mesh::TetMesh labelled(const Solid& solid, const Features& features,
                                const dsc::hooks::InitialMeshContext& context) const {
        const dsc::Box3 box = dsc::generate::box_of(params_),
                        used = dsc::bounding_box(solid.surface().points);
        if ((used.low.array() <= box.low.array()).any() ||
            (used.high.array() >= box.high.array()).any()) {
            throw dsc::ConfigError(
                "lattice.box", name,
                params_.file + " extends from " + dsc::geometry::point_text(used.low, 4) + " to " +
                    dsc::geometry::point_text(used.high, 4) + ", beyond the box from " +
                    dsc::geometry::point_text(box.low, 4) + " to " +
                    dsc::geometry::point_text(box.high, 4),
                "`fit` it into the box or make `box` larger");
        }
        const double outside = reach * dsc::generate::finest_cell(params_);
        dsc::mesh::TetMesh out = dsc::generate::make_lattice(
            params_,
            [&](const Vec3& centre, double radius) {
                return solid.nearest(centre).distance > radius;
            },
            name, context.cancel);
        std::vector<char> inside(out.points.size());
        dsc::for_blocks(
            context.workers, out.points.size(), block, [&](std::size_t begin, std::size_t end) {
                for (std::size_t i = begin; i < end; ++i) {
                    const Vec3& p = out.points[i];
                    inside[i] =
                        solid.holds(p) || solid.nearest(p).distance <=
                                              outside * mitre(features, solid.nearest(p).point)
                            ? 1
                            : 0;
                }
            });
        for (std::size_t t = 0; t < out.tets.size(); ++t) {
            const auto& tet = out.tets[t];
            if (std::all_of(tet.begin(), tet.end(),
                            [&](std::uint32_t v) { return inside[v] != 0; }))
                out.labels[t] = params_.label;
        }
        if (dsc::generate::labels_touch_box(out)) {
            throw dsc::ConfigError("lattice.box", name,
                                   params_.file + " comes too close to the faces of the box",
                                   "make `box` larger or `fit` smaller");
        }
        return out;
    }

    void check_deviation(const Deviation& found, double cell) const {
        const double distance = found.greatest() / cell;
        dsc::log(dsc::LogLevel::info,
                 std::string(name) + ": the surface and the mesh are at most " +
                     dsc::text::rounded(distance, 4) + " finest cells apart, " +
                     dsc::text::rounded(found.greatest(), 4));
        if (distance <= params_.tolerance) return;
        throw dsc::GeometryError(
            "from_surface.tolerance", name,
            params_.file + " and the mesh are " + dsc::text::rounded(distance, 4) +
                " finest cells apart at " + dsc::geometry::point_text(found.farthest, 4) +
                ", more than the tolerance of " + dsc::text::rounded(params_.tolerance, 4),
            "use more `cells`, or allow a larger `tolerance`");
    }

    Params params_;
    dsc::hooks::Figures figures_;
};

}  // namespace

DSC_PLUGIN("from_surface", DSC_VERSION, "BSD-3-Clause", "Start from a closed surface in a file") {
    registrar.add<FromSurface>("from_surface",
                               "a graded box of tets, snapped to a closed surface from a file");
}
