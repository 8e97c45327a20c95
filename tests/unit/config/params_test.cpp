#include <array>
#include <cstdint>
#include <string>

#include <doctest/doctest.h>

#include <dsc/config/params.hpp>

#include "support.hpp"

using namespace dsc::config;
using test::Area;
using test::parse;

namespace {

struct Shape {
    std::string shape = "sphere";
    double radius = 1;
    bool cut = false;
    static void declare(ParamSchema<Shape>& s) {
        s.string("shape", &Shape::shape).doc("Kind of body.");
        s.real("radius", &Shape::radius).greater(0).doc("Radius.");
        s.boolean("cut", &Shape::cut).doc("Cut instead of add.");
    }
};

/// A member of every bindable type.
struct Everything {
    bool flag = true;
    std::optional<bool> maybe_flag;
    int small = 3;
    std::optional<std::int64_t> maybe_large;
    std::size_t count = 5;
    double real = 0.25;
    std::optional<double> maybe_real = 2.5;
    std::string text = "t";
    std::optional<std::string> maybe_text;
    Area area = Area::ring;
    std::optional<Area> maybe_area;
    std::array<double, 3> axis{1, 2, 3};
    std::optional<std::array<double, 3>> maybe_axis;
    std::vector<int> integers{1, 2};
    std::vector<double> reals{0.5};
    std::vector<std::string> strings{"a", "b"};
    Shape inner{"box", 2, false};
    std::optional<Shape> maybe_inner;
    std::vector<Shape> shapes{{"cone", 3, true}};
    StrategyConfig curvature{"implicit_fairing", ConfigNode::map({{"area", "ring"}})};
    StrategyConfig none;
    std::vector<StrategyConfig> observers{{"angular_defect", {}}};

    static void declare(ParamSchema<Everything>& s) {
        s.boolean("flag", &Everything::flag).doc("d");
        s.boolean("maybe_flag", &Everything::maybe_flag).doc("d");
        s.integer("small", &Everything::small).doc("d").advanced();
        s.integer("maybe_large", &Everything::maybe_large).doc("d");
        s.integer("count", &Everything::count).doc("d");
        s.real("real", &Everything::real).doc("d");
        s.real("maybe_real", &Everything::maybe_real).doc("d");
        s.string("text", &Everything::text).doc("d");
        s.string("maybe_text", &Everything::maybe_text).doc("d");
        s.choice("area", &Everything::area, {{"mixed", Area::mixed}, {"ring", Area::ring}})
            .doc("d");
        s.choice("maybe_area", &Everything::maybe_area,
                 {{"mixed", Area::mixed}, {"ring", Area::ring}})
            .doc("d");
        s.vec3("axis", &Everything::axis).doc("d");
        s.vec3("maybe_axis", &Everything::maybe_axis).doc("d");
        s.integers("integers", &Everything::integers).doc("d");
        s.reals("reals", &Everything::reals).doc("d");
        s.strings("strings", &Everything::strings).doc("d");
        s.object("inner", &Everything::inner, Shape::declare).doc("d");
        s.object("maybe_inner", &Everything::maybe_inner, Shape::declare).doc("d");
        s.list("shapes", &Everything::shapes, Shape::declare).doc("d");
        s.strategy("curvature", &Everything::curvature, "curvature").doc("d");
        s.strategy("none", &Everything::none, "curvature").optional().doc("d");
        s.strategies("observers", &Everything::observers, "curvature").doc("d");
    }
};

Everything read(const std::string& text) {
    return read_params<Everything>(parse(text), test::FakeLookup());
}

template <class T>
std::string declaration_fault(T declare) {
    ParamSchema<Shape> schema;
    declare(schema);
    try {
        schema.schema();
    } catch (const dsc::PluginError& error) {
        return error.what();
    }
    return "no error";
}

}  // namespace

