// What strategies throw or return wrongly, kind by kind.
#include <functional>
#include <limits>
#include <sstream>

#include <doctest/doctest.h>

#include <dsc/base/error.hpp>
#include <dsc/base/random.hpp>
#include <dsc/plugin/guarded.hpp>

#include "fake_catalogue.hpp"

namespace {

using dsc::Vec3;
namespace hooks = dsc::hooks;
namespace mesh = dsc::mesh;
namespace repair = dsc::repair;

constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

// Each test says what its strategy does.
template <class... Arguments>
struct Behaviour {
    static inline std::function<void(Arguments...)> act;
};

template <class Hook>
struct Base : Hook {
    struct Params {};
    static void declare(dsc::config::ParamSchema<Params>&) {}
};

struct Velocity final : Base<hooks::VelocityField> {
    using Act = Behaviour<hooks::Range, std::span<Vec3>>;
    Velocity(const Params&, const dsc::plugin::Setup&) {}
    void prepare(const hooks::StepContext&) override {}
    void evaluate(hooks::Range range, std::span<Vec3> out) const override { Act::act(range, out); }
    void save(std::ostream&) const override { throw std::runtime_error("disk full"); }
    static inline hooks::Attributes attributes;
    void publish(hooks::Attributes& out) const override { out = attributes; }
    void advance(const hooks::StepContext& context) override {
        if (context.step == 13) throw std::runtime_error("unlucky");
    }
};

struct Sampled final : Base<hooks::VelocityField> {
    using Act = Behaviour<std::span<const Vec3>, std::span<Vec3>>;
    Sampled(const Params&, const dsc::plugin::Setup&) {}
    void prepare(const hooks::StepContext&) override {}
    void evaluate(hooks::Range, std::span<Vec3>) const override {}
    bool can_sample() const override { return true; }
    void sample(std::span<const Vec3> points, std::span<const Vec3>,
                std::span<Vec3> out) const override {
        Act::act(points, out);
    }
};

struct Curvature final : Base<hooks::CurvatureEstimator> {
    using Act = Behaviour<std::span<double>, std::span<Vec3>>;
    Curvature(const Params&, const dsc::plugin::Setup&) {}
    void prepare(const hooks::StepContext&) override {}
    void evaluate(hooks::Range, std::span<double> scalar, std::span<Vec3> vector) const override {
        Act::act(scalar, vector);
    }
};

struct Filter final : Base<hooks::CloudFilter> {
    using Act = Behaviour<dsc::cloud::Filtered&, const hooks::FilterContext&>;
    Filter(const Params&, const dsc::plugin::Setup&) {}
    // Without a fault: the cloud as it is.
    dsc::cloud::Filtered apply(const dsc::cloud::Cloud& cloud,
                               const hooks::FilterContext& context) override {
        dsc::cloud::Filtered result{cloud, {}};
        result.report.kept = cloud.points.size();
        Act::act(result, context);
        return result;
    }
};

struct Refinement final : Base<hooks::RefinementPolicy> {
    using Act = Behaviour<hooks::RefinementRequests&>;
    Refinement(const Params&, const dsc::plugin::Setup&) {}
    void refine(const hooks::RefinementContext&, hooks::RefinementRequests& out) override {
        Act::act(out);
    }
};

struct InitialMesh final : Base<hooks::InitialMesh> {
    using Act = Behaviour<mesh::TetMesh&>;
    InitialMesh(const Params&, const dsc::plugin::Setup&) {}
    mesh::TetMesh build(const hooks::InitialMeshContext&) override {
        mesh::TetMesh one{
            {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)}, {{0, 1, 2, 3}}, {1}};
        Act::act(one);
        return one;
    }
    static inline hooks::Figures told;
    hooks::Figures figures() const override { return told; }
};

