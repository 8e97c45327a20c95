// What velocities, curvatures and refinements throw or return wrongly.
#include <doctest/doctest.h>

#include "faulty_strategies.hpp"

using namespace faulty;

TEST_CASE("velocity: not a number, infinity, an entry left out") {
    const Bench bench;
    const auto velocity = bench.make<hooks::VelocityField>();
    velocity->prepare(bench.context());
    std::vector<Vec3> out(3);
    const auto evaluate = [&] { velocity->evaluate({1, 4}, out); };
    const std::string every = "; every entry of the output must be written with a finite number; "
                              "report this to the plugin's authors";

    Velocity::Act::act = [](hooks::Range, std::span<Vec3> o) {
        for (Vec3& d : o) d = Vec3(1, 2, 3);
        o[2].y() = -std::numeric_limits<double>::infinity();
    };
    CHECK(caught(evaluate).text == who("velocity") +
                                       "evaluate at step 5 gave the displacement (1.0, -inf, 3.0) "
                                       "to vertex 3 (birth id 13, at (0.0, 0.0, 1.0))" +
                                       every);
    CHECK(caught(evaluate).code == "strategy.not_finite");
    Velocity::Act::act = [](hooks::Range, std::span<Vec3> o) { o[0] = o[2] = Vec3::Zero(); };
    CHECK(caught(evaluate).text.find(
              "gave the displacement (nan, nan, nan) to vertex 2 (birth id 12") !=
          std::string::npos);
    Velocity::Act::act = [](hooks::Range, std::span<Vec3> o) {
        std::fill(o.begin(), o.end(), Vec3::Zero());
    };
    CHECK(caught(evaluate).text.empty());
}

TEST_CASE("whatever is thrown is attributed, but not cancellation and configuration") {
    const Bench bench;
    const auto velocity = bench.make<hooks::VelocityField>();
    velocity->prepare(bench.context());
    std::vector<Vec3> out(1);
    const auto evaluate = [&] { velocity->evaluate({0, 1}, out); };
    const std::string check = "; check its parameters or report this to the plugin's authors";

    Velocity::Act::act = [](hooks::Range, std::span<Vec3>) { throw std::out_of_range("index 9"); };
    CHECK(caught(evaluate).text == who("velocity") + "evaluate at step 5 threw: index 9" + check);
    CHECK(caught(evaluate).code == "strategy.threw");
    Velocity::Act::act = [](hooks::Range, std::span<Vec3>) { throw 7; };
    CHECK(caught(evaluate).text ==
          who("velocity") + "evaluate at step 5 threw something that is not a std::exception" +
              check);
    Velocity::Act::act = [](hooks::Range, std::span<Vec3>) {
        throw dsc::GeometryError("geometry.flat", "all is flat");
    };
    CHECK(caught(evaluate).text ==
          who("velocity") + "evaluate at step 5 threw geometry.flat: all is flat" + check);
    Velocity::Act::act = [](hooks::Range, std::span<Vec3>) { throw dsc::CancelledError("stop"); };
    CHECK_THROWS_WITH_AS(evaluate(), "stop", dsc::CancelledError);
    Velocity::Act::act = [](hooks::Range, std::span<Vec3>) {
        throw dsc::ConfigError("x", "no cloud");
    };
    CHECK_THROWS_WITH_AS(evaluate(), "no cloud", dsc::ConfigError);

    std::ostringstream state;
    CHECK(caught([&] { velocity->save(state); }).text ==
          who("velocity") + "save at step 5 threw: disk full" + check);
    const std::vector<Vec3> points(1);
    CHECK_FALSE(velocity->can_sample());
    CHECK(caught([&] {
              velocity->sample(points, points, out);
          }).text.find("strategy.no_sampling") != std::string::npos);
}