TEST_CASE("defaults are those of the struct") {
    const Everything p = read("{}");
    CHECK(p.flag);
    CHECK_FALSE(p.maybe_flag);
    CHECK(p.small == 3);
    CHECK_FALSE(p.maybe_large);
    CHECK(p.count == 5);
    CHECK(p.real == 0.25);
    CHECK(p.maybe_real == 2.5);
    CHECK(p.text == "t");
    CHECK(p.area == Area::ring);
    CHECK_FALSE(p.maybe_area);
    CHECK(p.axis == std::array<double, 3>{1, 2, 3});
    CHECK(p.integers == std::vector<int>{1, 2});
    CHECK(p.strings == std::vector<std::string>{"a", "b"});
    CHECK(p.inner.shape == "box");
    CHECK(p.inner.radius == 2);
    CHECK_FALSE(p.maybe_inner);
    REQUIRE(p.shapes.size() == 1);
    CHECK(p.shapes[0].cut);
    CHECK(p.curvature.type == "implicit_fairing");
    CHECK(p.curvature.params == ConfigNode::map({{"area", "ring"}}));
    CHECK(p.none.empty());
    REQUIRE(p.observers.size() == 1);
    CHECK(p.observers[0].params == ConfigNode::map({{"per_area", false}}));
}

TEST_CASE("given values reach their members") {
    const Everything p = read(
        "flag: false\nmaybe_flag: true\nsmall: -7\nmaybe_large: 9223372036854775807\ncount: "
        "0\nreal: 1\n"
        "maybe_real: null\ntext: x\nmaybe_text: y\narea: mixed\nmaybe_area: ring\naxis: [4, 5.5, "
        "-6]\n"
        "maybe_axis: [0, 0, 1]\nintegers: []\nreals: [1, 2]\nstrings: [c]\ninner: {radius: 9}\n"
        "maybe_inner: {cut: true}\nshapes: [{shape: box}, {radius: 4}]\ncurvature: {type: "
        "angular_defect}\n"
        "none: {type: implicit_fairing, area: ring}\nobservers: []\n");
    CHECK_FALSE(p.flag);
    CHECK(p.maybe_flag == true);
    CHECK(p.small == -7);
    CHECK(p.maybe_large == 9223372036854775807);
    CHECK(p.count == 0);
    CHECK(p.real == 1.0);
    CHECK_FALSE(p.maybe_real);
    CHECK(p.text == "x");
    CHECK(p.maybe_text == "y");
    CHECK(p.area == Area::mixed);
    CHECK(p.maybe_area == Area::ring);
    CHECK(p.axis == std::array<double, 3>{4, 5.5, -6});
    CHECK(p.maybe_axis.value()[2] == 1);
    CHECK(p.integers.empty());
    CHECK(p.reals == std::vector<double>{1, 2});
    CHECK(p.strings == std::vector<std::string>{"c"});
    CHECK(p.inner.shape == "box");  // the default inside Everything, not that of Shape
    CHECK(p.inner.radius == 9);
    CHECK(p.maybe_inner.value().shape == "sphere");
    CHECK(p.maybe_inner->cut);
    REQUIRE(p.shapes.size() == 2);
    CHECK(p.shapes[1].radius == 4);
    CHECK(p.shapes[1].shape == "sphere");
    CHECK(p.curvature.type == "angular_defect");
    CHECK(p.curvature.params == ConfigNode::map({{"per_area", false}}));
    CHECK(p.none.params.at("area").as_string() == "ring");
    CHECK(p.observers.empty());
}

TEST_CASE("write is the inverse of read") {
    ParamSchema<Everything> schema;
    Everything::declare(schema);
    Everything value;
    value.maybe_area = Area::mixed;
    value.maybe_axis = std::array<double, 3>{7, 8, 9};
    value.maybe_inner = Shape{"x", 5, true};
    const ConfigNode node = schema.write(value);
    CHECK(schema.write(schema.read(node)) == node);
    CHECK(schema.read(node).maybe_axis == value.maybe_axis);
    Diagnostics diagnostics;
    validate(node, schema.schema(), test::FakeLookup(), diagnostics);
    CHECK_FALSE(diagnostics.has_errors());
}

TEST_CASE("read passes over keys that are no parameters and keeps what is missing") {
    ParamSchema<Shape> schema;
    Shape::declare(schema);
    const Shape shape = schema.read(ConfigNode::map({{"type", "grid"}, {"radius", 3}}));
    CHECK(shape.radius == 3);
    CHECK(shape.shape == "sphere");
}

TEST_CASE("defaults may come from another value than T{}") {
    ParamSchema<Shape> schema(Shape{"cone", 7, true});
    Shape::declare(schema);
    CHECK(schema.schema().find("radius")->default_value == ConfigNode(7.0));
    CHECK(schema.read(ConfigNode::map()).shape == "cone");
}