struct Improvement final : Base<hooks::Improvement> {
    using Act = Behaviour<std::vector<repair::Request>&>;
    using Select = Behaviour<std::span<std::uint8_t>>;
    static inline double cosine = 0.99;
    static inline repair::TopologyLimits limits;
    static inline std::vector<std::string> classes;
    Improvement(const Params&, const dsc::plugin::Setup&) {}
    void propose(const hooks::StepContext&, const repair::RepairRound&,
                 std::vector<repair::Request>& out) override {
        Act::act(out);
    }
    double flatness() const override { return cosine; }
    repair::TopologyLimits topology_limits() const override { return limits; }
    std::vector<std::string> repair_classes() const override { return classes; }
    void select(const hooks::StepContext&, std::span<const repair::TopologyCandidate>,
                std::span<std::uint8_t> accept) override {
        Select::act(accept);
    }
};

struct Observer final : Base<hooks::Observer> {
    using Act = Behaviour<hooks::Figures&>;
    Observer(const Params&, const dsc::plugin::Setup&) {}
    void begin(const hooks::StepContext&) override {}
    hooks::Figures step(const hooks::StepContext&, const hooks::StepFigures&) override {
        return figures();
    }
    hooks::Figures end(const hooks::StepContext&) override { return figures(); }
    static hooks::Figures figures() {
        hooks::Figures result;
        Act::act(result);
        return result;
    }
};

// A velocity that calls the curvature `faulty` and lets its fault pass.
struct Nesting final : Base<hooks::VelocityField> {
    Nesting(const Params&, const dsc::plugin::Setup& setup)
        : inner(setup.create<hooks::CurvatureEstimator>("curvature", {"faulty", {}})) {}
    void prepare(const hooks::StepContext& context) override { inner->prepare(context); }
    void evaluate(hooks::Range range, std::span<Vec3> out) const override {
        std::vector<double> scalar(out.size());
        inner->evaluate(range, scalar, out);
    }
    std::unique_ptr<hooks::CurvatureEstimator> inner;
};

struct Bench {
    Bench() {
        catalogue.add<Velocity>("faulty", "a velocity");
        catalogue.add<Sampled>("sampled", "a velocity");
        catalogue.add<Nesting>("nesting", "a velocity");
        catalogue.add<Curvature>("faulty", "a curvature");
        catalogue.add<Refinement>("faulty", "a refinement");
        catalogue.add<InitialMesh>("faulty", "an initial mesh");
        catalogue.add<Improvement>("faulty", "an improvement");
        catalogue.add<Observer>("faulty", "an observer");
        catalogue.add<Filter>("faulty", "a filter");
        view.vertex_ids = {0, 1, 2, 3};
        view.births = {10, 11, 12, 13};
        view.positions = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)};
        view.faces = {{0, 1, 2}, {0, 1, 3}};
    }
    template <class Hook>
    std::unique_ptr<Hook> make(const char* id = "faulty") const {
        return catalogue.create<Hook>({id, {}}, "here");
    }
    hooks::StepContext context() const {
        return {.step = 5, .surface = view, .box = {}, .to_normalised = {}};
    }

    FakeCatalogue catalogue;
    dsc::surface::SurfaceView view;
};

struct Caught {
    std::string code;
    std::string text;
};
template <class Body>
Caught caught(Body&& body) {
    try {
        body();
    } catch (const dsc::StrategyError& error) {
        return {error.code(), error.what()};
    }
    return {};
}

std::string who(const std::string& kind, const std::string& id = "faulty",
                const std::string& path = "here") {
    return kind + " '" + id + "' (plugin fake 0.1.0, libdsc_fake.so, at '" + path +
           "' in the experiment): ";
}
const std::string report = "; report this to the plugin's authors";

}  // namespace

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
          who("velocity") + "save threw: disk full" + check);
    const std::vector<Vec3> points(1);
    CHECK_FALSE(velocity->can_sample());
    CHECK(caught([&] {
              velocity->sample(points, points, out);
          }).text.find("strategy.no_sampling") != std::string::npos);
}

