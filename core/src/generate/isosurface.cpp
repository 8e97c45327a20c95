// Isosurface stuffing: finds the mixed edges, snaps, cuts, collapses and smooths
// [LabelleShewchuk2007].
#include "dsc/generate/isosurface.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include <dsc/base/error.hpp>

#include "generate/stuff_collapse.hpp"
#include "generate/stuff_cut.hpp"
#include "generate/stuff_smooth.hpp"
#include "generate/stuff_snap.hpp"

namespace dsc::generate {
namespace stuffing {
namespace {

void check_input(const LatticeView& lattice, std::span<const double> values,
                 const StuffOptions& options, std::string_view name) {
    if (!(options.cut_low > 0 && options.cut_low <= options.cut_high && options.cut_high < 1)) {
        throw ConfigError("stuff.options", name, "the cut range is not inside the edges",
                          "use 0 < cut_low <= cut_high < 1");
    }
    if (values.size() != lattice.points.size()) {
        throw GeometryError("stuff.values", name,
                            std::to_string(values.size()) + " values for " +
                                std::to_string(lattice.points.size()) + " points",
                            "give one value per point");
    }
    const Box3 box = bounding_box(lattice.points);
    for (std::size_t v = 0; v < values.size(); ++v) {
        if (!std::isfinite(values[v]) || values[v] == 0) {
            throw GeometryError("stuff.values", name,
                                "the value of vertex " + std::to_string(v) + " is 0 or not finite",
                                "every vertex must be on one side");
        }
        if (values[v] > 0 && lies_on(box, lattice.points[v])) {
            throw GeometryError("stuff.box", name,
                                "vertex " + std::to_string(v) + " on the box is inside",
                                "use a larger box, so that the interface is closed");
        }
    }
}

std::vector<MixedEdge> mixed_edges(const LatticeView& lattice, std::span<const double> values,
                                   const Signs& signs, const StuffOptions& options,
                                   EdgeTable& table) {
    std::vector<MixedEdge> edges;
    for (const Corners& tet : lattice.tets) {
        const int sum = signs[tet[0]] + signs[tet[1]] + signs[tet[2]] + signs[tet[3]];
        if (sum == 4 || sum == -4) continue;
        for (const std::uint32_t plus : tet) {
            if (signs[plus] < 0) continue;
            for (const std::uint32_t minus : tet) {
                if (signs[minus] < 0) table.number(plus, minus, edges);
            }
        }
    }
    for (MixedEdge& edge : edges) {
        const double at_plus = values[edge.plus], at_minus = -values[edge.minus];
        edge.t = std::clamp(at_plus / (at_plus + at_minus), options.cut_low, options.cut_high);
    }
    return edges;
}

}  // namespace
}  // namespace stuffing

mesh::TetMesh stuff_interface(std::span<const Vec3> points,
                              std::span<const std::array<std::uint32_t, 4>> tets,
                              std::span<const double> values, const StuffOptions& options,
                              StuffReport* report, Workers* workers, const CancelToken* cancel,
                              std::string_view name) {
    using namespace stuffing;
    const LatticeView lattice{points, tets};
    StuffReport local;
    StuffReport& out = report != nullptr ? *report : local;
    out = {};
    check_input(lattice, values, options, name);
    Signs signs(values.size());
    for (std::size_t v = 0; v < signs.size(); ++v) signs[v] = values[v] > 0 ? 1 : -1;
    EdgeTable table(lattice.points.size() / 2);
    const std::vector<MixedEdge> edges = mixed_edges(lattice, values, signs, options, table);
    out.mixed_edges = edges.size();
    const std::vector<Snapped> snapped = snap_vertices(lattice, edges, signs, out, cancel);
    Stuffed stuffed = cut_tets(lattice, edges, table, signs);
    out.cut_vertices = stuffed.mesh.points.size() - lattice.points.size();
    if (out.snapped_vertices + out.cut_vertices > options.most_interface_vertices) {
        move_to_targets(stuffed, snapped, options, out);
        collapse_interface(stuffed, options, out, cancel);
        improve_free_vertices(stuffed, workers);
        smooth_interface(stuffed, {}, options, out, cancel);
    } else {
        smooth_interface(stuffed, snapped, options, out, cancel);
    }
    out.least_quality = improve_free_vertices(stuffed, workers);
    out.interface_vertices = out.snapped_vertices + out.cut_vertices - out.collapsed_edges;
    out.interface_faces = stuffed.faces.size();
    return std::move(stuffed.mesh);
}

}  // namespace dsc::generate
