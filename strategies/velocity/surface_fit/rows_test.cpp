#include <cmath>
#include <numbers>

#include <doctest/doctest.h>

#include <dsc/base/random.hpp>
#include <dsc/sdk/steps.hpp>
#include <dsc/sdk/surfaces.hpp>

#include "bending_rows.hpp"
#include "data_rows.hpp"
#include "filtered_normals.hpp"
#include "holds.hpp"
#include "local_widths.hpp"
#include "mean_curvature.hpp"
#include "solver.hpp"
#include "support.hpp"

using dsc::Vec3;
using dsc::surface::SurfaceView;
using namespace dsc::strategies::fit;

namespace {

/// Two triangles that meet at this angle, above 0 if convex; the hinge lies anywhere.
SurfaceView hinge_view(double angle, const Vec3& corner, const Vec3& other) {
    dsc::surface::TriangleMesh mesh;
    const Eigen::AngleAxisd fold(angle, Vec3::UnitX());
    mesh.points = {Vec3::Zero(), Vec3(1, 0, 0), corner, fold * other};
    mesh.faces = {{0, 1, 2}, {1, 0, 3}};
    const Eigen::AngleAxisd turn(0.9, Vec3(3, -1, 2).normalized());
    return dsc::sdk::view_of(dsc::sdk::moved(
        mesh, [&](const Vec3& p) { return Vec3(turn * p + Vec3(0.3, 0.2, -0.7)); }));
}

struct Bending {
    explicit Bending(const SurfaceView& view, std::span<const Vec3> normals, double length = 1.0,
                     double width = 1.0) {
        build_links(view, links);
        system.rows.resize(links.hinges.size());
        system.wanted.resize(links.hinges.size());
        const std::vector<double> widths(view.vertex_count(), width);
        bending_rows({view, links.hinges, normals, widths, length, 0.3}, 0, system, nullptr);
    }
    double applied(const Row& row, const std::vector<Vec3>& u) const {
        Vec3 sum = Vec3::Zero();
        for (std::size_t k = 0; k < 4; ++k) sum += row.factor[k] * u[row.vertex[k]];
        return row.direction.dot(sum);
    }
    SurfaceLinks links;
    RowSystem system;
};

/// A tube of rings of n quadrilaterals, each of two triangles, open at both ends.
dsc::surface::TriangleMesh tube(unsigned n, unsigned rows, double radius) {
    dsc::surface::TriangleMesh mesh;
    const double step = 2 * std::numbers::pi / n;
    for (unsigned j = 0; j <= rows; ++j) {
        for (unsigned i = 0; i < n; ++i)
            mesh.points.emplace_back(radius * std::cos(step * i), radius * std::sin(step * i),
                                     step * radius * j);
    }
    for (unsigned j = 0; j < rows; ++j) {
        for (unsigned i = 0; i < n; ++i) {
            const unsigned a = j * n + i, b = j * n + (i + 1) % n, c = b + n, d = a + n;
            mesh.faces.push_back({a, b, c});
            mesh.faces.push_back({a, c, d});
        }
    }
    return mesh;
}

/// Mean change of the distance to the axis by bending alone, over vertices that are not on a rim.
double mean_shrinkage(const dsc::surface::TriangleMesh& mesh, bool filtered, bool round) {
    const SurfaceView view = dsc::sdk::view_of(mesh);
    const std::vector<double> lengths(view.vertex_count(), view.mean_edge);
    std::vector<Vec3> normals(view.face_count(), Vec3(0, 0, 1));  // all alike: flat
    if (filtered) filter_normals(view, 1, 0.35, lengths, nullptr, normals);
    Bending bending(view, normals, 1.0, view.mean_edge);
    measure_holds(view, lengths, 0.02, 1e-3, nullptr, bending.system.holds);
    gather_rows(bending.system, view.movable);
    Solver solver;
    std::vector<Vec3> u;
    solver.solve(bending.system, {}, nullptr, u);
    double sum = 0.0;
    std::size_t count = 0;
    for (std::size_t v = 0; v < u.size(); ++v) {
        const bool rim = !round && (view.positions[v].z() < 0.3 || view.positions[v].z() > 0.9);
        if (rim) continue;
        const Vec3 out =
            round ? view.positions[v] : Vec3(view.positions[v].x(), view.positions[v].y(), 0);
        sum += u[v].dot(out.normalized());
        ++count;
    }
    return -sum / static_cast<double>(count);
}

}  // namespace

