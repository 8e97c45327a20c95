// The examples of share/doc/contexts.md, which share/contexts.py copies from here: one per context,
// between the lines "// example: NAME" and "// end". Each uses every member of its context.
#include <algorithm>
#include <cmath>
#include <map>

#include <doctest/doctest.h>

#include <dsc/generate/shape_mesh.hpp>
#include <dsc/hooks/cloud_filter.hpp>
#include <dsc/hooks/initial_mesh.hpp>
#include <dsc/hooks/observer.hpp>
#include <dsc/hooks/refinement_policy.hpp>
#include <dsc/hooks/support.hpp>
#include <dsc/mesh/adopt.hpp>
#include <dsc/mesh/volume_view.hpp>
#include <dsc/sdk/steps.hpp>

using namespace dsc;

// example: StepContext
/// Half of the way to the nearest point where the cloud supports the surface, elsewhere a small
/// random motion; both become smaller towards the end of the run.
std::vector<Vec3> displacements(const hooks::StepContext& context) {
    const surface::SurfaceView& view = context.surface;
    std::vector<Vec3> out(view.vertex_count(), Vec3::Zero());
    if (context.cloud == nullptr) return out;
    const double done = context.planned_steps > 0 ? static_cast<double>(context.step) /
                                                        static_cast<double>(context.planned_steps)
                                                  : 0.0;
    // needs_support() returns true; on a surface without faces the span is empty.
    const bool known = !context.support.empty();
    for_blocks(context.workers, out.size(), 256, [&](std::size_t begin, std::size_t end) {
        if (context.cancelled()) return;
        for (std::size_t v = begin; v < end; ++v) {
            const double longest = (1.0 - done) * context.target_length_at(v);
            const cloud::Neighbour near = context.nearest_point(v);
            Vec3 way = 0.5 * ((*context.cloud)[near.index] - view.positions[v]);
            if (known && context.support[v] < 0.5) {
                RandomStream random = context.random(view.births[v]);
                way = random.uniform(-0.1, 0.1) * longest * view.normals[v];
            }
            if (way.norm() > longest) way *= longest / way.norm();
            const Vec3 place = view.positions[v] + way;
            out[v] = place.cwiseMax(context.box.low).cwiseMin(context.box.high) - view.positions[v];
        }
    });
    return out;
}

/// The volume inside and the largest distance of a point from the surface, in the units of the
/// input, for an observer.
hooks::Figures sizes(const hooks::StepContext& context) {
    const double scale = context.to_normalised.scale;
    double inside = 0.0, largest = 0.0;
    for (const mesh::TetId t : context.volume->tets())
        inside += context.volume->label(t) > 0 ? context.volume->volume(t) : 0.0;
    // needs_faces_of_points() returns true.
    for (const surface::FacePoint& place : context.faces_of_points)
        largest = std::max(largest, place.distance);
    hooks::Figures figures = {{"volume", inside / (scale * scale * scale)},
                              {"largest_distance", largest / scale},
                              {"wanted_edge", context.target_length / scale}};
    for (const hooks::Attribute& attribute : context.attributes) {
        if (attribute.name == "residual" && !attribute.values.empty())
            figures.emplace_back(
                "largest_residual",
                *std::max_element(attribute.values.begin(), attribute.values.end()) / scale);
    }
    return figures;
}

/// nearest, target_lengths, seed, instance and cancel are behind the calls used above.
bool is_plain(const hooks::StepContext& context) {
    return context.nearest.size() == context.surface.vertex_count() &&
           context.target_lengths.empty() && context.seed == 1 && context.instance == 0 &&
           context.cancel == nullptr;
}
// end

// example: SurfaceView
/// Area of the interface between each pair of labels, in squared normalised units.
std::map<std::pair<mesh::Label, mesh::Label>, double> areas(const surface::SurfaceView& view) {
    std::map<std::pair<mesh::Label, mesh::Label>, double> sums;
    for (std::size_t f = 0; f < view.face_count(); ++f)
        sums[{view.face_labels[f][0], view.face_labels[f][1]}] += view.face_areas[f];
    return sums;
}

/// Momentum and smoothing: part of the last motion, and part of the way to the middles of the
/// faces round the vertex; less for a vertex that did not arrive, none for a young one.
Vec3 momentum(const surface::SurfaceView& view, std::size_t vertex) {
    if (view.movable[vertex] == 0) return Vec3::Zero();
    Vec3 middle = Vec3::Zero();
    for (const std::uint32_t f : view.faces_of(vertex)) {
        const auto [p, q, r] = view.corners_from(vertex, f);
        middle += (p + q + r) / 3.0;
    }
    middle /= static_cast<double>(view.faces_of(vertex).size());
    const Vec3 motion = view.positions[vertex] - view.previous_positions[vertex];
    const double kept = view.age[vertex] == 0 ? 0.0 : view.arrived[vertex] == 1 ? 0.8 : 0.4;
    return kept * motion + 0.2 * (middle - view.positions[vertex]);
}