TEST_CASE("velocity: samples are judged too") {
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

TEST_CASE("attributes: names, sizes and values are judged, of velocities and of refinements") {
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

TEST_CASE("initial mesh: arrays that do not fit together") {
    const Bench bench;
    const auto generator = bench.make<hooks::InitialMesh>();
    const auto build = [&](const std::function<void(mesh::TetMesh&)>& act) {
        InitialMesh::Act::act = act;
        return caught([&] { generator->build({}); });
    };
    CHECK(build([](mesh::TetMesh&) {}).text.empty());
    CHECK(build([](mesh::TetMesh& m) { m.tets.clear(); }).text ==
          who("initial_mesh") + "build gave a mesh without tets" + report);
    CHECK(build([](mesh::TetMesh& m) { m.labels.push_back(0); }).text ==
          who("initial_mesh") + "build gave 2 labels for 1 tets" + report);
    CHECK(build([](mesh::TetMesh& m) { m.points[2].x() = no_number; }).text ==
          who("initial_mesh") + "build gave point 2 a coordinate that is not finite" + report);
    CHECK(build([](mesh::TetMesh& m) { m.tets[0][3] = 4; }).text ==
          who("initial_mesh") + "build gave tet 0 the point 4 of 4" + report);
    CHECK(build([](mesh::TetMesh& m) { m.labels[0] = -1; }).text ==
          who("initial_mesh") + "build gave tet 0 the label -1 below 0" + report);

    // What is wrong with the user's file is not the generator's fault.
    InitialMesh::Act::act = [](mesh::TetMesh&) {
        throw dsc::IoError("io.open", "a.dsc: cannot be read");
    };
    CHECK_THROWS_WITH_AS(generator->build({}), "a.dsc: cannot be read", dsc::IoError);
}

TEST_CASE("improvement: classes of requests have good names, and a request names one of them") {
    const Bench bench;
    const mesh::Complex complex;
    const repair::RepairRound round{complex, {}, {}, {}, {}, 0.1, 0.99, 0, false};
    const auto propose = [&](unsigned repair_class) {
        const auto improvement = bench.make<hooks::Improvement>();
        Improvement::Act::act = [&](std::vector<repair::Request>& out) {
            out.emplace_back().repair_class = static_cast<std::uint8_t>(repair_class);
        };
        std::vector<repair::Request> out;
        return caught([&] { improvement->propose(bench.context(), round, out); });
    };
    const auto naming = [&](std::vector<std::string> names) {
        Improvement::classes = std::move(names);
        const Caught fault = caught([&] { bench.make<hooks::Improvement>()->repair_classes(); });
        Improvement::classes.clear();
        return fault;
    };
    // Without names there is one class.
    CHECK(propose(0).text.empty());
    CHECK(propose(1).text ==
          who("improvement") +
              "propose at step 5 named the class 1, which does not exist, in request 0" + report);
    Improvement::classes = {"wedge", "tee"};
    CHECK(propose(1).text.empty());
    CHECK(propose(2).code == "strategy.range");
    CHECK(naming({"wedge", "tee_2"}).text.empty());
    CHECK(naming({"wedge", "Tee"}).text == who("improvement") +
                                               "repair_classes gave a class of requests the name "
                                               "'Tee'; names are snake_case and differ" +
                                               report);
    CHECK(naming({"tee", "wedge", "tee"}).code == "strategy.range");
    CHECK(naming({""}).code == "strategy.range");
    CHECK(naming(std::vector<std::string>(17, "a")).code == "strategy.size");
}

TEST_CASE("improvement: requests, limits and answers out of range") {
    const Bench bench;
    const auto improvement = bench.make<hooks::Improvement>();
    const mesh::Complex complex;
    const repair::RepairRound round{complex, {}, {}, {}, {}, 0.1, 0.99, 0, false};
    const auto propose = [&](const repair::Request& request) {
        Improvement::Act::act = [&](std::vector<repair::Request>& out) { out.push_back(request); };
        std::vector<repair::Request> out;
        return caught([&] { improvement->propose(bench.context(), round, out); });
    };
    CHECK(propose({}).text.empty());
    repair::Request request;
    request.tet = 3;
    CHECK(propose(request).text ==
          who("improvement") + "propose at step 5 named tet 3, which does not exist, in request 0" +
              report);
    request = {};
    request.vertices[1] = 8;
    CHECK(propose(request).text ==
          who("improvement") +
              "propose at step 5 named vertex 8, which does not exist, in request 0" + report);
    request = {};
    request.operation = static_cast<repair::Operation>(200);
    CHECK(propose(request).code == "strategy.range");
    request = {};
    for (float repair::Request::*number :
         {&repair::Request::accept_above, &repair::Request::gain, &repair::Request::least_edge}) {
        request = {};
        request.*number = std::numeric_limits<float>::quiet_NaN();
        CHECK(propose(request).code == "strategy.not_finite");
    }
    Improvement::Act::act = [](std::vector<repair::Request>& out) { out.clear(); };
    std::vector<repair::Request> earlier(2);
    CHECK(caught([&] { improvement->propose(bench.context(), round, earlier); }).code ==
          "strategy.size");

    const std::vector<repair::TopologyCandidate> candidates(2);
    std::vector<std::uint8_t> accept(2);
    Improvement::Select::act = [](std::span<std::uint8_t> a) { a[0] = 1; };
    CHECK(caught([&] { improvement->select(bench.context(), candidates, accept); }).text ==
          who("improvement") +
              "select at step 5 gave candidate 1 the answer 255 instead of 0 or 1" + report);
    Improvement::Select::act = [](std::span<std::uint8_t> a) { a[0] = 1, a[1] = 0; };
    CHECK(caught([&] { improvement->select(bench.context(), candidates, accept); }).text.empty());

    Improvement::cosine = 1.5;
    CHECK(caught([&] { improvement->flatness(); }).code == "strategy.range");
    Improvement::cosine = 0.99;
    CHECK(improvement->flatness() == 0.99);
    Improvement::limits.thickness = no_number;
    CHECK(caught([&] { improvement->topology_limits(); }).code == "strategy.range");
    Improvement::limits = {};
    CHECK(improvement->topology_limits().thickness == 1.0);
}

TEST_CASE("initial mesh: figures of bad or repeated names and without a value") {
    const Bench bench;
    const auto mesh = bench.make<hooks::InitialMesh>();
    const auto told = [&](const hooks::Figures& figures) {
        InitialMesh::told = figures;
        return caught([&] { mesh->figures(); });
    };
    CHECK(told({}).text.empty());
    CHECK(told({{"distance", 1.0}, {"relabelled", 2.0}}).text.empty());
    CHECK(mesh->figures().size() == 2);
    CHECK(told({{"Distance", 1.0}}).code == "strategy.range");
    CHECK(told({{"a", 1.0}, {"a", 2.0}}).code == "strategy.range");
    CHECK(told({{"a", no_number}}).code == "strategy.not_finite");
}

TEST_CASE("observer: figures of changing, bad or repeated names and without a value") {
    const Bench bench;
    const auto step = [&](hooks::Observer& observer, const hooks::Figures& figures) {
        Observer::Act::act = [&](hooks::Figures& out) { out = figures; };
        return caught([&] { observer.step(bench.context(), {}); });
    };
    const auto observer = bench.make<hooks::Observer>();
    CHECK(step(*observer, {{"error_max", 1.0}}).text.empty());
    CHECK(step(*observer, {{"error_max", 2.0}}).text.empty());
    CHECK(step(*observer, {{"error_mean", 2.0}}).code == "strategy.size");
    CHECK(step(*bench.make<hooks::Observer>(), {{"Error max", 1.0}}).text ==
          who("observer") + "step at step 5 gave a figure the name 'Error max'; names are "
                            "snake_case and differ; report this to the plugin's authors");
    CHECK(step(*bench.make<hooks::Observer>(), {{"a", 1.0}, {"a", 2.0}}).code == "strategy.range");
    CHECK(step(*bench.make<hooks::Observer>(), {{"a", no_number}}).code == "strategy.not_finite");
}

namespace {

dsc::cloud::Cloud three_points() {
    dsc::cloud::Cloud cloud;
    cloud.points = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)};
    cloud.source = "a.xyz";
    return cloud;
}

using Filtered = dsc::cloud::Filtered;

void drop_last(Filtered& f) {
    f.cloud.points.pop_back();
    f.report.kept = 2;
    f.report.removed = 1;
}

}  // namespace

