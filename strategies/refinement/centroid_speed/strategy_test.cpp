// Tests of the requests on surfaces with known values; the plugin is loaded as in a run.
#include <algorithm>

#include <doctest/doctest.h>

#include <dsc/host/host.hpp>
#include <dsc/sdk/surfaces.hpp>

namespace {

using dsc::Vec3;
using dsc::config::ConfigNode;

// A field with a value everywhere: `speed(point)` along the normal. It records the requested
// samples.
struct Field final : dsc::hooks::VelocityField {
    explicit Field(std::function<double(const Vec3&)> law) : speed(std::move(law)) {}
    void prepare(const dsc::hooks::StepContext&) override {}
    void evaluate(dsc::hooks::Range, std::span<Vec3> out) const override {
        std::fill(out.begin(), out.end(), Vec3::Zero());
    }
    bool can_sample() const override { return true; }
    void sample(std::span<const Vec3> points, std::span<const Vec3> normals,
                std::span<Vec3> out) const override {
        for (std::size_t i = 0; i < out.size(); ++i) out[i] = speed(points[i]) * normals[i];
    }
    std::function<double(const Vec3&)> speed;
};

std::vector<std::uint32_t> split_faces(const dsc::surface::SurfaceView& view, const Field& field,
                                       const ConfigNode& params,
                                       const dsc::cloud::TargetCloud* cloud = nullptr) {
    dsc::host::Host host;
    host.load(DSC_TEST_PLUGIN);
    const auto policy =
        host.create<dsc::hooks::RefinementPolicy>({"centroid_speed", params}, "schedule.1.refine");
    CHECK(policy->needs_sampling());
    const dsc::hooks::StepContext step{
        .surface = view, .cloud = cloud, .box = {}, .to_normalised = {}};
    dsc::hooks::RefinementRequests requests;
    policy->refine({step, &field}, requests);
    CHECK(requests.split_edges.empty());
    CHECK(requests.sizing.empty());
    CHECK(requests.relabel.empty());
    return requests.split_faces;
}

ConfigNode thresholds(double rest, double moving) {
    return ConfigNode::map({{"rest", rest}, {"moving", moving}});
}

Vec3 centroid(const dsc::surface::SurfaceView& view, std::size_t face) {
    const auto& [a, b, c] = view.faces[face];
    return (view.positions[a] + view.positions[b] + view.positions[c]) / 3;
}

constexpr double pi = 3.14159265358979323846;

}  // namespace

TEST_CASE("faces are split where the vertices rest and the centroid does not, nowhere else") {
    // Cells of 0.2: sin(5 pi x) vanishes in all vertices and nowhere between them. For x < 0
    // everything rests.
    const auto view = dsc::sdk::view_of(dsc::sdk::square(10, 1.0));
    const Field ripple(
        [](const Vec3& p) { return p.x() < 0 ? 0.0 : 0.1 * std::abs(std::sin(5 * pi * p.x())); });
    const auto split = split_faces(view, ripple, thresholds(0.01, 0.01));
    for (std::uint32_t face = 0; face < view.face_count(); ++face) {
        CHECK((std::find(split.begin(), split.end(), face) != split.end()) ==
              (centroid(view, face).x() > 0));
    }
    CHECK(std::is_sorted(split.begin(), split.end()));
    CHECK(split.size() == view.face_count() / 2);
}

TEST_CASE("one moving vertex keeps a face from being split") {
    const auto view = dsc::sdk::view_of(dsc::sdk::square(10, 1.0));
    const std::uint32_t mover = 60;  // the middle of the square
    const Vec3 place = view.positions[mover];
    const Field field(
        [&](const Vec3& p) { return std::sin(5 * pi * p.x()) + (p == place ? 1.0 : 0.0); });
    const auto split = split_faces(view, field, thresholds(0.01, 0.01));
    CHECK(split.size() == view.face_count() - view.faces_of(mover).size());
    for (const std::uint32_t face : view.faces_of(mover))
        CHECK(std::find(split.begin(), split.end(), face) == split.end());
}

