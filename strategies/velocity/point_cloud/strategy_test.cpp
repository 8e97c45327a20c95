// Tests of the velocity on surfaces beside known clouds; the plugin is loaded as in a run.
#include <algorithm>
#include <cmath>

#include <doctest/doctest.h>

#include <dsc/base/error.hpp>
#include <dsc/base/workers.hpp>
#include <dsc/host/host.hpp>
#include <dsc/sdk/surfaces.hpp>

namespace {

using dsc::Vec3;
using dsc::config::ConfigNode;

// A dense lattice of points on the plane z = height.
dsc::cloud::TargetCloud plane_cloud(double height, double half, int n) {
    dsc::cloud::Normalized normalized;
    for (int j = 0; j <= n; ++j) {
        for (int i = 0; i <= n; ++i) {
            normalized.points.emplace_back(half * (2.0 * i / n - 1), half * (2.0 * j / n - 1),
                                           height);
        }
    }
    return dsc::cloud::TargetCloud(normalized);
}

struct Bench {
    explicit Bench(const dsc::surface::TriangleMesh& mesh) : view(dsc::sdk::view_of(mesh)) {
        host.load(DSC_TEST_PLUGIN);
        host.load(std::filesystem::path(DSC_TEST_PLUGIN).parent_path() /
                  "libdsc_implicit_fairing.so");
    }
    std::unique_ptr<dsc::hooks::VelocityField> make(const ConfigNode& params) const {
        return host.create<dsc::hooks::VelocityField>({"point_cloud", params}, "velocity");
    }
    dsc::hooks::StepContext context(const dsc::cloud::TargetCloud* cloud) const {
        return {.step = 3,
                .surface = view,
                .cloud = cloud,
                .target_length = 0.1,
                .box = {},
                .to_normalised = {}};
    }
    std::vector<Vec3> displacements(dsc::hooks::VelocityField& field,
                                    const dsc::cloud::TargetCloud* cloud, unsigned threads = 1,
                                    std::size_t block = 64,
                                    std::span<const dsc::cloud::Neighbour> nearest = {}) const {
        dsc::hooks::StepContext step = context(cloud);
        step.nearest = nearest;
        field.prepare(step);
        std::vector<Vec3> out(view.vertex_count());
        dsc::Workers workers(threads);
        workers.for_blocks(out.size(), block, [&](std::size_t begin, std::size_t end) {
            field.evaluate({begin, end}, std::span(out).subspan(begin, end - begin));
        });
        return out;
    }

    dsc::host::Host host;
    dsc::surface::SurfaceView view;
};

}  // namespace

TEST_CASE("the nearest points of the host are used, and searched for if the host has not done so") {
    const Bench bench(dsc::sdk::square(8, 0.5));
    dsc::cloud::Normalized slope;
    for (double x = -1; x <= 1; x += 0.1) {
        for (double y = -1; y <= 1; y += 0.1) slope.points.emplace_back(x, y, 0.5 + 0.4 * x);
    }
    const dsc::cloud::TargetCloud cloud(slope);
    const auto field = bench.make(ConfigNode::map());
    const std::vector<Vec3> asked = bench.displacements(*field, &cloud);
    std::vector<dsc::cloud::Neighbour> nearest;
    for (const Vec3& p : bench.view.positions) nearest.push_back(cloud.search().nearest(p));
    CHECK(bench.displacements(*field, &cloud, 1, 64, nearest) == asked);
    for (auto& n : nearest) n = {0, (cloud[0] - bench.view.positions[0]).norm()};
    CHECK(bench.displacements(*field, &cloud, 1, 64, nearest) != asked);
}

TEST_CASE("a plane moves the fraction alpha of the way to a parallel plane of points") {
    const Bench bench(dsc::sdk::square(8, 0.5));
    const auto cloud = plane_cloud(0.3, 1.0, 40);
    for (const double alpha : {0.2, 0.5, 1.0}) {
        const auto field = bench.make(ConfigNode::map({{"alpha", alpha}}));
        for (const Vec3& d : bench.displacements(*field, &cloud)) {
            CHECK((d - Vec3(0, 0, 0.3 * alpha)).norm() < 1e-12);
        }
    }
}

TEST_CASE("only the part along the normal counts") {
    const Bench bench(dsc::sdk::square(1, 0.5));
    dsc::cloud::Normalized one;
    one.points = {Vec3(0.7, 0.1, -0.4)};
    const dsc::cloud::TargetCloud cloud(one);
    const auto field = bench.make(ConfigNode::map({{"alpha", 0.25}}));
    for (const Vec3& d : bench.displacements(*field, &cloud))
        CHECK((d - Vec3(0, 0, -0.1)).norm() < 1e-15);
}