/// How the arrays belong together.
bool is_consistent(const surface::SurfaceView& view) {
    bool good = view.mean_edge > 0.0 && view.normals.size() == view.vertex_count() &&
                view.vertex_ids.size() == view.vertex_count() &&
                view.face_tets.size() == view.face_count() &&
                std::is_sorted(view.births.begin(), view.births.end());
    for (std::size_t v = 0; v < view.vertex_count(); ++v) {
        for (std::uint32_t i = view.face_offsets[v]; i < view.face_offsets[v + 1]; ++i) {
            const std::uint32_t f = view.vertex_faces[i];
            // At a smooth place the normal of a vertex and those of its faces agree.
            good = good && view.normals[v].dot(view.face_normals[f]) > 0.0;
        }
    }
    return good;
}
// end

// example: VolumeView
/// Number and least quality of the tets of each label, and the area over which a label touches
/// others. Tables by id have the size of the bound.
struct LabelFigures {
    std::size_t tets = 0;
    double volume = 0.0, least_quality = 1.0, area = 0.0;
};
std::map<mesh::Label, LabelFigures> by_label(const mesh::VolumeView& volume) {
    std::map<mesh::Label, LabelFigures> all;
    for (const mesh::TetId t : volume.tets()) {
        LabelFigures& label = all[volume.label(t)];
        ++label.tets;
        label.volume += volume.volume(t);
        label.least_quality = std::min(label.least_quality, volume.quality(t));
        for (unsigned f = 0; f < 4; ++f) {
            if (!volume.interface_face(t, f)) continue;
            const auto v = volume.vertices_of(t);
            const auto& corner = mesh::face_vertices[f];
            const Vec3 &p = volume.position(v[corner[0]]), &q = volume.position(v[corner[1]]),
                       &r = volume.position(v[corner[2]]);
            label.area += 0.5 * (q - p).cross(r - p).norm();
        }
    }
    return all;
}

/// The tets of label 1 that have a neighbour with label 0 and lie above z: (tet id, label 0), for
/// RefinementRequests::relabel.
std::vector<std::array<std::uint32_t, 2>> peel(const mesh::VolumeView& volume, double z) {
    std::vector<std::array<std::uint32_t, 2>> requests;
    std::vector<char> taken(volume.tet_id_bound(), 0);
    for (const mesh::TetId t : volume.tets()) {
        if (volume.label(t) != 1 || volume.touches_box(t) || volume.centroid(t).z() < z) continue;
        for (unsigned f = 0; f < 4 && taken[t] == 0; ++f) {
            if (volume.neighbour(t, f) == mesh::none || volume.label_across(t, f) != 0) continue;
            requests.push_back({t, 0});
            taken[t] = 1;
        }
    }
    return requests;
}

/// The oldest vertex of the interface inside the box, and the number of tets round it.
std::pair<std::uint32_t, std::size_t> oldest(const mesh::VolumeView& volume) {
    mesh::VertexId found = mesh::none;
    for (const mesh::VertexId v : volume.vertices()) {
        if (volume.on_box(v) || !volume.on_interface(v)) continue;
        if (found == mesh::none || volume.birth(v) < volume.birth(found)) found = v;
    }
    if (found == mesh::none) return {0, 0};
    std::vector<mesh::TetId> round;
    mesh::TetIndex places;
    volume.tets_round(found, round, places);
    return {volume.birth(found), round.size()};
}

/// Whether the counts are those of the loops.
bool counts_agree(const mesh::VolumeView& volume) {
    std::size_t tets = 0, vertices = 0;
    for (const mesh::TetId t : volume.tets()) tets += t < volume.tet_id_bound() ? 1 : 0;
    for (const mesh::VertexId v : volume.vertices())
        vertices += v < volume.vertex_id_bound() ? 1 : 0;
    return tets == volume.tet_count() && vertices == volume.vertex_count();
}
// end

