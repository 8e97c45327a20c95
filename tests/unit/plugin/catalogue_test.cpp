#include <doctest/doctest.h>

#include <dsc/base/error.hpp>
#include <dsc/base/random.hpp>
#include <dsc/plugin/kind.hpp>

#include "fake_catalogue.hpp"

namespace {

using dsc::config::ConfigNode;
using dsc::config::StrategyConfig;
using dsc::plugin::Kind;

struct Seen {
    std::string path;
    std::uint64_t instance = 0;
    std::uint64_t instance_in_context = 0;
    double value = 0;
};
Seen seen_inner;
Seen seen_outer;

class Inner final : public dsc::hooks::CurvatureEstimator {
public:
    struct Params {
        double value = 2.0;
    };
    static void declare(dsc::config::ParamSchema<Params>& s) {
        s.real("value", &Params::value).at_least(0).unit("dimensionless").doc("A number.");
    }
    Inner(const Params& params, const dsc::plugin::Setup& setup) {
        seen_inner = {setup.path(), setup.instance(), 0, params.value};
    }
    void prepare(const dsc::hooks::StepContext& context) override {
        seen_inner.instance_in_context = context.instance;
    }
    void evaluate(dsc::hooks::Range, std::span<double>, std::span<dsc::Vec3>) const override {}
};

class Outer final : public dsc::hooks::VelocityField {
public:
    struct Params {
        StrategyConfig curvature;
        double alpha = 0.5;
    };
    static void declare(dsc::config::ParamSchema<Params>& s) {
        s.strategy("curvature", &Params::curvature, "curvature").optional().doc("Nested.");
        s.real("alpha", &Params::alpha).unit("dimensionless").doc("A number.");
    }
    Outer(const Params& params, const dsc::plugin::Setup& setup)
        : inner_(setup.create<dsc::hooks::CurvatureEstimator>("curvature", params.curvature)) {
        seen_outer = {setup.path(), setup.instance(), 0, params.alpha};
    }
    bool has_inner() const { return inner_ != nullptr; }
    void prepare(const dsc::hooks::StepContext& context) override {
        seen_outer.instance_in_context = context.instance;
        if (inner_) inner_->prepare(context);
    }
    void evaluate(dsc::hooks::Range, std::span<dsc::Vec3>) const override {}

private:
    std::unique_ptr<dsc::hooks::CurvatureEstimator> inner_;
};

FakeCatalogue catalogue() {
    FakeCatalogue result;
    result.add<Outer>("outer", "a velocity");
    result.add<Inner>("inner", "a curvature");
    return result;
}

}  // namespace

TEST_CASE("kinds have the names of the experiment and follow from the hook") {
    for (const Kind kind : dsc::plugin::all_kinds)
        CHECK(dsc::plugin::find_kind(dsc::plugin::kind_name(kind)) == kind);
    CHECK_FALSE(dsc::plugin::find_kind("velocities"));
    CHECK(dsc::plugin::kind_of<Outer>() == Kind::velocity);
    CHECK(dsc::plugin::kind_of<dsc::hooks::InitialMesh>() == Kind::initial_mesh);
    CHECK(dsc::plugin::kind_of<dsc::hooks::CloudFilter>() == Kind::filter);
}

TEST_CASE("a catalogue looks strategies up for the configuration") {
    const FakeCatalogue all = catalogue();
    CHECK(all.ids("velocity") == std::vector<std::string>{"outer"});
    REQUIRE(all.find_schema("curvature", "inner") != nullptr);
    CHECK(all.find_schema("curvature", "inner")->names() == std::vector<std::string>{"value"});
    CHECK(all.find_schema("curvature", "outer") == nullptr);
    CHECK(all.find_schema("flavour", "inner") == nullptr);
}

TEST_CASE("strategies get their parameters, their place and a random stream of that place") {
    const FakeCatalogue all = catalogue();
    const ConfigNode nested = ConfigNode::map({{"type", "inner"}, {"value", 7}});
    const auto made = all.create<dsc::hooks::VelocityField>(
        {"outer", ConfigNode::map({{"curvature", nested}})}, "velocity");
    CHECK(seen_outer.path == "velocity");
    CHECK(seen_outer.value == 0.5);
    CHECK(seen_inner.path == "velocity.curvature");
    CHECK(seen_inner.value == 7.0);
    CHECK(seen_inner.instance == dsc::stream_id("velocity.curvature"));
    const dsc::surface::SurfaceView empty;
    made->prepare({.surface = empty, .box = {}, .to_normalised = {}, .instance = 99});
    CHECK(seen_outer.instance_in_context == dsc::stream_id("velocity"));
    CHECK(seen_inner.instance_in_context == dsc::stream_id("velocity.curvature"));
}

TEST_CASE("a nested strategy that is not given is not made") {
    const FakeCatalogue all = catalogue();
    seen_inner = {};
    all.create<dsc::hooks::VelocityField>({"outer", {}}, "velocity");
    CHECK(seen_inner.path.empty());
}

TEST_CASE("wrong parameters are faults of the configuration") {
    const FakeCatalogue all = catalogue();
    const StrategyConfig negative{"inner", ConfigNode::map({{"value", -1.0}})};
    CHECK_THROWS_AS(all.create<dsc::hooks::CurvatureEstimator>(negative, "velocity.curvature"),
                    dsc::ConfigError);
    const StrategyConfig unknown_key{"inner", ConfigNode::map({{"valeu", 1.0}})};
    CHECK_THROWS_WITH_AS(
        all.create<dsc::hooks::CurvatureEstimator>(unknown_key, "velocity.curvature"),
        doctest::Contains("curvature 'inner'"), dsc::ConfigError);
    const StrategyConfig nested_unknown{
        "outer", ConfigNode::map({{"curvature", ConfigNode::map({{"type", "innner"}})}})};
    CHECK_THROWS_AS(all.create<dsc::hooks::VelocityField>(nested_unknown, "velocity"),
                    dsc::ConfigError);
}
