// Attributes in the report's viewer: which surfaces have them, and what a vertex that is drawn
// gets.
#include "report/attributes.hpp"

#include <cmath>
#include <limits>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include <dsc/io/read.hpp>
#include <dsc/run/run_experiment.hpp>

#include "../run/fakes.hpp"
#include "report/record.hpp"
#include "report/scene.hpp"

using namespace dsc;
using dsc::test::Folder;
using dsc::test::minimal;
using nlohmann::ordered_json;
namespace fs = std::filesystem;

namespace {

constexpr double no_value = std::numeric_limits<double>::quiet_NaN();

/// Shrinks by a part of the position and publishes 3 z + 10 under several names.
class Heights final : public hooks::VelocityField {
public:
    struct Params {
        int names = 1;
    };
    static void declare(config::ParamSchema<Params>& s) {
        s.integer("names", &Params::names).range(0, 9).unit("dimensionless").doc("Attributes.");
    }
    Heights(const Params& params, const plugin::Setup&) : names_(params.names) {}
    void prepare(const hooks::StepContext& context) override { surface_ = &context.surface; }
    void evaluate(hooks::Range range, std::span<Vec3> out) const override {
        for (std::size_t i = 0; i < out.size(); ++i)
            out[i] = -0.02 * surface_->positions[range.begin + i];
    }
    void publish(hooks::Attributes& out) const override {
        std::vector<double> heights;
        for (const Vec3& p : surface_->positions) heights.push_back(3.0 * p.z() + 10.0);
        for (int i = 0; i < names_; ++i) out.push_back({"height_" + std::to_string(i), heights});
    }

private:
    int names_;
    const surface::SurfaceView* surface_ = nullptr;
};

class Catalogue : public dsc::test::Strategies {
public:
    Catalogue() {
        plugin::Registrar& registrar = *this;
        registrar.add<Heights>("heights", "publishes the height");
    }
};

const Catalogue& strategies() {
    static const Catalogue catalogue;
    return catalogue;
}

struct Shown {
    ordered_json json;
    std::vector<std::string> notes;
    const ordered_json& frame(std::size_t i) const { return json["frames"][i]; }
    const ordered_json& result() const { return json["frames"].back(); }
};

/// The scene of a run with these files.
Shown shown(const std::string& surfaces, const std::string& volumes, int names = 1,
            const report::SceneLimits& limits = {}) {
    const Folder folder;
    const std::string text =
        minimal + "output: {report: true, surface: " + surfaces + ", volume: " + volumes + "}\n";
    const std::vector<std::string> overrides = {
        "velocity={type: heights, names: " + std::to_string(names) + "}", "schedule.0.steps=3",
        "initial_mesh.cells=9"};
    const run::LoadedExperiment loaded =
        run::load_experiment(folder.write("test.yaml", text), overrides, strategies().loader());
    run::RunOptions options;
    options.folder = folder.path() / "run";
    folder.write("libdsc_fake.so", "stands for a plugin");
    const fs::path here = fs::current_path();
    fs::current_path(folder.path());
    run::run_experiment(loaded, strategies(), options);
    fs::current_path(here);
    const report::RunRecord record = report::read_record(folder.path() / "run");
    report::Scene scene = report::make_scene(record, limits, {strategies()}, nullptr);
    return {ordered_json::parse(scene.json), scene.notes};
}

std::vector<unsigned char> decoded(const std::string& base64) {
    const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::vector<unsigned char> out;
    unsigned bits = 0;
    int count = 0;
    for (const char c : base64) {
        if (c == '=') break;
        bits = bits << 6U | static_cast<unsigned>(digits.find(c));
        count += 6;
        if (count < 8) continue;
        count -= 8;
        out.push_back(static_cast<unsigned char>(bits >> static_cast<unsigned>(count) & 0xFFU));
    }
    return out;
}

std::vector<Vec3> points_of(const ordered_json& frame) {
    const ordered_json& packed = frame["mesh"]["points"];
    const std::vector<unsigned char> bytes = decoded(packed["data"]);
    std::vector<Vec3> points(packed["count"].get<std::size_t>());
    for (std::size_t i = 0; i < points.size(); ++i) {
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t at = 6 * i + 2 * k;
            const double low = packed["low"][k], step = packed["step"][k];
            points[i][static_cast<int>(k)] = low + step * (bytes[at] + 256 * bytes[at + 1]);
        }
    }
    return points;
}

