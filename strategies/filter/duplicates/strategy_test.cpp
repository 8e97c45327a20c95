// Tests of the filter on clouds with a known result; the plugin is loaded as in a run.
#include <dsc/base/random.hpp>

#include "../filter_test.hpp"

namespace {

/// Points of a small lattice in an order that depends on the seed, many of them repeated, with all
/// attributes.
Cloud shuffled(std::uint64_t seed) {
    dsc::RandomStream values(dsc::RandomKey{7, 0, 0, 0});
    Cloud cloud;
    for (int i = 0; i < 400; ++i) {
        Vec3 p(static_cast<double>(values.index(5)), static_cast<double>(values.index(5)),
               static_cast<double>(values.index(4)));
        if (values.index(2) == 0) p = p.cwiseProduct(Vec3(-1, 1, 1));  // this also makes -0
        cloud.points.push_back(p);
        cloud.colours.push_back({static_cast<std::uint8_t>(values.index(3)), 0,
                                 static_cast<std::uint8_t>(values.index(3))});
        cloud.normals.push_back(
            Vec3(values.normal(), values.normal(), values.normal()).normalized());
        cloud.areas.push_back(0.1 * cloud.normals.back());
        cloud.confidence.push_back(0.25 * static_cast<double>(values.index(4)));
    }
    dsc::RandomStream order(dsc::RandomKey{seed, 1, 0, 0});
    for (std::size_t i = cloud.points.size(); i > 1; --i) {
        const std::size_t j = order.index(i);
        std::swap(cloud.points[i - 1], cloud.points[j]);
        std::swap(cloud.colours[i - 1], cloud.colours[j]);
        std::swap(cloud.normals[i - 1], cloud.normals[j]);
        std::swap(cloud.areas[i - 1], cloud.areas[j]);
        std::swap(cloud.confidence[i - 1], cloud.confidence[j]);
    }
    return cloud;
}

template <class T>
std::string bytes(const std::vector<T>& values) {
    return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

std::string bytes(const Cloud& cloud) {
    return bytes(cloud.points) + bytes(cloud.colours) + bytes(cloud.normals) + bytes(cloud.areas) +
           bytes(cloud.confidence);
}

ConfigNode sorted(double tolerance = 0.0) {
    return ConfigNode::map({{"sort", true}, {"tolerance", tolerance}});
}

}  // namespace

TEST_CASE("of equal points the first stays, in the order of the file") {
    Cloud cloud;
    cloud.points = {Vec3(2, 0, 0), Vec3(1, 0, 0), Vec3(2, 0, 0), Vec3(0, 0, 0), Vec3(-0.0, 0, 0)};
    cloud.confidence = {0.5, 0.4, 0.3, 0.2, 0.1};
    const Filtered result = filtered(cloud);
    CHECK(result.cloud.points == std::vector<Vec3>{Vec3(2, 0, 0), Vec3(1, 0, 0), Vec3(0, 0, 0)});
    CHECK(result.cloud.confidence == std::vector<double>{0.5, 0.4, 0.2});
    CHECK(result.report.filter == "duplicates");
    CHECK(result.report.kept == 3);
    CHECK(result.report.removed == 2);
}

TEST_CASE("sorted, the points ascend by x, y and z, and of equal ones the least attributes stay") {
    Cloud cloud;
    cloud.points = {Vec3(2, 0, 0), Vec3(1, 5, 1), Vec3(2, 0, 0), Vec3(1, 5, 0), Vec3(1, 4, 9)};
    cloud.confidence = {0.5, 0.4, 0.3, 0.2, 0.1};
    const Filtered result = filtered(cloud, sorted());
    CHECK(result.cloud.points ==
          std::vector<Vec3>{Vec3(1, 4, 9), Vec3(1, 5, 0), Vec3(1, 5, 1), Vec3(2, 0, 0)});
    CHECK(result.cloud.confidence == std::vector<double>{0.1, 0.2, 0.4, 0.3});
}

TEST_CASE(
    "sorted, the order of the file changes not a bit, whatever attributes hang on the points") {
    const Cloud first = shuffled(1);
    for (const double tolerance : {0.0, 0.15}) {
        const Filtered expected = filtered(first, sorted(tolerance));
        CHECK(expected.report.removed > 100);
        CHECK(expected.report.kept > 10);
        for (std::uint64_t seed = 2; seed < 8; ++seed) {
            const Cloud other = shuffled(seed);
            REQUIRE(bytes(other) != bytes(first));
            CHECK(bytes(filtered(other, sorted(tolerance)).cloud) == bytes(expected.cloud));
            // Without sorting the order has an effect, so the test can fail.
            CHECK(bytes(filtered(other, ConfigNode::map({{"tolerance", tolerance}})).cloud) !=
                  bytes(expected.cloud));
        }
    }
}

TEST_CASE("attributes go with their points") {
    const Cloud cloud = shuffled(3);
    const Cloud result = filtered(cloud, sorted()).cloud;
    REQUIRE(result.normals.size() == result.points.size());
    for (std::size_t i = 0; i < result.points.size(); ++i) {
        bool found = false;
        for (std::size_t j = 0; j < cloud.points.size() && !found; ++j) {
            found = result.points[i] == cloud.points[j] && result.normals[i] == cloud.normals[j] &&
                    result.colours[i] == cloud.colours[j] && result.areas[i] == cloud.areas[j] &&
                    result.confidence[i] == cloud.confidence[j];
        }
        CHECK(found);
    }
}