TEST_CASE("velocity: samples are checked too") {
    const Bench bench;
    const auto velocity = bench.make<hooks::VelocityField>("sampled");
    velocity->prepare(bench.context());
    const std::vector<Vec3> points = {Vec3(0, 0, 0), Vec3(0.5, 0, 0)};
    std::vector<Vec3> out(2);
    Sampled::Act::act = [](std::span<const Vec3>, std::span<Vec3> o) { o[0] = Vec3::Zero(); };
    const Caught fault = caught([&] { velocity->sample(points, points, out); });
    CHECK(fault.code == "strategy.not_finite");
    CHECK(fault.text.find("sample at step 5 gave the displacement (nan, nan, nan) to point 1 at "
                          "(0.5, 0.0, 0.0)") != std::string::npos);
}

TEST_CASE("curvature: scalar and vector must both be finite") {
    const Bench bench;
    const auto curvature = bench.make<hooks::CurvatureEstimator>();
    curvature->prepare(bench.context());
    std::vector<double> scalar(2);
    std::vector<Vec3> vector(2);
    Curvature::Act::act = [](std::span<double> s, std::span<Vec3> v) {
        s[0] = s[1] = 1;
        v[0] = Vec3::Zero();
        v[1] = Vec3(0, no_number, 0);
    };
    const Caught fault = caught([&] { curvature->evaluate({2, 4}, scalar, vector); });
    CHECK(fault.text.find(who("curvature") + "evaluate at step 5 gave the curvature 1.0 and the "
                                             "vector (0.0, nan, 0.0) to vertex 3 (birth id 13") ==
          0);
}

TEST_CASE("the fault of a nested strategy stays its own") {
    const Bench bench;
    const auto velocity = bench.make<hooks::VelocityField>("nesting");
    velocity->prepare(bench.context());
    std::vector<Vec3> out(1);
    Curvature::Act::act = [](std::span<double>, std::span<Vec3>) {
        throw std::runtime_error("oops");
    };
    CHECK(caught([&] {
              velocity->evaluate({0, 1}, out);
          }).text == who("curvature", "faulty", "here.curvature") +
                         "evaluate at step 5 threw: oops; check its parameters or report this to "
                         "the plugin's authors");
}

TEST_CASE("refinement: faces, edges, sizes and labels that do not exist") {
    const Bench bench;
    const auto policy = bench.make<hooks::RefinementPolicy>();
    const hooks::StepContext step = bench.context();
    const auto refine = [&](const std::function<void(hooks::RefinementRequests&)>& act) {
        Refinement::Act::act = act;
        hooks::RefinementRequests out;
        return caught([&] { policy->refine({step}, out); });
    };
    CHECK(refine([](auto& r) {
              r.split_faces = {0, 1, 2};
          }).text == who("refinement") +
                         "refine at step 5 asked in split_faces 2 for 2, which does not exist" +
                         report);
    CHECK(refine([](auto& r) {
              r.split_edges = {{0, 4}};
          }).text == who("refinement") +
                         "refine at step 5 asked in split_edges 0 for 4, which does not exist" +
                         report);
    CHECK(refine([](auto& r) {
              r.sizing = {1, 1};
          }).text == who("refinement") +
                         "refine at step 5 gave a sizing field of 2 entries for 4 vertices" +
                         report);
    CHECK(refine([](auto& r) { r.sizing = {1, 1, 0, 1}; }).code == "strategy.not_finite");
    CHECK(refine([](auto& r) { r.sizing = {1, 1, no_number, 1}; }).code == "strategy.not_finite");
    CHECK(refine([](auto& r) { r.relabel = {{0, 0x80000000U}}; }).code == "strategy.range");
    CHECK(refine([](auto& r) {
              r.split_faces = {1};
              r.split_edges = {{0, 3}};
              r.sizing = {1, 1, 1, 1};
              r.relabel = {{0, 2}};
          }).text.empty());
}

