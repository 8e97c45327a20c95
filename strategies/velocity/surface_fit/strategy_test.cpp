// Tests of the velocity on surfaces beside known clouds; the plugin is loaded as in a run.
#include <cmath>
#include <numbers>
#include <sstream>

#include <doctest/doctest.h>

#include <dsc/base/error.hpp>
#include <dsc/base/random.hpp>
#include <dsc/host/host.hpp>
#include <dsc/sdk/steps.hpp>
#include <dsc/sdk/surfaces.hpp>

namespace {

using dsc::Vec3;
using dsc::cloud::TargetCloud;
using dsc::config::ConfigNode;
using dsc::surface::SurfaceView;
using dsc::surface::TriangleMesh;

struct Bench {
    Bench() { host.load(DSC_TEST_PLUGIN); }
    std::unique_ptr<dsc::hooks::VelocityField> make(
        const ConfigNode& params = ConfigNode::map()) const {
        return host.create<dsc::hooks::VelocityField>({"surface_fit", params}, "velocity");
    }
    dsc::host::Host host;
};

TargetCloud cloud_of(std::vector<Vec3> points) { return TargetCloud({std::move(points), {}}); }

std::vector<Vec3> step(dsc::hooks::VelocityField& field, const SurfaceView& view,
                       const TargetCloud& cloud, std::uint64_t number) {
    dsc::hooks::StepContext context = dsc::sdk::step_context(view, number);
    context.cloud = &cloud;
    return dsc::sdk::displacements(field, context);
}

/// Runs this number of steps without a kernel, from step `first` on.
void deform(dsc::hooks::VelocityField& field, TriangleMesh& mesh, const TargetCloud& cloud,
            std::uint64_t first, std::uint64_t steps) {
    for (std::uint64_t i = 0; i < steps; ++i) {
        const std::vector<Vec3> out = step(field, dsc::sdk::view_of(mesh), cloud, first + i);
        for (std::size_t v = 0; v < out.size(); ++v) mesh.points[v] += out[v];
    }
}

/// Points of a ball, evenly spread over its area.
std::vector<Vec3> ball_points(std::size_t count, double radius) {
    std::vector<Vec3> points;
    for (std::size_t i = 0; i < count; ++i) {
        const double z = 1.0 - (2.0 * static_cast<double>(i) + 1.0) / static_cast<double>(count);
        const double flat = std::sqrt(1.0 - z * z),
                     turn = std::numbers::pi * (3.0 - std::sqrt(5.0)) * static_cast<double>(i);
        points.push_back(radius * Vec3(flat * std::cos(turn), flat * std::sin(turn), z));
    }
    return points;
}

TriangleMesh rough_ball(unsigned level, double radius, double roughness) {
    dsc::RandomStream random(dsc::RandomKey{2, 1, 0, 0});
    return dsc::sdk::moved(dsc::sdk::icosphere(level, radius), [&](const Vec3& p) {
        return Vec3(p + roughness * Vec3(random.uniform() - 0.5, random.uniform() - 0.5,
                                         random.uniform() - 0.5));
    });
}

/// Points of the cube [-half, half]^3, in a lattice that leaves out its edges.
std::vector<Vec3> cube_points(int n, double half) {
    std::vector<Vec3> points;
    for (int axis = 0; axis < 3; ++axis) {
        for (const double side : {-half, half}) {
            for (int i = 0; i < n; ++i) {
                for (int j = 0; j < n; ++j) {
                    Vec3 p;
                    p[axis] = side;
                    p[(axis + 1) % 3] = half * ((2.0 * i + 1.0) / n - 1.0);
                    p[(axis + 2) % 3] = half * ((2.0 * j + 1.0) / n - 1.0);
                    points.push_back(p);
                }
            }
        }
    }
    return points;
}

double distance_to_cube(const Vec3& p, double half) {
    const Vec3 out = p.cwiseAbs() - Vec3::Constant(half);
    const double inside = std::min(out.maxCoeff(), 0.0);
    return std::abs(out.cwiseMax(0.0).norm() + inside);
}

}  // namespace

TEST_CASE("a plane of points is reproduced, slope and all") {
    const Bench bench;
    const Vec3 normal = Vec3(0.05, -0.03, 1).normalized();
    std::vector<Vec3> points;
    for (double x = -1; x <= 1; x += 0.05) {
        for (double y = -1; y <= 1; y += 0.05)
            points.emplace_back(x, y, 0.02 - (normal.x() * x + normal.y() * y) / normal.z());
    }
    const TargetCloud cloud = cloud_of(points);
    TriangleMesh mesh = dsc::sdk::square(10, 0.8);
    const auto field = bench.make();
    deform(*field, mesh, cloud, 1, 5);
    for (const Vec3& p : mesh.points) CHECK(std::abs(normal.dot(p - Vec3(0, 0, 0.02))) < 5e-5);
}