TEST_CASE("filter: attributes that do not fit the points or are out of range") {
    const Bench bench;
    const auto filter = bench.make<hooks::CloudFilter>();
    const auto apply = [&](const std::function<void(Filtered&)>& act) {
        Filter::Act::act = [&](Filtered& result, const hooks::FilterContext&) { act(result); };
        return caught([&] { filter->apply(three_points(), {}); });
    };
    const std::string gave = who("filter") + "apply gave ";
    const std::string sizes = "; an attribute is empty or has one entry per point" + report;
    CHECK(apply([](Filtered&) {}).text.empty());
    CHECK(apply([](Filtered& f) { f.cloud.points.clear(); }).text ==
          gave + "a cloud without points; at least one point must be left; relax its parameters or "
                 "leave it out");
    CHECK(apply([](Filtered& f) { f.cloud.colours.resize(2); }).text ==
          gave + "2 colours for 3 points" + sizes);
    CHECK(apply([](Filtered& f) { f.cloud.normals.assign(4, Vec3::UnitX()); }).text ==
          gave + "4 normals for 3 points" + sizes);
    CHECK(apply([](Filtered& f) { f.cloud.areas.assign(1, Vec3::UnitX()); }).text ==
          gave + "1 areas for 3 points" + sizes);
    CHECK(apply([](Filtered& f) { f.cloud.confidence.assign(5, 0.5); }).text ==
          gave + "5 confidences for 3 points" + sizes);
    CHECK(apply([](Filtered& f) { f.cloud.points[1].z() = no_number; }).text ==
          gave + "point 1 a coordinate that is not finite" + report);
    CHECK(apply([](Filtered& f) { f.cloud.areas.assign(3, Vec3::Constant(no_number)); }).code ==
          "strategy.not_finite");
    CHECK(apply([](Filtered& f) {
              f.cloud.normals = {Vec3::UnitX(), Vec3(0, 0, 0.5), Vec3::UnitX()};
          }).text ==
          gave + "normal 1 the length 0.5; normals are unit vectors, or zero if they are unknown" +
              report);
    CHECK(apply([](Filtered& f) { f.cloud.normals.assign(3, Vec3(0, 0, 1 + 1e-8)); }).text.empty());
    CHECK(apply([](Filtered& f) { f.cloud.confidence = {0, 1, 1.5}; }).code == "strategy.range");
    CHECK(apply([](Filtered& f) {
              f.cloud.confidence = {0, no_number, 1};
          }).code == "strategy.range");
    CHECK(apply([](Filtered& f) { f.cloud.confidence = {0, 0.5, 1}; }).text.empty());
    const auto sample = [&](const dsc::cloud::SurfaceSample& s) {
        return apply([&](Filtered& f) { f.cloud.orientation.samples = {s}; }).code;
    };
    CHECK(sample({Vec3::Zero(), Vec3::UnitZ(), 1.0}).empty());
    CHECK(sample({Vec3::Zero(), Vec3::Constant(no_number), 1.0}) == "strategy.not_finite");
    CHECK(sample({Vec3::Zero(), Vec3::UnitZ(), -1.0}) == "strategy.range");
    CHECK(apply([](Filtered& f) { f.cloud.orientation.residual = no_number; }).code ==
          "strategy.range");

    // What is wrong with the user's cloud is not the filter's fault.
    Filter::Act::act = [](Filtered&, const hooks::FilterContext&) {
        throw dsc::GeometryError("cloud.filtered_out", "a.xyz: no point is left");
    };
    CHECK_THROWS_WITH_AS(filter->apply(three_points(), {}), "a.xyz: no point is left",
                         dsc::GeometryError);
}