TEST_CASE("curvature pulls a sphere inwards by beta / r more") {
    const double radius = 0.8;
    const Bench bench(dsc::sdk::icosphere(4, radius));
    dsc::cloud::Normalized shell;
    shell.points = bench.view.positions;  // the sphere lies on its cloud: no attraction
    const dsc::cloud::TargetCloud cloud(shell);
    const ConfigNode fairing = ConfigNode::map({{"type", "implicit_fairing"}});
    const auto field = bench.make(ConfigNode::map({{"beta", 0.01}, {"curvature", fairing}}));
    const auto out = bench.displacements(*field, &cloud);
    for (std::size_t i = 0; i < out.size(); ++i) {
        CHECK(out[i].dot(bench.view.normals[i]) == doctest::Approx(-0.01 / radius).epsilon(0.02));
        CHECK(out[i].cross(bench.view.normals[i]).norm() < 1e-14);
    }
}

TEST_CASE("a sphere settles on the sphere of its cloud, from inside and from outside") {
    dsc::cloud::Normalized shell;
    shell.points = dsc::sdk::icosphere(5, 1.0).points;
    const dsc::cloud::TargetCloud cloud(shell);
    for (const double start : {0.7, 1.2}) {
        dsc::surface::TriangleMesh mesh = dsc::sdk::icosphere(3, start);
        for (int step = 0; step < 40; ++step) {
            Bench bench(mesh);
            const auto field = bench.make(ConfigNode::map());
            const auto out = bench.displacements(*field, &cloud);
            for (std::size_t i = 0; i < out.size(); ++i) mesh.points[i] += out[i];
        }
        for (const Vec3& p : mesh.points) CHECK(p.norm() == doctest::Approx(1.0).epsilon(0.003));
    }
}

TEST_CASE("vertices that cannot move get no displacement") {
    Bench bench(dsc::sdk::square(2, 0.5));
    bench.view.movable[4] = 0;
    const auto cloud = plane_cloud(0.3, 1.0, 10);
    const auto field = bench.make(ConfigNode::map());
    const auto out = bench.displacements(*field, &cloud);
    CHECK(out[4] == Vec3::Zero());
    CHECK(out[3].norm() > 0);
}

TEST_CASE("sampling gives the attraction of any point and normal") {
    const Bench bench(dsc::sdk::square(2, 0.5));
    const auto cloud = plane_cloud(0.3, 1.0, 20);
    const ConfigNode fairing = ConfigNode::map({{"type", "implicit_fairing"}});
    const auto field = bench.make(ConfigNode::map({{"beta", 0.5}, {"curvature", fairing}}));
    field->prepare(bench.context(&cloud));
    REQUIRE(field->can_sample());
    const std::vector<Vec3> points = {Vec3(0, 0, 0), Vec3(0.1, 0.2, 0.5)};
    const std::vector<Vec3> normals = {Vec3(0, 0, 1), Vec3(0, 0, -1)};
    std::vector<Vec3> out(2);
    field->sample(points, normals, out);
    CHECK((out[0] - Vec3(0, 0, 0.06)).norm() < 1e-15);
    CHECK((out[1] - Vec3(0, 0, -0.04)).norm() < 1e-15);
}

TEST_CASE("threads and blocks do not change a bit") {
    const Bench bench(dsc::sdk::icosphere(3, 0.9));
    const auto cloud = plane_cloud(0.2, 1.0, 30);
    const ConfigNode fairing = ConfigNode::map({{"type", "implicit_fairing"}, {"area", "ring"}});
    const auto field = bench.make(ConfigNode::map({{"beta", 0.01}, {"curvature", fairing}}));
    const auto reference = bench.displacements(*field, &cloud, 1, 100000);
    for (const unsigned threads : {1U, 2U, 5U}) {
        for (const std::size_t block : {1U, 37U, 129U}) {
            CHECK(bench.displacements(*field, &cloud, threads, block) == reference);
        }
    }
    const auto full =
        bench.make(ConfigNode::map({{"beta", 0.01},
                                    {"curvature", fairing},
                                    {"curvature_at", "unsupported"},
                                    {"target", ConfigNode::map({{"neighbours", 8}})},
                                    {"unsupported", ConfigNode::map({{"beyond", 2.0}})}}));
    const auto all = bench.displacements(*full, &cloud, 1, 100000);
    CHECK(all != reference);
    for (const std::size_t block : {1U, 37U, 129U})
        CHECK(bench.displacements(*full, &cloud, 3, block) == all);
}