TEST_CASE("the thresholds are fractions of the mean edge, or a length") {
    for (const double scale : {1.0, 0.01}) {
        const auto view = dsc::sdk::view_of(dsc::sdk::square(4, scale));
        const double fast = 0.05 * view.mean_edge;
        const double cell = 0.5 * scale;
        const Field field([&](const Vec3& p) {
            return std::abs(std::sin(pi * p.x() / cell)) > 0.5 ? fast : 0.2 * fast;
        });
        CHECK(split_faces(view, field, thresholds(0.02, 0.049)).size() == view.face_count());
        CHECK(split_faces(view, field, thresholds(0.02, 0.051)).empty());
        CHECK(split_faces(view, field, thresholds(0.009, 0.049)).empty());
        const auto absolute = [](double length) {
            return ConfigNode::map({{"rest", 0.0}, {"moving", 100.0}, {"absolute", length}});
        };
        CHECK(split_faces(view, field, absolute(0.99 * fast)).size() == view.face_count());
        CHECK(split_faces(view, field, absolute(1.01 * fast)).empty());
        CHECK(split_faces(view, field, absolute(0.19 * fast)).empty());
    }
}

TEST_CASE(
    "the vertices are sampled with their own normals, the centroids with those of the faces") {
    const auto roof =
        dsc::sdk::view_of(dsc::sdk::moved(dsc::sdk::square(2, 1.0), [](const Vec3& p) {
            return Vec3(p.x(), p.y(), -std::abs(p.x()));
        }));
    const Vec3 left = Vec3(-1, 0, 1).normalized(), right = Vec3(1, 0, 1).normalized();
    struct Witness final : dsc::hooks::VelocityField {
        void prepare(const dsc::hooks::StepContext&) override {}
        void evaluate(dsc::hooks::Range, std::span<Vec3>) const override {}
        bool can_sample() const override { return true; }
        void sample(std::span<const Vec3> points, std::span<const Vec3> normals,
                    std::span<Vec3> out) const override {
            asked_points.emplace_back(points.begin(), points.end());
            asked_normals.emplace_back(normals.begin(), normals.end());
            std::fill(out.begin(), out.end(), Vec3::Zero());
        }
        mutable std::vector<std::vector<Vec3>> asked_points, asked_normals;
    };
    dsc::host::Host host;
    host.load(DSC_TEST_PLUGIN);
    const auto policy = host.create<dsc::hooks::RefinementPolicy>(
        {"centroid_speed", ConfigNode::map()}, "schedule.1.refine");
    const dsc::hooks::StepContext step{.surface = roof, .box = {}, .to_normalised = {}};
    const Witness witness;
    dsc::hooks::RefinementRequests requests;
    policy->refine({step, &witness}, requests);
    CHECK(requests.split_faces.empty());
    REQUIRE(witness.asked_points.size() == 2);
    CHECK(witness.asked_points[0] == roof.positions);
    CHECK(witness.asked_normals[0] == roof.normals);
    REQUIRE(witness.asked_points[1].size() == roof.face_count());
    for (std::size_t face = 0; face < roof.face_count(); ++face) {
        CHECK(witness.asked_points[1][face] == centroid(roof, face));
        const Vec3& side = witness.asked_points[1][face].x() < 0 ? left : right;
        CHECK((witness.asked_normals[1][face] - side).norm() < 1e-15);
    }
}

TEST_CASE("faces finer than the cloud are not split") {
    dsc::cloud::Normalized lattice;
    for (int j = -20; j <= 20; ++j) {
        for (int i = -20; i <= 20; ++i) lattice.points.emplace_back(0.1 * i, 0.1 * j, 0.3);
    }
    const dsc::cloud::TargetCloud cloud(lattice);
    // four sides, then diagonals
    REQUIRE(cloud.neighbour_distance(20 * 41 + 20) == doctest::Approx(0.1 * std::sqrt(2.0)));
    const auto view = dsc::sdk::view_of(dsc::sdk::square(10, 1.0));  // longest edges 0.2 sqrt 2
    const Field field([](const Vec3& p) { return 0.1 * std::abs(std::sin(5 * pi * p.x())); });
    ConfigNode params = ConfigNode::map({{"finest", 1.99}});
    CHECK(split_faces(view, field, params, &cloud).size() == view.face_count());
    params = ConfigNode::map({{"finest", 2.01}});
    CHECK(split_faces(view, field, params, &cloud).empty());
    // without a cloud there is no bound
    CHECK(split_faces(view, field, params).size() == view.face_count());
}

TEST_CASE("without faces nothing is requested") {
    const Field field([](const Vec3&) { return 1.0; });
    CHECK(split_faces(dsc::sdk::view_of({}), field, ConfigNode::map()).empty());
}