/// The attribute is linear in z, and so are the levels.
void check_levels(const ordered_json& frame) {
    const std::vector<Vec3> points = points_of(frame);
    const ordered_json& attribute = frame["attributes"][0];
    const std::vector<unsigned char> levels = decoded(attribute["data"]);
    REQUIRE(levels.size() == points.size());
    double low = 9, high = -9;
    for (const Vec3& p : points) {
        low = std::min(low, p.z());
        high = std::max(high, p.z());
    }
    for (std::size_t i = 0; i < levels.size(); ++i)
        CHECK(std::abs(levels[i] - 254 * (points[i].z() - low) / (high - low)) < 1.0);
    // Published before the step moved the surface.
    CHECK(attribute["low"].get<double>() == doctest::Approx(10 + 3 * low / 0.98).epsilon(1e-9));
    CHECK(attribute["high"].get<double>() == doctest::Approx(10 + 3 * high / 0.98).epsilon(1e-9));
}

}  // namespace

TEST_CASE("surfaces have the attributes of the .ply, else of the .vtu, from the first step on") {
    const Shown ply = shown("[obj, ply]", "[dsc]"), vtu = shown("[obj]", "[dsc, vtu]");
    for (const Shown* scene : {&ply, &vtu}) {
        CHECK(scene->frame(0)["label"] == "step 0");
        CHECK_FALSE(scene->frame(0).contains("attributes"));
        REQUIRE(scene->json["frames"].size() > 2);
        for (std::size_t i = 1; i < scene->json["frames"].size(); ++i) {
            CAPTURE(i);
            REQUIRE(scene->frame(i)["attributes"].size() == 1);
            CHECK(scene->frame(i)["attributes"][0]["name"] == "height_0");
            check_levels(scene->frame(i));
        }
    }
    CHECK(ply.result() == vtu.result());
    CHECK(shown("[ply]", "[dsc]").result() == ply.result());
}

TEST_CASE(
    "without a file that holds them no surface has attributes, nor where none are published") {
    for (const Shown& scene : {shown("[obj]", "[dsc]"), shown("[ply]", "[dsc, vtu]", 0)}) {
        for (const ordered_json& frame : scene.json["frames"])
            CHECK_FALSE(frame.contains("attributes"));
        CHECK(scene.notes.empty());
    }
}

TEST_CASE("a page has six attributes at most and says so") {
    const Shown scene = shown("[ply]", "[dsc]", 8);
    REQUIRE(scene.result()["attributes"].size() == 6);
    CHECK(scene.result()["attributes"][5]["name"] == "height_5");
    CHECK(scene.frame(1)["attributes"].size() == 6);
    CHECK(scene.notes ==
          std::vector<std::string>{
              "of the surface's 8 attributes only these can be used as colours: the first 6"});
    CHECK(shown("[ply]", "[dsc]", 6).notes.empty());
}

