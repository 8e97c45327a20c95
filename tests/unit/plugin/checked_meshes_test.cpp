// What initial meshes, improvements, observers and filters throw or return wrongly.
#include <doctest/doctest.h>

#include "faulty_strategies.hpp"

using namespace faulty;

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

TEST_CASE("filter: it has its own instance number, its name is in the report, and a stale "
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
