// Tests of the filter on clouds with a known result; the plugin is loaded as in a run.
#include <dsc/base/error.hpp>
#include <dsc/base/random.hpp>

#include "../filter_test.hpp"

namespace {

/// 1,500 points on a sphere of radius 2.
Cloud sphere() {
    dsc::RandomStream random(dsc::RandomKey{1, 0, 0, 0});
    Cloud cloud;
    for (int i = 0; i < 1500; ++i) {
        cloud.points.push_back(
            2.0 * Vec3(random.normal(), random.normal(), random.normal()).normalized());
        cloud.colours.push_back({static_cast<std::uint8_t>(i % 256), 0, 0});
    }
    cloud.source = "sphere.xyz";
    return cloud;
}

Cloud with_normals(double sign) {
    Cloud cloud = sphere();
    for (const Vec3& p : cloud.points) cloud.normals.push_back(sign * p.normalized());
    return cloud;
}

bool outwards(const Cloud& cloud) {
    for (std::size_t i = 0; i < cloud.points.size(); ++i)
        if (!(cloud.normals[i].dot(cloud.points[i]) > 1.9)) return false;
    return cloud.normals.size() == cloud.points.size();
}

double figure(const Filtered& result, const std::string& name) {
    for (const auto& [key, value] : result.report.figures)
        if (key == name) return value;
    FAIL("no figure ", name);
    return 0.0;
}

ConfigNode from(const char* source) { return ConfigNode::map({{"from", source}}); }

}  // namespace

TEST_CASE("a cloud without normals gets them, and keeps its points and colours") {
    const Cloud cloud = sphere();
    const Filtered result = filtered(cloud);
    CHECK(result.report.filter == "orient");
    CHECK(result.report.removed == 0);
    CHECK(result.cloud.points == cloud.points);
    CHECK(result.cloud.colours == cloud.colours);
    CHECK(outwards(result.cloud));
    CHECK(result.cloud.orientation.samples.size() == 1500);
    CHECK(result.cloud.areas.size() == 1500);
    CHECK(result.cloud.confidence.size() == 1500);
    CHECK(figure(result, "estimated") == 1.0);
    CHECK(figure(result, "residual") < 0.1);
    CHECK(figure(result, "mean_confidence") > 0.8);
}

TEST_CASE("normals of the file are used if they are requested") {
    const Cloud good = with_normals(1.0);
    const Filtered taken = filtered(good, from("file"));
    CHECK(taken.cloud.normals == good.normals);
    CHECK(figure(taken, "estimated") == 0.0);
    CHECK(figure(filtered(good), "estimated") == 0.0);
    CHECK(figure(filtered(good, from("estimate")), "estimated") == 1.0);
}

TEST_CASE("normals that point inwards are reversed, except with from: file") {
    const Cloud bad = with_normals(-1.0);
    const Filtered result = filtered(bad);
    CHECK(figure(result, "estimated") == 0.0);
    CHECK(figure(result, "normals_winding") < -0.4);
    CHECK(outwards(result.cloud));
    REQUIRE(result.report.notes.size() == 1);
    CHECK(result.report.notes[0].find("opposite sign") != std::string::npos);
    const Filtered insisted = filtered(bad, from("file"));
    CHECK(insisted.cloud.normals == bad.normals);
    CHECK(insisted.report.notes.empty());
}

TEST_CASE("normals that contradict the points are estimated again, and a note states why") {
    Cloud bad = with_normals(1.0);
    for (Vec3& normal : bad.normals) normal = Vec3::UnitX();
    const Filtered result = filtered(bad);
    CHECK(figure(result, "estimated") == 1.0);
    CHECK(outwards(result.cloud));
    REQUIRE(result.report.notes.size() == 1);
    CHECK(result.report.notes[0].find("are not perpendicular to the surface") != std::string::npos);
    CHECK(filtered(bad, from("estimate")).report.notes.empty());
}

TEST_CASE("the viewpoint is used if there are no usable normals") {
    Cloud view;
    for (const Vec3& p : sphere().points)
        if (p.z() > 0.6) view.points.push_back(p);
    view.sensor = dsc::cloud::Sensor{Vec3(0, 0, 9), true};
    const Filtered result = filtered(view);
    CHECK(figure(result, "estimated") == 0.0);
    std::size_t upright = 0;  // all except some at the border, where the walls to the copy behind
                              // begin
    for (std::size_t i = 0; i < view.points.size(); ++i) {
        const double along = result.cloud.normals[i].dot(view.points[i]) / 2.0;
        CHECK(along > 0.5);
        upright += along > 0.95 ? 1 : 0;
    }
    CHECK(static_cast<double>(upright) > 0.9 * static_cast<double>(view.points.size()));
    CHECK(result.report.notes.at(0).find("viewpoint 0 0 9") != std::string::npos);
    CHECK(result.cloud.sensor.has_value());
}

TEST_CASE("from: file is refused without normals") {
    try {
        filtered(sphere(), from("file"));
        FAIL("nothing was thrown");
    } catch (const dsc::Error& error) {
        CHECK(std::string(error.what()).find("sphere.xyz") != std::string::npos);
        CHECK(std::string(error.what()).find("from: estimate") != std::string::npos);
        CHECK(error.exit_code() == dsc::ExitCode::config);
    }
}

TEST_CASE("parameters have an effect") {
    CHECK(filtered(sphere(), ConfigNode::map({{"iterations", 1}})).report.figures !=
          filtered(sphere()).report.figures);
    CHECK_THROWS_AS(filtered(sphere(), from("nowhere")), dsc::ConfigError);
    Cloud many = sphere();
    for (std::size_t i = 0; many.points.size() < 11000; ++i)
        many.points.push_back(
            2.0 * (many.points[i] + 0.37 * many.points[i + 1] + Vec3(0.01, 0, 0)).normalized());
    many.colours.clear();
    CHECK_FALSE(filtered(many, ConfigNode::map({{"iterations", 2}})).cloud.orientation.all_points);
    CHECK(filtered(many, ConfigNode::map({{"iterations", 2}, {"all_points", true}}))
              .cloud.orientation.all_points);
}