TEST_CASE("checks see the struct, and outlive the binder") {
    std::shared_ptr<const Schema> schema;
    {
        ParamSchema<Shape> binder;
        Shape::declare(binder);
        binder.check([](const Shape& s) { return s.shape != "point"; }, "a point has no radius");
        schema = binder.shared_schema();
    }
    Diagnostics diagnostics;
    validate(parse("shape: point\n"), *schema, NoStrategies(), diagnostics, "shape 'x'");
    CHECK(diagnostics.all().at(0).message == "shape 'x': a point has no radius");
    CHECK(diagnostics.error_count() == 1);
}

TEST_CASE("a strategy without default is required unless it is optional") {
    struct P {
        StrategyConfig curvature;
    };
    ParamSchema<P> schema;
    schema.strategy("curvature", &P::curvature, "curvature").doc("d");
    Diagnostics diagnostics;
    validate(ConfigNode::map(), schema.schema(), test::FakeLookup(), diagnostics);
    CHECK(diagnostics.all().at(0).code == "config.missing");
}

TEST_CASE("a required field has no default") {
    struct P {
        std::string file;
    };
    ParamSchema<P> schema;
    schema.file("file", &P::file).required().doc("The mesh.");
    CHECK(schema.schema().find("file")->default_value.is_null());
    Diagnostics diagnostics;
    validate(ConfigNode::map(), schema.schema(), NoStrategies(), diagnostics,
             "initial_mesh 'dsc_file'");
    CHECK(diagnostics.all().at(0).message == "'file' is missing in initial_mesh 'dsc_file'");
}

TEST_CASE("the declaration is kept for the documentation") {
    ParamSchema<Everything> schema;
    Everything::declare(schema);
    CHECK(schema.schema().fields().size() == 22);
    CHECK(schema.schema().find("small")->has_tag("advanced"));
    CHECK(schema.schema().find("shapes")->object->find("radius")->minimum->open);
    CHECK(schema.schema().find("area")->choices == std::vector<std::string>{"mixed", "ring"});
}

TEST_CASE("faulty declarations are refused") {
    using S = ParamSchema<Shape>;
    const std::string remedy = "; correct the declaration in the plugin";
    CHECK(declaration_fault([](S& s) { s.real("radius", &Shape::radius); }) ==
          "declaration of parameters: parameter 'radius' has no doc" + remedy);
    CHECK(declaration_fault([](S& s) { s.real("radius", &Shape::radius).range(2, 3).doc("d"); }) ==
          "declaration of parameters: parameter 'radius' has a bad default: 'radius': 1 is "
          "below the minimum 2" +
              remedy);
    CHECK(declaration_fault([](S& s) { s.string("shape", &Shape::shape).at_least(2).doc("d"); }) ==
          "declaration of parameters: parameter 'shape' has a range but is not a number" + remedy);
    CHECK(declaration_fault([](S& s) {
              s.real("radius", &Shape::radius).doc("d");
              s.boolean("radius", &Shape::cut).doc("d");
          }) == "declaration of parameters: parameter 'radius' is declared twice" + remedy);
    CHECK(declaration_fault([](S& s) { s.real("a b", &Shape::radius).doc("d"); }) ==
          "declaration of parameters: parameter 'a b' has a name that is not an identifier" +
              remedy);
    CHECK(declaration_fault([](S& s) {
              s.choice("shape", &Shape::shape, {{"a", "b"}}).doc("d");
          }) == "declaration of parameters: parameter 'shape' has a bad default: 'shape' "
                "must be a string, not an empty value" +
                    remedy);
    CHECK(declaration_fault([](S& s) { s.deprecated("old", "new"); }) ==
          "declaration of parameters: 'old' is an old name of 'new', which is not a "
          "parameter" +
              remedy);
    CHECK(declaration_fault([](S& s) { s.check([](const Shape&) { return true; }, ""); }) ==
          "declaration of parameters: a cross check has no message" + remedy);
}

TEST_CASE("a strategy must not call a parameter 'type'") {
    ParamSchema<Shape> schema;
    schema.string("type", &Shape::shape).doc("d");
    CHECK(schema.schema().problems().empty());
    CHECK(schema.schema().problems(true) ==
          std::vector<std::string>{
              "parameter 'type' has the name 'type', which selects the strategy"});
}