TEST_CASE("filter: a report that does not count what happened") {
    const Bench bench;
    const auto filter = bench.make<hooks::CloudFilter>();
    const auto apply = [&](const std::function<void(Filtered&)>& act) {
        Filter::Act::act = [&](Filtered& result, const hooks::FilterContext&) {
            drop_last(result);
            act(result);
        };
        return caught([&] { filter->apply(three_points(), {}); });
    };
    CHECK(apply([](Filtered&) {}).text.empty());
    CHECK(apply([](Filtered& f) { f.report.kept = 3; }).text ==
          who("filter") +
              "apply reported 3 points as kept and 1 as removed, but was given 3 and returned 2; a "
              "filter adds no points, and kept and removed points together are the given points" +
              report);
    CHECK(apply([](Filtered& f) { f.report.removed = 0; }).code == "strategy.size");
    CHECK(apply([](Filtered& f) {
              f.report.removed = std::numeric_limits<std::size_t>::max();
          }).code == "strategy.size");
    CHECK(apply([](Filtered& f) { f.report.reasons = {{"far", 1}, {"near", 0}}; }).text.empty());
    CHECK(apply([](Filtered& f) {
              f.report.reasons = {{"far", 1}, {"near", 1}};
          }).text == who("filter") +
                         "apply gave reasons whose counts do not add up to the 1 removed point" +
                         report);
    CHECK(apply([](Filtered& f) { f.report.reasons = {{"far", 0}}; }).code == "strategy.size");
    CHECK(apply([](Filtered& f) { f.report.reasons = {{"", 1}}; }).code == "strategy.range");
    CHECK(apply([](Filtered& f) { f.report.figures = {{"Width", 1.0}}; }).code == "strategy.range");
    CHECK(apply([](Filtered& f) {
              f.report.figures = {{"width", no_number}};
          }).code == "strategy.not_finite");
}