TEST_CASE("a bending row measures the angle of its hinge, and no rigid motion changes it") {
    for (const double angle : {-1.5, -0.2, 0.0, 0.1, 0.7, 2.0}) {
        const SurfaceView view = hinge_view(angle, Vec3(0.3, 0.8, 0), Vec3(0.6, -0.5, 0));
        const std::vector<Vec3> flat(2, Vec3(0, 0, 1));
        const Bending bending(view, flat);
        REQUIRE(bending.links.hinges.size() == 1);
        const Row& row = bending.system.rows[0];
        const double scale = row.direction.norm();
        const double area = 0.5 * 0.8 + 0.5 * 0.5;
        const double sine = 2 * std::sin(angle / 2);
        CHECK(scale * scale == doctest::Approx(3.0 / area / std::pow(1 + sine * sine / 0.09, 2)));
        CHECK(bending.applied(row, view.positions) == doctest::Approx(-scale * sine).epsilon(1e-9));
        // to become flat
        CHECK(bending.system.wanted[0] == doctest::Approx(scale * sine).epsilon(1e-9));
        std::vector<Vec3> u(4, Vec3(0.3, -2, 1));
        CHECK(std::abs(bending.applied(row, u)) < 1e-12 * scale);
        for (std::size_t v = 0; v < 4; ++v) u[v] = Vec3(1, 2, -0.5).cross(view.positions[v]);
        CHECK(std::abs(bending.applied(row, u)) < 1e-12 * scale);
    }
}

TEST_CASE("a hinge that has the angle of the filtered normals rests, sliver or not") {
    for (const double height : {0.8, 0.01}) {
        const SurfaceView view = hinge_view(0.4, Vec3(0.3, height, 0), Vec3(0.6, -0.5, 0));
        CHECK(std::abs(Bending(view, view.face_normals).system.wanted[0]) < 1e-14);
    }
}

TEST_CASE("balls and tubes do not shrink: bending aims at the angles of the filtered normals") {
    const auto ball = dsc::sdk::icosphere(3, 1.0);
    const double flat_ball = mean_shrinkage(ball, false, true);
    CHECK(flat_ball > 0.05);
    CHECK(std::abs(mean_shrinkage(ball, true, true)) < 0.05 * flat_ball);
    const auto pipe = tube(24, 16, 0.3);
    const double flat_pipe = mean_shrinkage(pipe, false, false);
    CHECK(flat_pipe > 0.01);
    CHECK(std::abs(mean_shrinkage(pipe, true, false)) < 0.1 * flat_pipe);
}

TEST_CASE(
    "the filter keeps the normals of a ball and the two sides of a crease, and reduces noise") {
    const SurfaceView ball = dsc::sdk::view_of(dsc::sdk::icosphere(4, 1.0));
    std::vector<Vec3> filtered;
    filter_normals(ball, 4, 0.5, std::vector<double>(ball.vertex_count(), ball.mean_edge), nullptr,
                   filtered);
    for (std::size_t f = 0; f < ball.face_count(); ++f)
        CHECK((filtered[f] - ball.face_normals[f]).norm() < 0.02);

    auto roof = dsc::sdk::square(20, 1.0);
    dsc::RandomStream random(dsc::RandomKey{3, 1, 0, 0});
    for (Vec3& p : roof.points) p.z() = -std::abs(p.x()) + 0.01 * (random.uniform() - 0.5);
    const SurfaceView noisy = dsc::sdk::view_of(roof);
    filter_normals(noisy, 4, 0.35, std::vector<double>(noisy.vertex_count(), noisy.mean_edge),
                   nullptr, filtered);
    double before = 0.0, after = 0.0;
    for (std::size_t f = 0; f < noisy.face_count(); ++f) {
        const auto& [a, b, c] = noisy.faces[f];
        const double side =
            noisy.positions[a].x() + noisy.positions[b].x() + noisy.positions[c].x() > 0 ? 1 : -1;
        const Vec3 truth = Vec3(side, 0, 1).normalized();
        before += (noisy.face_normals[f] - truth).squaredNorm();
        after += (filtered[f] - truth).squaredNorm();
    }
    CHECK(after < 0.2 * before);
}

