// A velocity that does not move and declares a parameter of every type, with every attribute that a
// declaration may have.
#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <dsc/plugin/plugin.hpp>

namespace {

enum class Mode { near, far };

struct Inner {
    double weight = 1.0;
    bool on = true;
    static void declare(dsc::config::ParamSchema<Inner>& s) {
        s.real("weight", &Inner::weight)
            .range(0, 1)
            .open_low()
            .required()
            .unit("dimensionless")
            .doc("Must be given.");
        s.boolean("on", &Inner::on).doc("Need not be given.");
        s.check([](const Inner& p) { return p.on || p.weight < 1; }, "a weight of 1 must be on");
        s.deprecated("heaviness", "weight");
    }
};

struct Step {
    std::uint16_t times = 1;
    std::string name;
    static void declare(dsc::config::ParamSchema<Step>& s) {
        s.integer("times", &Step::times).doc("As many as the type can hold.");
        s.string("name", &Step::name).required().doc("Must be given.");
    }
};

struct Params {
    bool flag = false;
    std::optional<bool> switched;
    int count = 3;
    std::uint8_t byte = 7;
    std::int64_t whole = -1;
    std::optional<int> limit;
    double share = 0.5;
    double below = 0.0;
    std::optional<double> radius;
    std::string label = "none";
    std::optional<std::string> remark;
    Mode mode = Mode::near;
    std::optional<Mode> other_mode;
    std::string file;
    std::string page;
    std::optional<std::string> table;
    std::array<double, 3> axis{0, 0, 1};
    std::vector<int> sizes{1, 2};
    std::vector<double> levels{0.5};
    std::vector<std::string> words;
    std::vector<std::string> formats{"obj"};
    Inner inner;
    std::optional<Inner> maybe;
    std::vector<Step> steps;
    dsc::config::StrategyConfig curvature;
    dsc::config::StrategyConfig second;
    std::vector<dsc::config::StrategyConfig> curvatures;
};

void declare_scalars(dsc::config::ParamSchema<Params>& s) {
    s.boolean("flag", &Params::flag).doc("A switch.");
    s.boolean("switched", &Params::switched).doc("A switch that may stay unset.");
    s.integer("count", &Params::count).range(1, 10, "steps").doc("Both ends closed.");
    s.integer("byte", &Params::byte).doc("As many as the type can hold.");
    s.integer("whole", &Params::whole).less(100).doc("One end, open.");
    s.integer("limit", &Params::limit).at_least(0).doc("May stay unset.");
    s.real("share", &Params::share)
        .range(0, 1, "dimensionless")
        .open_low()
        .open_high()
        .advanced()
        .doc("Both ends open.");
    s.real("below", &Params::below).at_most(0).unit("length").doc("One end, closed.");
    s.real("radius", &Params::radius).greater(0, "length").doc("One end, open; may stay unset.");
    s.string("label", &Params::label).doc("Any text | even with a bar.");
    s.string("remark", &Params::remark).doc("Text that may stay unset.");
    s.choice("mode", &Params::mode, {{"near", Mode::near}, {"far", Mode::far}}).doc("One of two.");
    s.choice("other_mode", &Params::other_mode, {{"near", Mode::near}, {"far", Mode::far}})
        .doc("One of two or unset.");
    s.file("file", &Params::file).required().doc("Any file, must be given.");
    s.file("page", &Params::page)
        .extensions({".md", ".txt"})
        .doc("A file with an extension, or none.");
    s.file("table", &Params::table).extensions({".csv"}).doc("A file that may stay unset.");
}

void declare_others(dsc::config::ParamSchema<Params>& s) {
    s.vec3("axis", &Params::axis).range(-1, 1, "dimensionless").doc("Three numbers, bounded each.");
    s.integers("sizes", &Params::sizes)
        .at_least(1)
        .size(1, 3)
        .doc("Integers, one to three of them.");
    s.reals("levels", &Params::levels)
        .range(0, 1)
        .open_high()
        .size(1)
        .doc("Numbers, one at least.");
    s.strings("words", &Params::words).size(0, 2).doc("Two words at most.");
    s.strings("formats", &Params::formats).choices({"obj", "ply"}).doc("Words out of two.");
    s.object("inner", &Params::inner, Inner::declare)
        .doc("A map with something that must be given.");
    s.object("maybe", &Params::maybe, Inner::declare).doc("The same, may stay unset.");
    s.list("steps", &Params::steps, Step::declare).size(0, 2).doc("Two maps at most.");
    s.strategy("curvature", &Params::curvature, "curvature").doc("A strategy, must be given.");
    s.strategy("second", &Params::second, "curvature")
        .optional()
        .doc("A strategy that may stay unset.");
    s.strategies("curvatures", &Params::curvatures, "curvature").doc("Any number of strategies.");
    s.check([](const Params& p) { return p.count != 7; }, "count must not be 7");
    s.check([](const Params& p) { return p.mode == Mode::near || p.radius; },
            "mode: far needs a radius");
    s.deprecated("number", "count");
    s.deprecated("source", "file");
}

class EveryField final : public dsc::hooks::VelocityField {
public:
    using Params = ::Params;
    static void declare(dsc::config::ParamSchema<Params>& s) {
        declare_scalars(s);
        declare_others(s);
    }
    EveryField(const Params&, const dsc::plugin::Setup&) {}
    void prepare(const dsc::hooks::StepContext&) override {}
    void evaluate(dsc::hooks::Range, std::span<dsc::Vec3> out) const override {
        std::fill(out.begin(), out.end(), dsc::Vec3::Zero());
    }
};

}  // namespace

DSC_PLUGIN("every_field", "1.0.0", "MIT", "A declaration with everything in it") {
    registrar.add<EveryField>("every_field", "does not move, declares everything");
}