TEST_CASE("filter: it has its own instance number, its name stands in the report, and a stale "
          "orientation goes") {
    const Bench bench;
    const auto filter = bench.make<hooks::CloudFilter>();
    std::uint64_t instance = 0;
    dsc::cloud::Cloud cloud = three_points();
    cloud.orientation.samples = {{Vec3::Zero(), Vec3::UnitZ(), 1.0}};
    const auto apply = [&](const std::function<void(Filtered&)>& act) {
        Filter::Act::act = [&](Filtered& result, const hooks::FilterContext& context) {
            instance = context.instance;
            result.cloud.source = "elsewhere";
            act(result);
        };
        return filter->apply(cloud, {});
    };
    const Filtered same = apply([](Filtered&) {});
    CHECK(instance == dsc::stream_id("here"));
    CHECK(same.report.filter == "faulty");
    CHECK(same.cloud.source == "a.xyz");
    CHECK(same.cloud.orientation.samples.size() == 1);
    CHECK(apply(drop_last).cloud.orientation.empty());
    CHECK(apply([](Filtered& f) { f.cloud.points[0].x() = 7; }).cloud.orientation.empty());
    // A new one is its own affair.
    CHECK_FALSE(apply([](Filtered& f) {
                    drop_last(f);
                    f.cloud.orientation.samples[0].width = 2.0;
                }).cloud.orientation.empty());
}