// example: TargetCloud
/// The mean of the points within two spacings of the point nearest to a place, weighted with
/// the confidence of their normals if there are any.
Vec3 local_mean(const cloud::TargetCloud& cloud, const Vec3& place) {
    const cloud::Neighbour nearest = cloud.search().nearest(place);
    std::vector<cloud::Neighbour> near;
    cloud.search().neighbours_within(cloud[nearest.index], 2.0 * cloud.point_width(nearest.index),
                                     near);
    Vec3 sum = Vec3::Zero();
    double weights = 0.0;
    for (const cloud::Neighbour& n : near) {
        const double weight = cloud.confidence().empty() ? 1.0 : cloud.confidence()[n.index];
        sum += weight * cloud.points()[n.index];
        weights += weight;
    }
    return weights > 0.0 ? Vec3(sum / weights) : cloud[nearest.index];
}

/// What the cloud tells about itself, in the units of the input.
hooks::Figures described(const cloud::TargetCloud& cloud) {
    const double scale = cloud.transform().scale;
    double widest = 0.0;
    for (std::size_t i = 0; i < cloud.size(); ++i)
        widest = std::max(widest, cloud.neighbour_distance(i));
    return {{"points", static_cast<double>(cloud.size())},
            {"noise", cloud.noise() / scale},
            {"median_width", cloud.statistics().width / scale},
            {"label_width_of_point_0", cloud.label_width(0) / scale},
            {"largest_neighbour_distance", widest / scale},
            {"diagonal", cloud.box().diagonal() / scale},
            {"has_colours", cloud.colours().empty() ? 0.0 : 1.0},
            {"has_normals", cloud.normals().empty() || cloud.areas().empty() ? 0.0 : 1.0},
            {"is_oriented", cloud.orientation().empty() ? 0.0 : 1.0}};
}
// end

// example: RefinementContext
/// Splits the faces whose centroids move faster than a bound, in at most two passes.
void split_fast_faces(const hooks::RefinementContext& context, double bound,
                      hooks::RefinementRequests& out) {
    const surface::SurfaceView& view = context.step.surface;
    if (context.velocity == nullptr || context.pass > 1) return;  // needs_sampling() returns true
    std::vector<Vec3> centroids(view.face_count()), ways(view.face_count());
    for (std::size_t f = 0; f < centroids.size(); ++f) {
        const auto& [a, b, c] = view.faces[f];
        centroids[f] = (view.positions[a] + view.positions[b] + view.positions[c]) / 3.0;
    }
    context.velocity->sample(centroids, view.face_normals, ways);
    for (std::uint32_t f = 0; f < ways.size(); ++f) {
        if (ways[f].norm() > bound) out.split_faces.push_back(f);
    }
}
// end

// example: InitialMeshContext
/// The cells along an edge of the box so that a cell is about two spacings wide, with a random
/// change of at most one.
int cells_for(const hooks::InitialMeshContext& context) {
    if (context.cancel != nullptr && context.cancel->cancelled()) return 1;
    double width = 0.1;
    if (context.cloud != nullptr) width = context.cloud->statistics(context.workers).width;
    RandomStream random(RandomKey{context.seed, context.instance, 0, 0});
    return static_cast<int>(3.0 / (2.0 * width)) + static_cast<int>(random.index(2));
}

/// A surface that a parameter names.
surface::TriangleMesh named_surface(const hooks::InitialMeshContext& context,
                                    const std::string& file) {
    return context.files != nullptr ? context.files->read_surface(file) : surface::TriangleMesh{};
}
// end

// example: FilterContext
/// Keeps each point with a probability, by the random stream of its index.
cloud::Filtered thin_out(const cloud::Cloud& cloud, const hooks::FilterContext& context,
                         double probability) {
    std::vector<char> keep(cloud.points.size(), 1);
    for_blocks(context.workers, keep.size(), 1024, [&](std::size_t begin, std::size_t end) {
        if (context.cancel != nullptr && context.cancel->cancelled()) return;
        for (std::size_t i = begin; i < end; ++i) {
            RandomStream random(RandomKey{context.seed, context.instance, 0, i});
            keep[i] = random.uniform(0, 1) < probability ? 1 : 0;
        }
    });
    std::vector<std::size_t> kept;
    for (std::size_t i = 0; i < keep.size(); ++i) {
        if (keep[i] != 0 || i == 0) kept.push_back(i);  // at least one point is left
    }
    cloud::Filtered result{cloud::pick(cloud, kept), {}};
    result.report.kept = kept.size();
    result.report.removed = cloud.points.size() - kept.size();
    return result;
}
// end

// example: StepFigures
/// Figures relative to the size of the mesh.
hooks::Figures relative(const hooks::StepFigures& figures) {
    return {{"volume_per_tet", figures.volume / static_cast<double>(figures.tets)},
            {"interface_share",
             static_cast<double>(figures.interface_vertices) / static_cast<double>(figures.tets)},
            {"worst_tet", figures.min_tet_quality},
            {"hundreds_of_steps", 0.01 * static_cast<double>(figures.step)}};
}
// end