namespace {

// Points on a ring of the given radius in the plane z = height; neighbours are about 2 pi radius /
// n apart.
dsc::cloud::TargetCloud ring_cloud(double radius, double height, int n) {
    dsc::cloud::Normalized ring;
    for (int i = 0; i < n; ++i) {
        const double angle = 2 * 3.14159265358979323846 * i / n;
        ring.points.emplace_back(radius * std::cos(angle), radius * std::sin(angle), height);
    }
    return dsc::cloud::TargetCloud(ring);
}

ConfigNode carving(double beyond, double carve) {
    return ConfigNode::map(
        {{"unsupported", ConfigNode::map({{"beyond", beyond}, {"carve", carve}})}});
}

}  // namespace

TEST_CASE("a lid whose nearest points lie in its plane does not move, and is carved in where no "
          "point supports it") {
    const Bench bench(dsc::sdk::square(8, 0.5));
    const auto rim = ring_cloud(0.8, 0.0, 100);
    const double distance = rim.neighbour_distance(0);
    CHECK(distance ==
          // the third point on each side
          doctest::Approx(2 * 0.8 * std::sin(3 * 3.14159265358979323846 / 100)));
    for (const Vec3& d : bench.displacements(*bench.make(ConfigNode::map()), &rim))
        CHECK(d == Vec3::Zero());
    const auto field = bench.make(carving(3.0, 0.2));
    const auto out = bench.displacements(*field, &rim);
    std::size_t carved = 0;
    for (std::size_t i = 0; i < out.size(); ++i) {
        const bool alone = rim.search().nearest(bench.view.positions[i]).distance > 3.0 * distance;
        carved += alone ? 1 : 0;
        CHECK((out[i] - Vec3(0, 0, alone ? -0.2 * 0.1 : 0.0)).norm() < 1e-15);  // target length 0.1
    }
    CHECK(carved > 0);
    CHECK(carved < out.size());
}

TEST_CASE("surface that moves towards points ahead of it is not carved, at any distance") {
    const Bench bench(dsc::sdk::square(8, 0.5));
    const auto ahead = plane_cloud(0.9, 1.0, 40);
    const auto field = bench.make(carving(1.0, 0.2));
    for (const Vec3& d : bench.displacements(*field, &ahead))
        CHECK((d - Vec3(0, 0, 0.2 * 0.9)).norm() < 1e-12);
    // Points behind it: the data term already leads inwards, faster than carving would.
    const auto behind = plane_cloud(-0.9, 1.0, 40);
    for (const Vec3& d : bench.displacements(*field, &behind))
        CHECK((d - Vec3(0, 0, -0.2 * 0.9)).norm() < 1e-12);
}

namespace {

ConfigNode selective(double beyond, double carve, double beta) {
    return ConfigNode::map(
        {{"beta", beta},
         {"curvature", ConfigNode::map({{"type", "implicit_fairing"}})},
         {"curvature_at", "unsupported"},
         {"unsupported", ConfigNode::map({{"beyond", beyond}, {"carve", carve}})}});
}

}  // namespace

TEST_CASE("a curvature at unsupported places does not change supported ones, to the bit") {
    // A ball with points only below the equator.
    const double radius = 0.8, beta = 0.01;
    const Bench bench(dsc::sdk::icosphere(4, radius));
    dsc::cloud::Normalized half;
    for (const Vec3& p : dsc::sdk::icosphere(5, radius).points) {
        if (p.z() <= 0) half.points.push_back(p);
    }
    const dsc::cloud::TargetCloud cloud(half);
    const auto plain = bench.displacements(*bench.make(ConfigNode::map()), &cloud);
    const auto out = bench.displacements(*bench.make(selective(2.0, 0.1, beta)), &cloud);
    std::size_t curved = 0;
    for (std::size_t i = 0; i < out.size(); ++i) {
        const dsc::cloud::Neighbour nearest = cloud.search().nearest(bench.view.positions[i]);
        if (nearest.distance <= 2.0 * cloud.neighbour_distance(nearest.index)) {
            CHECK(out[i] == plain[i]);
            continue;
        }
        ++curved;
        // carving, target length 0.1
        const double speed = std::min(plain[i].dot(bench.view.normals[i]), -0.1 * 0.1);
        CHECK(out[i].dot(bench.view.normals[i]) ==
              doctest::Approx(speed - beta / radius).epsilon(0.01));
    }
    CHECK(curved > out.size() / 4);
    CHECK(curved < out.size() / 2);
}