TEST_CASE("a ball of radius r has the mean curvature 1/r, seen from inside -1/r, a plane none") {
    for (const double radius : {0.5, 2.0}) {
        auto mesh = dsc::sdk::icosphere(4, radius);
        for (const double sign : {1.0, -1.0}) {
            const SurfaceView view = dsc::sdk::view_of(mesh);
            SurfaceLinks links;
            build_links(view, links);
            std::vector<double> curvature;
            measure_curvature(view, links, 100, nullptr, curvature);
            for (const double c : curvature)
                CHECK(c == doctest::Approx(sign / radius).epsilon(0.02));
            measure_curvature(view, links, 0.1, nullptr, curvature);
            for (const double c : curvature) CHECK(c == sign * 0.1);
            for (auto& face : mesh.faces) std::swap(face[1], face[2]);
        }
    }
}

namespace {

struct Data {
    Data(const SurfaceView& view, const std::vector<Vec3>& points, double width, double noise,
         double reach, bool corrected) {
        dsc::surface::nearest_faces(view, points, places);
        SurfaceLinks links;
        build_links(view, links);
        if (corrected) measure_curvature(view, links, 100, nullptr, curvature);
        const std::vector<double> point_widths(points.size(), width),
            widths(view.vertex_count(), width);
        system.rows.resize(points.size());
        system.wanted.resize(points.size());
        data_rows({view, points, places, point_widths, widths, curvature, noise, reach}, 0, system,
                  fits, nullptr);
    }
    std::vector<dsc::surface::FacePoint> places;
    std::vector<double> curvature;
    std::vector<PointFit> fits;
    RowSystem system;
};

}  // namespace

TEST_CASE("data rows are met exactly where the surface lies in the plane of the points") {
    const SurfaceView view = dsc::sdk::view_of(dsc::sdk::square(6, 1.0));
    dsc::RandomStream random(dsc::RandomKey{5, 1, 0, 0});
    std::vector<Vec3> points;
    const auto height = [](const Vec3& p) { return 0.05 + 0.02 * p.x() - 0.01 * p.y(); };
    for (int i = 0; i < 200; ++i) {
        Vec3 p(1.8 * random.uniform() - 0.9, 1.8 * random.uniform() - 0.9, 0);
        p.z() = height(p);
        points.push_back(p);
    }
    const Data data(view, points, 0.1, 0.0, 2.1, false);
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Row& row = data.system.rows[i];
        Vec3 sum = Vec3::Zero();
        for (std::size_t k = 0; k < 4; ++k)
            sum += row.factor[k] * Vec3(0, 0, height(view.positions[row.vertex[k]]));
        CHECK(row.direction.dot(sum) == doctest::Approx(data.system.wanted[i]).epsilon(1e-12));
        const double ratio = data.fits[i].distance / 0.21;
        CHECK(data.fits[i].weight == doctest::Approx(0.01 / std::pow(1 + ratio * ratio, 2)));
    }
}

TEST_CASE("points beyond three reaches have no effect, those at 6 sigma count a quarter") {
    const SurfaceView view = dsc::sdk::view_of(dsc::sdk::square(6, 1.0));
    const std::vector<Vec3> points = {Vec3(0, 0, 0.059), Vec3(0, 0, 0.061), Vec3(0, 0, -0.059),
                                      Vec3(0, 0, 0)};
    const Data clean(view, points, 0.02, 0.0, 1.0, false);
    CHECK(clean.fits[0].weight > 0);
    CHECK(clean.fits[1].weight == 0);
    CHECK(clean.system.rows[1].factor == std::array<double, 4>{});
    CHECK(clean.system.rows[2].direction.z() < 0);
    CHECK(clean.system.wanted[3] == 0);
    const Data noisy(view, points, 0.02, 0.059 / 6, 1.0, false);
    CHECK(noisy.fits[0].weight == doctest::Approx(0.0004 / 4));
}