namespace {

/// A ball of radius 0.8 in the box, and points of its surface.
struct Ball {
    Ball()
        : complex(mesh::adopt(generate::make_shape_mesh({.cells = 14}, shapes(), "ball"), "ball")) {
        surface::build_view(complex, view);
        cloud::Normalized normalized;
        for (int i = 0; i < 4000; ++i) {
            const double z = 1.0 - (2.0 * i + 1.0) / 4000.0, r = std::sqrt(1.0 - z * z);
            normalized.points.emplace_back(0.8 * r * std::cos(2.399963 * i),
                                           0.8 * r * std::sin(2.399963 * i), 0.8 * z);
        }
        cloud.emplace(normalized);
        surface::nearest_faces(view, cloud->points(), faces);
        hooks::measure_support(view, *cloud, faces, support);
        volume.emplace(complex);
    }
    static std::vector<generate::Shape> shapes() {
        generate::Shape ball;
        ball.radius = 0.8;
        return {ball};
    }
    hooks::StepContext context() const {
        hooks::StepContext context = sdk::step_context(view);
        context.cloud = &*cloud;
        context.faces_of_points = faces;
        context.support = support;
        context.volume = &*volume;
        context.planned_steps = 10;
        return context;
    }
    mesh::Complex complex;
    surface::SurfaceView view;
    std::optional<cloud::TargetCloud> cloud;
    std::optional<mesh::VolumeView> volume;
    std::vector<surface::FacePoint> faces;
    std::vector<double> support;
};

double value(const hooks::Figures& figures, const std::string& name) {
    for (const auto& [figure, number] : figures) {
        if (figure == name) return number;
    }
    return NAN;
}

constexpr double pi = 3.14159265358979323846;

}  // namespace

TEST_CASE("the examples of the page on contexts do what they say") {
    const Ball ball;
    const hooks::StepContext context = ball.context();
    const std::vector<Vec3> ways = displacements(context);
    for (const Vec3& way : ways) CHECK(way.norm() <= context.target_length);
    CHECK(std::count_if(ways.begin(), ways.end(), [](const Vec3& w) { return w.norm() > 0; }) >
          100);
    const double exact = 4.0 / 3.0 * pi * 0.512;
    CHECK(value(sizes(context), "volume") == doctest::Approx(exact).epsilon(0.05));
    CHECK(value(sizes(context), "largest_distance") < 0.1);
    CHECK_FALSE(is_plain(context));

    CHECK(areas(ball.view).at({0, 1}) == doctest::Approx(4 * pi * 0.64).epsilon(0.1));
    for (std::size_t v = 0; v < 20; ++v)
        CHECK(momentum(ball.view, v).norm() < context.target_length);
    CHECK(is_consistent(ball.view));

    const auto labels = by_label(*ball.volume);
    CHECK(labels.at(0).volume + labels.at(1).volume == doctest::Approx(27.0));
    CHECK(labels.at(1).area == doctest::Approx(areas(ball.view).at({0, 1})));
    CHECK(labels.at(0).area == doctest::Approx(labels.at(1).area));
    const auto peeled = peel(*ball.volume, 0.4);
    CHECK_FALSE(peeled.empty());
    for (const auto& [tet, label] : peeled) CHECK(ball.volume->centroid(tet).z() >= 0.4);
    CHECK(oldest(*ball.volume).first == ball.view.births[0]);
    CHECK(oldest(*ball.volume).second > 3);
    CHECK(counts_agree(*ball.volume));

    CHECK((local_mean(*ball.cloud, Vec3(0.9, 0, 0)) - Vec3(0.8, 0, 0)).norm() < 0.05);
    CHECK(value(described(*ball.cloud), "points") == 4000);
    hooks::RefinementRequests requests;
    split_fast_faces({context, nullptr, 0}, 0.1, requests);
    CHECK(requests.split_faces.empty());
    hooks::InitialMeshContext of_mesh;
    of_mesh.cloud = &*ball.cloud;
    CHECK(cells_for(of_mesh) > 10);
    CHECK(named_surface(of_mesh, "missing.obj").faces.empty());
    cloud::Cloud points;
    points.points.assign(ball.cloud->points().begin(), ball.cloud->points().end());
    const double left = static_cast<double>(thin_out(points, {}, 0.3).cloud.points.size());
    CHECK(left == doctest::Approx(1200).epsilon(0.1));
    CHECK(value(relative({.step = 1,
                          .interface_vertices = 5,
                          .tets = 10,
                          .volume = 2.0,
                          .min_tet_quality = 0.1}),
                "volume_per_tet") == doctest::Approx(0.2));
}
