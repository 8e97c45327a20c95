#include "strategy.hpp"

#include <algorithm>
#include <cstdio>
#include <dsc/base/workers.hpp>
#include <dsc/mesh/adopt.hpp>
#include <dsc/plugin/lattice_params.hpp>
#include <dsc/surface/analysis.hpp>
#include <dsc/surface/surface_view.hpp>

#include "features.hpp"
#include "snapping.hpp"

namespace dsc::strategies {
namespace {

using from_surface::Deviation;
using from_surface::Features;
using from_surface::Solid;

constexpr const char* name = "initial mesh 'from_surface'";
/// A tet belongs to the solid if no vertex is farther outside than this fraction of a finest cell. So no tet outside has four
/// vertices on the interface, and the interface must move as far inwards as outwards.
constexpr double reach = 0.4;
/// Distance between the sample points for distances, in finest cells.
constexpr double probe_spacing = 0.5;
constexpr std::size_t block = 1024;  // points
constexpr double pi = 3.14159265358979323846;
constexpr double rounding = 1e-12;

void centre_and_scale(std::vector<Vec3>& points, const Vec3& centre, double half_extent) {
    const Box3 box = bounding_box(points);
    const Vec3 middle = box.centre();
    const double scale = half_extent / (0.5 * box.size().maxCoeff());
    for (Vec3& p : points) p = centre + (p - middle) * scale;
}

/// Factor by which a point may be farther from a sharp edge or a corner than from a plane, so that the solid grown by a layer
/// also has sharp edges and corners. It is exact where two or three planes meet at right angles.
double mitre(const Features& features, const Vec3& on_surface) {
    if (features.empty() || features.nearest(on_surface).distance > rounding * on_surface.norm()) return 1.0;
    return features.corner(on_surface) ? 1.7320508 : 1.4142136;
}

std::string number(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.4g", value);
    return text;
}

std::string topology(const surface::SurfaceReport& report) {
    return std::to_string(report.shells) + (report.shells == 1 ? " shell" : " shells") + " of genus " +
           std::to_string(report.genus);
}

std::string place(const Vec3& p) { return "(" + number(p.x()) + ", " + number(p.y()) + ", " + number(p.z()) + ")"; }

}  // namespace

void FromSurface::declare(config::ParamSchema<Params>& schema) {
    schema.file("file", &Params::file)
        .required()
        .extensions({".obj", ".ply", ".off", ".stl"})
        .doc("Closed, manifold surface whose faces are oriented alike; it may have several shells and cavities.");
    plugin::declare_coordinates(schema, &Params::coordinates);
    schema.real("fit", &Params::fit)
        .greater(0)
        .unit("length")
        .doc(
            "Longest half-extent to which the surface is scaled after it is centred in the box; unset: the surface is not "
            "moved.");
    schema.integer("label", &Params::label).range(1, 1000).unit("1").doc("Label of the tets inside.");
    schema.real("tolerance", &Params::tolerance)
        .greater(0)
        .unit("finest cells")
        .doc(
            "Greatest distance allowed between surface and interface, in both directions; an initial mesh that exceeds it is "
            "refused.");
    schema.real("sharp", &Params::sharp)
        .range(0, 180)
        .unit("degrees")
        .doc(
            "Angle between the faces of an edge above which vertices of the interface are moved onto the edge and its "
            "corners; 180: none are.");
    schema.integer("intersections", &Params::intersections)
        .range(0, 1000000)
        .unit("1")
        .doc("Number of pairs of faces that may intersect; the solid contains all points that the surface winds around.");
    plugin::declare_lattice(schema, "the surface");
    schema.check([](const Params& p) { return !p.fit || p.coordinates == plugin::Coordinates::as_they_are; },
                 "fit moves the surface away from the input's cloud; leave out fit or 'coordinates: of_input'");
}

FromSurface::FromSurface(const Params& params, const plugin::Setup&) : params_(params) {}

mesh::TetMesh FromSurface::build(const hooks::InitialMeshContext& context) {
    const Solid solid(read(context));
    const double cell = generate::finest_cell(params_);
    const Features features(solid.surface(), params_.sharp * pi / 180);
    mesh::Complex complex = mesh::adopt(labelled(solid, features, context), name, nullptr, 0.0);
    const generate::ProjectReport snapped = from_surface::snap(complex, solid, features, cell);
    mesh::TetMesh out = complex.to_mesh();
    const surface::TriangleMesh interface = surface::extract_interface(out);
    if (interface.faces.empty()) {
        throw GeometryError("from_surface.vanished", std::string(name) + ": " + params_.file +
                                                         " is smaller than a cell of the lattice, so it contains no tet; use "
                                                         "more `cells` or `fit` it into the box");
    }
    const surface::SurfaceReport given = surface::analyse(solid.surface()), made = surface::analyse(interface);
    const Deviation found = from_surface::deviation(interface, solid, probe_spacing * cell, context.workers);
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
    judge(found, cell);
    if (given.shells != made.shells || given.genus != made.genus) {
        log(LogLevel::warning, std::string(name) + ": the surface has " + topology(given) + ", but the mesh has " + topology(made) +
                                   "; use more `cells` if gaps or walls are thinner than two cells");
    }
    return out;
}

surface::TriangleMesh FromSurface::read(const hooks::InitialMeshContext& context) const {
    surface::TriangleMesh mesh = plugin::require_files(context).read_surface(params_.file);
    plugin::place(mesh.points, params_.coordinates, context);
    if (params_.fit) centre_and_scale(mesh.points, params_.box_centre, *params_.fit);
    return from_surface::require_solid(mesh, params_.file, static_cast<std::size_t>(params_.intersections),
                                       context.workers);
}

mesh::TetMesh FromSurface::labelled(const Solid& solid, const Features& features, const hooks::InitialMeshContext& context) const {
    const Box3 box = generate::box_of(params_), used = bounding_box(solid.surface().points);
    if ((used.low.array() <= box.low.array()).any() || (used.high.array() >= box.high.array()).any()) {
        throw ConfigError("lattice.box", std::string(name) + ": " + params_.file + " extends from " + place(used.low) +
                                             " to " + place(used.high) + ", beyond the box from " + place(box.low) +
                                             " to " + place(box.high) + "; `fit` it into the box or make `box` larger");
    }
    const double outside = reach * generate::finest_cell(params_);
    mesh::TetMesh out = generate::make_lattice(
        params_, [&](const Vec3& centre, double radius) { return solid.nearest(centre).distance > radius; }, name,
        context.cancel);
    std::vector<char> inside(out.points.size());
    for_blocks(context.workers, out.points.size(), block, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const Vec3& p = out.points[i];
            inside[i] = solid.holds(p) || solid.nearest(p).distance <= outside * mitre(features, solid.nearest(p).point) ? 1 : 0;
        }
    });
    for (std::size_t t = 0; t < out.tets.size(); ++t) {
        const auto& tet = out.tets[t];
        if (std::all_of(tet.begin(), tet.end(), [&](std::uint32_t v) { return inside[v] != 0; }))
            out.labels[t] = params_.label;
    }
    if (generate::labels_touch_box(out)) {
        throw ConfigError("lattice.box", std::string(name) + ": " + params_.file +
                                             " comes too close to the faces of the box; make `box` larger or `fit` smaller");
    }
    return out;
}

void FromSurface::judge(const Deviation& found, double cell) const {
    const double distance = found.greatest() / cell;
    log(LogLevel::info, std::string(name) + ": the surface and the mesh are at most " + number(distance) +
                            " finest cells apart, " + number(found.greatest()));
    if (distance <= params_.tolerance) return;
    throw GeometryError("from_surface.tolerance",
                        std::string(name) + ": " + params_.file + " and the mesh are " + number(distance) +
                            " finest cells apart at " + place(found.farthest) + ", more than the tolerance of " +
                            number(params_.tolerance) + "; use more `cells`, or allow a larger `tolerance`");
}

}  // namespace dsc::strategies
