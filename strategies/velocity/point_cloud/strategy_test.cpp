#include "strategy.hpp"

#include <doctest/doctest.h>

#include <cmath>
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
            normalized.points.emplace_back(half * (2.0 * i / n - 1), half * (2.0 * j / n - 1), height);
        }
    }
    return dsc::cloud::TargetCloud(normalized);
}

struct Bench {
    explicit Bench(const dsc::surface::TriangleMesh& mesh) : view(dsc::sdk::view_of(mesh)) {
        host.load(DSC_TEST_PLUGIN);
        host.load(std::filesystem::path(DSC_TEST_PLUGIN).parent_path() / "libdsc_implicit_fairing.so");
    }
    std::unique_ptr<dsc::hooks::VelocityField> make(const ConfigNode& params) const {
        return host.create<dsc::hooks::VelocityField>({"point_cloud", params}, "velocity");
    }
    dsc::hooks::StepContext context(const dsc::cloud::TargetCloud* cloud) const {
        return {
            .step = 3, .surface = view, .cloud = cloud, .target_length = 0.1, .box = {}, .to_normalised = {}};
    }
    std::vector<Vec3> displacements(dsc::hooks::VelocityField& field, const dsc::cloud::TargetCloud* cloud,
                                    unsigned threads = 1, std::size_t block = 64) const {
        field.prepare(context(cloud));
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

TEST_CASE("a plane goes the part alpha of the way to a parallel plane of points") {
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
    for (const Vec3& d : bench.displacements(*field, &cloud)) CHECK((d - Vec3(0, 0, -0.1)).norm() < 1e-15);
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
}

namespace {

// Points on a ring of the given radius in the plane z = height; neighbours are about 2 pi radius / n apart.
dsc::cloud::TargetCloud ring_cloud(double radius, double height, int n) {
    dsc::cloud::Normalized ring;
    for (int i = 0; i < n; ++i) {
        const double angle = 2 * 3.14159265358979323846 * i / n;
        ring.points.emplace_back(radius * std::cos(angle), radius * std::sin(angle), height);
    }
    return dsc::cloud::TargetCloud(ring);
}

ConfigNode carving(double beyond, double carve) {
    return ConfigNode::map({{"unsupported", ConfigNode::map({{"beyond", beyond}, {"carve", carve}})}});
}

}  // namespace

TEST_CASE("a lid whose nearest points lie in its plane stands still, and is carved in where no point supports it") {
    const Bench bench(dsc::sdk::square(8, 0.5));
    const auto rim = ring_cloud(0.8, 0.0, 100);
    const double spacing = rim.spacing(0);
    CHECK(spacing == doctest::Approx(2 * 0.8 * std::sin(3 * 3.14159265358979323846 / 100)));  // third on either side
    for (const Vec3& d : bench.displacements(*bench.make(ConfigNode::map()), &rim)) CHECK(d == Vec3::Zero());
    const auto field = bench.make(carving(3.0, 0.2));
    const auto out = bench.displacements(*field, &rim);
    std::size_t carved = 0;
    for (std::size_t i = 0; i < out.size(); ++i) {
        const bool alone = rim.search().nearest(bench.view.positions[i]).distance > 3.0 * spacing;
        carved += alone ? 1 : 0;
        CHECK((out[i] - Vec3(0, 0, alone ? -0.2 * 0.1 : 0.0)).norm() < 1e-15);  // target length 0.1
    }
    CHECK(carved > 0);
    CHECK(carved < out.size());
}

TEST_CASE("surface on its way to points ahead of it is not carved, however far they are") {
    const Bench bench(dsc::sdk::square(8, 0.5));
    const auto ahead = plane_cloud(0.9, 1.0, 40);
    const auto field = bench.make(carving(1.0, 0.2));
    for (const Vec3& d : bench.displacements(*field, &ahead)) CHECK((d - Vec3(0, 0, 0.2 * 0.9)).norm() < 1e-12);
    // Behind it: the data term leads inwards already, faster than carving would.
    const auto behind = plane_cloud(-0.9, 1.0, 40);
    for (const Vec3& d : bench.displacements(*field, &behind)) CHECK((d - Vec3(0, 0, -0.2 * 0.9)).norm() < 1e-12);
}

TEST_CASE("an experiment without a cloud is told so") {
    const Bench bench(dsc::sdk::square(1, 0.5));
    const auto field = bench.make(ConfigNode::map());
    CHECK_THROWS_WITH_AS(
        field->prepare(bench.context(nullptr)),
        "velocity 'point_cloud': the experiment has no cloud to go to; add input: {cloud: {file: ...}}",
        dsc::ConfigError);
}

TEST_CASE("beta without an estimator is refused") {
    const Bench bench(dsc::sdk::square(1, 0.5));
    CHECK_THROWS_WITH_AS(bench.make(ConfigNode::map({{"beta", 0.1}})),
                         doctest::Contains("beta above 0 needs a curvature"), dsc::ConfigError);
}