TEST_CASE("a rough ball settles on the ball of its points, from inside and from outside") {
    const Bench bench;
    const TargetCloud cloud = cloud_of(ball_points(4000, 0.9));
    for (const double radius : {0.86, 0.94}) {
        TriangleMesh mesh = rough_ball(4, radius, 0.03);
        const auto field = bench.make();
        deform(*field, mesh, cloud, 1, 14);
        const SurfaceView view = dsc::sdk::view_of(mesh);
        std::vector<dsc::surface::FacePoint> places;
        dsc::surface::nearest_faces(view, cloud.points(), places);
        double sum = 0.0;
        for (const auto& place : places) sum += place.distance;
        CHECK(sum / 4000 < 5e-4);  // a face of this size lies 2e-3 below the ball on which its
                                   // corners lie
        CHECK(field->finished());
    }
}

TEST_CASE("the edges of a cube become sharp, and only with hinges that resist less when sharp") {
    const Bench bench;
    const double half = 0.6;
    const TargetCloud cloud = cloud_of(cube_points(24, half));
    const auto mean_error = [&](double crease_angle) {
        TriangleMesh mesh = dsc::sdk::moved(dsc::sdk::icosphere(4, 1.0), [&](const Vec3& p) {
            // A cube with edges rounded like a ball of radius 0.2.
            const Vec3 core = (p / p.cwiseAbs().maxCoeff()) * (half - 0.2);
            return Vec3(core + 0.2 * p);
        });
        const auto field = bench.make(ConfigNode::map({{"crease_angle", crease_angle}}));
        deform(*field, mesh, cloud, 1, 14);
        const SurfaceView view = dsc::sdk::view_of(mesh);
        double sum = 0.0, area = 0.0;
        for (std::size_t f = 0; f < view.face_count(); ++f) {
            const auto& [a, b, c] = view.faces[f];
            const Vec3 middle = (view.positions[a] + view.positions[b] + view.positions[c]) / 3.0;
            sum += view.face_areas[f] * distance_to_cube(middle, half);
            area += view.face_areas[f];
        }
        return sum / area;
    };
    const double kept = mean_error(0.3);
    CHECK(kept < 0.1 * 2 * half / 24);  // a tenth of the distance between the points
    CHECK(kept < 0.8 * mean_error(100.0));
}

TEST_CASE("moved and turned, surface and cloud give the displacements moved and turned") {
    const Bench bench;
    const TriangleMesh mesh = rough_ball(3, 0.85, 0.05);
    const auto points = ball_points(1500, 0.9);
    const Eigen::AngleAxisd turn(1.1, Vec3(1, 2, -1).normalized());
    const auto move = [&](const Vec3& p) { return Vec3(turn * p + Vec3(0.1, -0.2, 0.05)); };
    std::vector<Vec3> there;
    for (const Vec3& p : points) there.push_back(move(p));
    const TargetCloud cloud = cloud_of(points), moved_cloud = cloud_of(there);
    const auto field = bench.make(), moved_field = bench.make();
    const auto out = step(*field, dsc::sdk::view_of(mesh), cloud, 1);
    const auto moved_out =
        step(*moved_field, dsc::sdk::view_of(dsc::sdk::moved(mesh, move)), moved_cloud, 1);
    for (std::size_t v = 0; v < out.size(); ++v)
        CHECK((turn * out[v] - moved_out[v]).norm() < 1e-9);
}

TEST_CASE("the displacements have the same bits with any number of threads") {
    const Bench bench;
    const SurfaceView view = dsc::sdk::view_of(rough_ball(5, 0.85, 0.02));
    auto points = ball_points(9000, 0.9);
    for (Vec3& p : points) p.z() *= 0.8;
    const TargetCloud cloud = cloud_of(points);
    const auto answers = [&](dsc::Workers* workers) {
        const auto field = bench.make(ConfigNode::map({{"noise", 0.4}}));
        dsc::hooks::StepContext context = dsc::sdk::step_context(view);
        context.cloud = &cloud;
        context.workers = workers;
        auto out = dsc::sdk::displacements(*field, context);
        dsc::hooks::Attributes attributes;
        field->publish(attributes);
        for (const auto& a : attributes) {
            for (const double value : a.values) out.emplace_back(value, 0, 0);
        }
        return out;
    };
    const auto alone = answers(nullptr);
    for (const unsigned threads : {1U, 2U, 3U}) {
        dsc::Workers workers(threads);
        CHECK(answers(&workers) == alone);
    }
}

TEST_CASE("after saving and reading, the fit continues where it was") {
    const Bench bench;
    const TargetCloud cloud = cloud_of(ball_points(800, 0.9));
    TriangleMesh mesh = rough_ball(3, 0.86, 0.03);
    const auto field = bench.make();
    deform(*field, mesh, cloud, 5, 9);
    std::stringstream state;
    field->save(state);
    const auto resumed = bench.make();
    resumed->load(state);
    CHECK(resumed->planned_steps() == field->planned_steps());
    CHECK(resumed->keep_creases().has_value());
    TriangleMesh other = mesh;
    deform(*field, mesh, cloud, 14, 3);
    deform(*resumed, other, cloud, 14, 3);
    CHECK(other.points == mesh.points);
    std::istringstream damaged("abc");
    CHECK_THROWS_AS(resumed->load(damaged), dsc::IoError);
}

