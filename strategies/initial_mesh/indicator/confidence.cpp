#include "confidence.hpp"

#include <algorithm>
#include <string>

#include <dsc/cloud/search.hpp>
#include <dsc/surface/surface_view.hpp>
#include <dsc/text/numbers.hpp>
#include <dsc/text/words.hpp>

namespace dsc::indicator {
namespace {

/// Distance from the nearest sample, in local widths, beyond which the interface closes a gap in
/// the data.
constexpr double gap_widths = 3.0;
/// Least number of certain vertices of a part whose attachment counts.
constexpr std::size_t least_part = 10;

std::size_t changed(const Labels& labels, bool inside) {
    return static_cast<std::size_t>(std::count_if(
        labels.components.begin(), labels.components.end(),
        [&](const generate::LabelComponent& c) { return c.inside == inside && !c.kept; }));
}

std::string in_words(const generate::TopologyCounts& counts) {
    return text::counted(counts.components, "component") + ", " +
           text::counted(counts.cavities, "cavity", "cavities") + ", genus " +
           std::to_string(counts.genus());
}

}  // namespace

bool doubtful(const Labels& labels, const cloud::Orientation& orientation) {
    return labels.weak_share() > most_changed || orientation.residual > retry_residual;
}

StartSurface measure_start(const mesh::TetMesh& mesh, const cloud::Orientation& orientation,
                           double cloud_area) {
    StartSurface out;
    out.cloud_area = cloud_area;
    std::vector<Vec3> places;
    std::vector<double> widths;
    for (const cloud::SurfaceSample& sample : orientation.samples) {
        if (sample.area == Vec3::Zero()) continue;
        places.push_back(sample.position);
        widths.push_back(sample.width);
    }
    const cloud::NearestSearch search(places);
    const surface::TriangleMesh interface = surface::extract_interface(mesh);
    double gaps = 0.0;
    for (const auto& face : interface.faces) {
        const Vec3 &a = interface.points[face[0]], &b = interface.points[face[1]],
                   &c = interface.points[face[2]];
        const double area = 0.5 * (b - a).cross(c - a).norm();
        const cloud::Neighbour near = search.nearest((a + b + c) / 3.0);
        out.area += area;
        if (near.distance > gap_widths * widths[near.index]) gaps += area;
    }
    out.gap_share = out.area > 0.0 ? gaps / out.area : 0.0;
    return out;
}

hooks::Warnings warnings_of(const Labels& labels, const cloud::Orientation& orientation,
                            const StartSurface& start) {
    hooks::Warnings out;
    const double area_ratio = start.cloud_area > 0.0 ? start.area / start.cloud_area : 0.0;
    if (orientation.one_sided()) {
        out.push_back({"cloud.one_sided",
                       "The points lie in one layer, like a scan from one side, so they do not "
                       "bound a volume. The volume is closed by a copy of the surface farther back "
                       "and by walls between the two, where nothing was measured. --trim (in an "
                       "experiment output: {trim: {}}) writes only the measured side."});
    } else if (orientation.residual > open_residual || area_ratio > open_area) {
        out.push_back(
            {"cloud.open",
             "The cloud seems to be open, such as a scan of one side: the closed surface has " +
                 text::fixed(area_ratio, 2) +
                 " times the area of the points, and the winding field has a residual of " +
                 text::fixed(orientation.residual, 3) +
                 ". Where there are no points, the surface is a guess. --trim (in an experiment "
                 "output: {trim: {}}) writes it without these parts."});
    }
    if (labels.changed_share() > most_changed) {
        out.push_back(
            {"topology.doubtful",
             "The topology is doubtful: at " +
                 text::counted(
                     labels.filter.clusters.size() + changed(labels, true) + changed(labels, false),
                     "place", "places") +
                 " (" + text::fixed(100.0 * labels.changed_share(), 1) +
                 " vertices per 100 points) the solid or a gap is thinner than about one spacing "
                 "of the points. Without the topology filter: " +
                 in_words(labels.filter.before) + "; with it: " + in_words(labels.counts) +
                 ". Use a denser cloud to decide these places."});
    } else if (orientation.residual > most_residual) {
        out.push_back(
            {"topology.doubtful", "The topology is doubtful: the winding field has a residual of " +
                                      text::fixed(orientation.residual, 3) +
                                      " at the points, so the normals of some points may point to "
                                      "the wrong side. Use a denser or less noisy cloud."});
    }
    return out;
}

void add_figures(const Labels& labels, const cloud::Orientation& orientation,
                 const StartSurface& start, hooks::Figures& out) {
    const auto add = [&out](const char* figure, double value) { out.emplace_back(figure, value); };
    const auto whole = [&add](const char* figure, std::size_t value) {
        add(figure, static_cast<double>(value));
    };
    whole("samples", labels.samples);
    add("residual", orientation.residual);
    add("noise_to_width", labels.width > 0.0 ? orientation.noise / labels.width : 0.0);
    whole("lattice_vertices", labels.lattice.points.size());
    whole("lattice_tets", labels.lattice.tets.size());
    whole("split_rounds", labels.rounds);
    whole("refused_vertices", labels.filter.refused);
    whole("settled_vertices", labels.settled());
    add("changed_share", labels.changed_share());
    whole("refused_places", labels.filter.clusters.size());
    whole("confirmed_places", labels.filter.confirmed.size());
    whole("components_before_filter", labels.filter.before.components);
    whole("cavities_before_filter", labels.filter.before.cavities);
    add("genus_before_filter", static_cast<double>(labels.filter.before.genus()));
    whole("components", labels.counts.components);
    whole("cavities", labels.counts.cavities);
    add("genus", static_cast<double>(labels.counts.genus()));
    whole("islands_removed", changed(labels, true));
    whole("cavities_filled", changed(labels, false));
    // Parts that are connected by certain values have no weakest attachment: 1/2 is the largest
    // possible value.
    const auto inside = generate::weakest_attachment(labels.filter, true, least_part),
               outside = generate::weakest_attachment(labels.filter, false, least_part);
    add("weakest_bridge", inside ? inside->level : 0.5);
    add("weakest_gap", outside ? outside->level : 0.5);
    add("area_ratio", start.cloud_area > 0.0 ? start.area / start.cloud_area : 0.0);
    add("gap_share", start.gap_share);
}

}  // namespace dsc::indicator