TEST_CASE("surface tension holds a lid over a hole narrower than beta / carving, a wider one is "
          "entered") {
    // A dent of radius r: the wall of a ball seen from inside, with mean curvature -1 / r. The rim
    // of the hole is a ring.
    const double beta = 2e-3, carving = 0.2 * 0.1;  // the target length is 0.1: they balance at r =
                                                    // 0.1
    for (const double radius : {0.07, 0.09, 0.11, 0.2}) {
        dsc::surface::TriangleMesh dent = dsc::sdk::icosphere(4, radius);
        for (auto& face : dent.faces) std::swap(face[1], face[2]);
        const Bench bench(dent);
        const auto rim = ring_cloud(radius, 0.0, 200);
        const auto out = bench.displacements(*bench.make(selective(2.0, 0.2, beta)), &rim);
        std::size_t lid = 0;
        for (std::size_t i = 0; i < out.size(); ++i) {
            const double height = bench.view.positions[i].z() / radius;
            if (height < 0.3 || height > 0.8)
                continue;  // near the rim there is support, at the pole the rim is ahead
            ++lid;
            const double speed = out[i].dot(bench.view.normals[i]);
            CHECK(speed == doctest::Approx(beta / radius - carving).epsilon(0.02));
            CHECK((speed > 0) == (radius < 0.1));
        }
        CHECK(lid > 100);
    }
}

TEST_CASE("several near points are weighted by a Gaussian of their distances") {
    const Bench bench(dsc::sdk::square(1, 0.5));
    dsc::cloud::Normalized two;
    two.points = {Vec3(0.5, 0.5, 0.3), Vec3(0.5, 0.5, 0.7)};  // 0.4 apart
    const dsc::cloud::TargetCloud cloud(two);
    const auto params = [](unsigned neighbours, double width) {
        const ConfigNode target =
            ConfigNode::map({{"neighbours", static_cast<int>(neighbours)}, {"width", width}});
        return ConfigNode::map({{"alpha", 1.0}, {"target", target}});
    };
    const auto height = [&](unsigned neighbours, double width) {
        const auto out = bench.displacements(*bench.make(params(neighbours, width)), &cloud);
        return out.back().z();  // of the corner (0.5, 0.5, 0)
    };
    REQUIRE(bench.view.positions.back() == Vec3(0.5, 0.5, 0));
    for (const double width : {0.5, 1.0, 2.0}) {
        const double sigma = 0.4 * width;
        const double w = std::exp(-(0.7 * 0.7 - 0.3 * 0.3) / (2 * sigma * sigma));
        CHECK(height(2, width) == doctest::Approx((0.3 + w * 0.7) / (1 + w)).epsilon(1e-12));
        CHECK(height(1, width) == doctest::Approx(0.3).epsilon(1e-12));
    }
    CHECK(height(5, 0.5) == height(2, 0.5));  // more points than there are
}

TEST_CASE(
    "the mean of near points follows a noisy plane more closely than the nearest point does") {
    dsc::cloud::Normalized noisy;
    for (int j = -30; j <= 30; ++j) {
        for (int i = -30; i <= 30; ++i)
            noisy.points.emplace_back(0.05 * i, 0.05 * j, (i + j) % 2 == 0 ? 0.02 : -0.02);
    }
    const dsc::cloud::TargetCloud cloud(noisy);
    const Bench bench(dsc::sdk::moved(dsc::sdk::square(15, 0.5), [](const Vec3& p) {
        return Vec3(p.x() + 0.011, p.y() + 0.007, 0);
    }));
    const auto worst = [&](const ConfigNode& params) {
        double largest = 0;
        for (const Vec3& d : bench.displacements(*bench.make(params), &cloud))
            largest = std::max(largest, d.norm());
        return largest;
    };
    const ConfigNode nearest = ConfigNode::map({{"alpha", 1.0}});
    const ConfigNode mean = ConfigNode::map(
        {{"alpha", 1.0}, {"target", ConfigNode::map({{"neighbours", 24}, {"width", 0.8}})}});
    CHECK(worst(nearest) == doctest::Approx(0.02).epsilon(1e-9));
    CHECK(worst(mean) < 0.004);
}

TEST_CASE("an experiment without a cloud gets an error") {
    const Bench bench(dsc::sdk::square(1, 0.5));
    const auto field = bench.make(ConfigNode::map());
    CHECK_THROWS_WITH_AS(
        field->prepare(bench.context(nullptr)),
        "velocity 'point_cloud': the experiment has no cloud; add input: {cloud: {file: ...}}",
        dsc::ConfigError);
}

TEST_CASE("beta without an estimator is refused") {
    const Bench bench(dsc::sdk::square(1, 0.5));
    CHECK_THROWS_WITH_AS(bench.make(ConfigNode::map({{"beta", 0.1}})),
                         doctest::Contains("beta above 0 needs a curvature"), dsc::ConfigError);
}

TEST_CASE("a curvature at unsupported places needs a limit of support") {
    const Bench bench(dsc::sdk::square(1, 0.5));
    CHECK_THROWS_WITH_AS(
        bench.make(ConfigNode::map({{"curvature_at", "unsupported"}})),
        doctest::Contains("curvature_at: unsupported needs unsupported: {beyond: ...} above 0"),
        dsc::ConfigError);
}