TEST_CASE("a vertex of a thinned surface has the value of the nearest vertex of the whole one") {
    const Shown whole = shown("[ply]", "[dsc]"),
                thin = shown("[ply]", "[dsc]", 1, {.faces = 60, .frame_faces = 60});
    for (const std::size_t at : {std::size_t{1}, whole.json["frames"].size() - 1}) {
        const std::vector<Vec3> all = points_of(whole.frame(at)), few = points_of(thin.frame(at));
        REQUIRE(few.size() < all.size());
        const ordered_json &all_of = whole.frame(at)["attributes"][0],
                           &few_of = thin.frame(at)["attributes"][0];
        CHECK(few_of["low"] == all_of["low"]);
        CHECK(few_of["high"] == all_of["high"]);
        const std::vector<unsigned char> levels = decoded(all_of["data"]),
                                         drawn = decoded(few_of["data"]);
        REQUIRE(drawn.size() == few.size());
        for (std::size_t i = 0; i < few.size(); ++i) {
            double nearest = 1e9;
            for (const Vec3& p : all) nearest = std::min(nearest, (p - few[i]).norm());
            // The page has its points in 16 bits; where two are as near as each other, either will
            // do.
            bool fits = false;
            for (std::size_t k = 0; k < all.size(); ++k)
                fits = fits || ((all[k] - few[i]).norm() < nearest + 1e-4 && levels[k] == drawn[i]);
            CHECK(fits);
        }
    }
}

TEST_CASE("levels: the outer hundredths are cut, what is not finite has none, huge bounds and a "
          "single value are allowed") {
    report::AttributeSource source;
    std::vector<double> values;
    for (int i = 0; i <= 1000; ++i) {
        source.points.emplace_back(i, 0, 0);
        values.push_back(i);
    }
    values[0] = -1e9;
    values[1000] = 1e9;
    values[500] = no_value;
    source.arrays = {{"ramp", values},
                     {"same", std::vector<double>(1001, 4.0)},
                     {"huge", std::vector<double>(1001, -1.7e308)}};
    std::fill(source.arrays[2].values.begin() + 500, source.arrays[2].values.end(), 1.7e308);
    const ordered_json packed = report::pack_attributes(source, source.points, nullptr);
    REQUIRE(packed.size() == 3);
    const double low = packed[0]["low"], high = packed[0]["high"];
    CHECK(std::abs(low - 10) <= 1);
    CHECK(std::abs(high - 990) <= 1);
    const auto ramp = decoded(packed[0]["data"]), same = decoded(packed[1]["data"]),
               huge = decoded(packed[2]["data"]);
    CHECK(ramp[0] == 0);
    CHECK(ramp[1000] == 254);
    CHECK(ramp[500] == report::no_level);
    for (int i = 20; i < 980; ++i) {
        if (i != 500)
            CHECK(std::abs(ramp[static_cast<std::size_t>(i)] - 254 * (i - low) / (high - low)) <=
                  0.5 + 1e-9);
    }
    CHECK(packed[1]["low"] == packed[1]["high"]);
    CHECK(same == std::vector<unsigned char>(1001, 0));
    CHECK(huge[0] == 0);
    CHECK(huge[1000] == 254);
    Workers three(3);
    std::vector<Vec3> between;
    for (int i = 0; i < 2000; ++i) between.emplace_back(0.5 * i + 0.1, 1, 0);
    CHECK(report::pack_attributes(source, between, &three) ==
          report::pack_attributes(source, between, nullptr));
    CHECK(report::pack_attributes({}, between, nullptr).empty());
}

TEST_CASE("attributes are known by their names and values; points off the surface have none") {
    const double infinite = std::numeric_limits<double>::infinity();
    const auto kept = report::attributes_among({{"gap", {1, no_value}},
                                                {"distance", {1, 2}},
                                                {"<b>", {1, 2}},
                                                {"none", {no_value, infinite}},
                                                {"gap", {3, 4}},
                                                {"age", {1, 2}}});
    REQUIRE(kept.size() == 2);
    CHECK(kept[0].name == "gap");
    CHECK(kept[0].values[0] == 1);
    CHECK(kept[1].name == "age");
    const report::AttributeSource on =
        report::with_values({{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}},
                             {{"gap", {no_value, 2, no_value}}, {"age", {no_value, no_value, 3}}}});
    CHECK(on.points == std::vector<Vec3>{{1, 0, 0}, {2, 0, 0}});
    CHECK(on.arrays[0].values[0] == 2);
    CHECK(on.arrays[1].values[1] == 3);
}