TEST_CASE("the number of steps is fixed in the first: 14, 24 with holes, or as set") {
    const Bench bench;
    const auto all = ball_points(2000, 0.9);
    std::vector<Vec3> holed;
    for (const Vec3& p : all) {
        if (p.z() < 0.6) holed.push_back(p);
    }
    const auto planned = [&](const std::vector<Vec3>& points, std::uint64_t iterations) {
        const TargetCloud cloud = cloud_of(points);
        const auto field =
            bench.make(ConfigNode::map({{"iterations", static_cast<int>(iterations)}}));
        CHECK(field->planned_steps() == iterations);
        step(*field, dsc::sdk::view_of(dsc::sdk::icosphere(3, 0.9)), cloud, 3);
        CHECK_FALSE(field->finished());
        return field->planned_steps();
    };
    CHECK(planned(all, 0) == 16);
    CHECK(planned(holed, 0) == 26);
    CHECK(planned(holed, 5) == 7);
    const TargetCloud cloud = cloud_of(all);
    TriangleMesh mesh = dsc::sdk::icosphere(3, 0.9);
    const auto field = bench.make(ConfigNode::map({{"iterations", 3}}));
    CHECK_FALSE(field->keep_creases());
    deform(*field, mesh, cloud, 1, 2);
    CHECK(field->keep_creases());
    CHECK_FALSE(field->finished());
    deform(*field, mesh, cloud, 3, 1);
    CHECK(field->finished());
}

TEST_CASE("a hole is filled with the surface round it, beyond the usual length of a step") {
    const Bench bench;
    std::vector<Vec3> points;
    for (const Vec3& p : ball_points(3000, 0.9)) {
        if (p.z() < 0.78) points.push_back(p);
    }
    const TargetCloud cloud = cloud_of(points);
    // The top of the ball is moved down by more than it rose.
    const TriangleMesh start = dsc::sdk::moved(dsc::sdk::icosphere(4, 0.9), [](const Vec3& p) {
        return Vec3(p.x(), p.y(), p.z() < 0.85 ? p.z() : 0.85 - 2 * (p.z() - 0.85));
    });
    const auto worst_after = [&](bool filled) {
        TriangleMesh mesh = start;
        const auto field =
            // the first step is the one
            bench.make(ConfigNode::map({{"iterations", 1}, {"fill_holes", filled}}));
        deform(*field, mesh, cloud, 1, 1);
        double largest = 0.0;
        for (const Vec3& p : mesh.points) largest = std::max(largest, std::abs(p.norm() - 0.9));
        return largest;
    };
    CHECK(worst_after(false) > 0.1);  // of 0.15
    CHECK(worst_after(true) < 0.02);
}

TEST_CASE("vertices that cannot move stay, others move at most 0.7 target lengths") {
    const Bench bench;
    const TargetCloud cloud = cloud_of(ball_points(2000, 0.9));
    SurfaceView view = dsc::sdk::view_of(dsc::sdk::icosphere(3, 0.8));
    view.movable[11] = 0;
    const auto field = bench.make();
    dsc::hooks::StepContext context = dsc::sdk::step_context(view);
    context.cloud = &cloud;
    std::vector<double> lengths(view.vertex_count(), 0.1);
    lengths[5] = 0.02;
    context.target_lengths = lengths;
    const auto out = dsc::sdk::displacements(*field, context);
    CHECK(out[11] == Vec3::Zero());
    CHECK(out[5].norm() == doctest::Approx(0.7 * 0.02));
    for (std::size_t v = 0; v < out.size(); ++v)
        CHECK(out[v].norm() < 0.7 * lengths[v] * (1 + 1e-12));
    dsc::hooks::Attributes attributes;
    field->publish(attributes);
    REQUIRE(attributes.size() == 3);
    CHECK(attributes[0].name == "support");
    CHECK(attributes[1].name == "gap");
    CHECK(attributes[2].name == "residual");
    const auto near = cloud.search().nearest(view.positions[5]);
    CHECK(attributes[1].values[5] == near.distance / cloud.point_width(near.index));
}

TEST_CASE("the host need not provide the nearest faces, an empty surface has no displacements, and "
          "a cloud is needed") {
    const Bench bench;
    const TargetCloud cloud = cloud_of(ball_points(500, 0.9));
    const SurfaceView view = dsc::sdk::view_of(dsc::sdk::icosphere(2, 0.85));
    const auto expected = step(*bench.make(), view, cloud, 1);
    const auto field = bench.make();
    dsc::hooks::StepContext context = dsc::sdk::step_context(view);
    context.cloud = &cloud;
    field->prepare(context);  // without advance(): nothing is counted
    std::vector<Vec3> out(view.vertex_count());
    field->evaluate({0, out.size()}, out);
    CHECK(out == expected);
    CHECK(field->planned_steps() == 0);
    CHECK(step(*field, dsc::sdk::view_of({}), cloud, 1).empty());
    CHECK_THROWS_WITH_AS(
        bench.make()->advance(dsc::sdk::step_context(view)),
        "velocity 'surface_fit': the experiment has no cloud; add input: {cloud: {file: ...}}",
        dsc::ConfigError);
}