TEST_CASE("refinement: collapses, flips, moves and target lengths that cannot be") {
    const Bench bench;
    const auto policy = bench.make<hooks::RefinementPolicy>();
    const hooks::StepContext step = bench.context();
    const auto refine = [&](const std::function<void(hooks::RefinementRequests&)>& act) {
        Refinement::Act::act = act;
        hooks::RefinementRequests out;
        return caught([&] { policy->refine({step}, out); });
    };
    CHECK(refine([](auto& r) {
              r.collapse_edges = {{0, 4, Vec3::Zero()}};
          }).text == who("refinement") +
                         "refine at step 5 asked in collapse_edges 0 for 4, which does not exist" +
                         report);
    CHECK(refine([](auto& r) {
              r.collapse_edges = {{0, 1, Vec3(0, no_number, 0)}};
          }).code == "strategy.not_finite");
    CHECK(refine([](auto& r) {
              r.flip_edges = {{{0, 1}, 0.9}, {{5, 1}, 0.9}};
          }).text == who("refinement") +
                         "refine at step 5 asked in flip_edges 1 for 5, which does not exist" +
                         report);
    CHECK(refine([](auto& r) {
              r.flip_edges = {{{0, 1}, no_number}};
          }).code == "strategy.not_finite");
    CHECK(refine([](auto& r) { r.move_vertices = {{7, Vec3::Zero()}}; }).code == "strategy.range");
    CHECK(refine([](auto& r) {
              r.move_vertices = {{1, Vec3(no_number, 0, 0)}};
          }).code == "strategy.not_finite");
    CHECK(refine([](auto& r) {
              r.target_lengths = {1, 1, 1};
          }).text == who("refinement") +
                         "refine at step 5 gave a sizing field of 3 entries for 4 vertices" +
                         report);
    CHECK(refine([](auto& r) { r.target_lengths = {1, 1, 1, -1}; }).code == "strategy.not_finite");
    CHECK(refine([](auto& r) { r.target_length = -0.5; }).code == "strategy.not_finite");
    CHECK(refine([](auto& r) {
              r.target_length = 1;
              r.target_lengths = {1, 1, 1, 1};
          }).code == "strategy.size");
    CHECK(refine([](auto& r) {
              r.collapse_edges = {{0, 3, Vec3::Zero()}};
              r.flip_edges = {{{0, 1}, 0.9}};
              r.move_vertices = {{1, Vec3::Zero()}};
              r.target_lengths = {1, 1, 1, 1};
              r.attributes = {{"density", {0, -1, 2, 3}}};
          }).text.empty());
    CHECK(policy->passes() == 1);
    CHECK_FALSE(policy->owns_sizing());
}

TEST_CASE("attributes: names, sizes and values of velocities and refinements are checked") {
    const Bench bench;
    const auto velocity = bench.make<hooks::VelocityField>();
    velocity->prepare(bench.context());
    const auto publish = [&](hooks::Attributes attributes) {
        Velocity::attributes = std::move(attributes);
        hooks::Attributes out;
        return caught([&] { velocity->publish(out); });
    };
    CHECK(publish({{"density", {1, 2, 3, 4}}, {"age", {1, 2, 3, 4}}}).text.empty());
    CHECK(publish({{"density", {1, 2, 3}}}).text ==
          who("velocity") +
              "publish at step 5 gave the attribute 'density' 3 values for 4 vertices" + report);
    CHECK(publish({{"density", {1, 2, 3, std::numeric_limits<double>::infinity()}}}).text ==
          who("velocity") +
              "publish at step 5 gave the attribute 'density' the value inf at vertex 3" + report);
    for (const char* name : {"", "Density", "two words", "x", "red", "label"}) {
        CAPTURE(name);
        CHECK(publish({{name, {1, 2, 3, 4}}}).code == "strategy.range");
    }
    CHECK(publish({{"age", {1, 2, 3, 4}}, {"age", {1, 2, 3, 4}}}).code == "strategy.range");
    const auto policy = bench.make<hooks::RefinementPolicy>();
    Refinement::Act::act = [](hooks::RefinementRequests& r) {
        r.attributes = {{"density", {no_number, 0, 0, 0}}};
    };
    hooks::RefinementRequests out;
    const hooks::StepContext step = bench.context();
    CHECK(caught([&] { policy->refine({step}, out); }).code == "strategy.not_finite");
}

TEST_CASE("velocity: what advance() throws is attributed to it") {
    const Bench bench;
    const auto velocity = bench.make<hooks::VelocityField>();
    hooks::StepContext context = bench.context();
    context.step = 13;
    CHECK(caught([&] { velocity->advance(context); }).text ==
          who("velocity") + "advance at step 13 threw: unlucky; check its parameters or report "
                            "this to the plugin's authors");
}