TEST_CASE("the offset by which noise moves the mean of a ball's points is subtracted") {
    const double radius = 1.0, noise = 0.05;
    const SurfaceView view = dsc::sdk::view_of(dsc::sdk::icosphere(4, radius));
    dsc::RandomStream random(dsc::RandomKey{11, 1, 0, 0});
    std::vector<Vec3> points;
    for (int i = 0; i < 20000; ++i) {
        const double z = 2 * random.uniform() - 1, turn = 2 * std::numbers::pi * random.uniform();
        const double flat = std::sqrt(1 - z * z);
        points.push_back(radius * Vec3(flat * std::cos(turn), flat * std::sin(turn), z) +
                         noise * Vec3(random.normal(), random.normal(), random.normal()));
    }
    const auto mean_pull = [&](bool corrected) {
        const Data data(view, points, 0.02, noise, 1.0, corrected);
        double sum = 0.0;
        for (std::size_t i = 0; i < points.size(); ++i) {
            const Row& row = data.system.rows[i];
            const double outwards = row.direction.dot(points[i]) > 0 ? 1.0 : -1.0;
            if (data.fits[i].weight > 0)
                sum += outwards * data.system.wanted[i] / row.direction.norm();
        }
        return sum / static_cast<double>(points.size());
    };
    const double plain = mean_pull(false);
    // sigma^2 H, and the sagitta of the faces
    CHECK(plain == doctest::Approx(noise * noise / radius).epsilon(0.4));
    CHECK(std::abs(mean_pull(true)) < 0.4 * plain);
}

TEST_CASE("support is one where points cover the surface and none where they do not") {
    const SurfaceView view = dsc::sdk::view_of(dsc::sdk::square(10, 1.0));
    std::vector<Vec3> points;
    const double width = 0.02;
    for (double x = -1 + width / 2; x < 0; x += width) {
        for (double y = -1 + width / 2; y < 1; y += width) points.emplace_back(x, y, 0.005);
    }
    const Data data(view, points, width, 0.0, 10.0, false);
    Support support;
    measure_support(view, data.places, data.fits, support);
    for (std::size_t v = 0; v < view.vertex_count(); ++v) {
        const Vec3& p = view.positions[v];
        if (p.x() < -0.25) CHECK(support.share[v] == doctest::Approx(1.0).epsilon(0.06));
        if (p.x() > 0.05) CHECK(support.share[v] == 0.0);
        CHECK(support.residual[v] == doctest::Approx(p.x() > 0.05 ? 0.0 : 0.005).epsilon(1e-9));
    }
}

TEST_CASE("widths follow the nearby points if the spacing is uneven, gaps always do") {
    std::vector<Vec3> points;
    for (double x = -0.995; x < 0; x += 0.01) {
        for (double y = -0.495; y < 0.5; y += 0.01) points.emplace_back(x, y, 0);
    }
    for (double x = 0.02; x < 6; x += 0.04) {
        for (double y = -0.48; y < 0.5; y += 0.04) points.emplace_back(x, y, 0);
    }
    const dsc::cloud::TargetCloud cloud(dsc::cloud::Normalized{points, {}});
    REQUIRE(cloud.statistics().spread > 3);
    const SurfaceView view = dsc::sdk::view_of(dsc::sdk::moved(
        dsc::sdk::square(40, 0.4), [](const Vec3& p) { return Vec3(p.x(), p.y(), 0.02); }));
    SurfaceLinks links;
    build_links(view, links);
    dsc::hooks::StepContext context = dsc::sdk::step_context(view);
    context.cloud = &cloud;
    Scales scales = scales_of(cloud.statistics(), 0);
    std::vector<double> widths, gaps;
    measure_widths(context, links, scales, widths);
    measure_gaps(context, gaps);
    for (std::size_t v = 0; v < widths.size(); ++v) {
        const double x = view.positions[v].x();
        if (std::abs(x) < 0.15) continue;
        const double width = x < 0 ? 0.01 : 0.04;
        CHECK(widths[v] == doctest::Approx(width).epsilon(0.1));
        CHECK(gaps[v] >= 0.02 / width * 0.9);
        CHECK(gaps[v] <= std::hypot(0.02, 0.75 * width) / width * 1.1);
    }
    scales.even = true;
    measure_widths(context, links, scales, widths);
    for (const double w : widths) CHECK(w == cloud.statistics().width);
}
