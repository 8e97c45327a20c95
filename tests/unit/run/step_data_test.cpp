// What strategies can see: the history of the vertices, the support, the labelled volume.
#include <cmath>
#include <map>
#include <set>

#include <doctest/doctest.h>

#include <dsc/hooks/support.hpp>
#include <dsc/run/simulation.hpp>

#include "fakes.hpp"
#include "run/vertex_history.hpp"

using namespace dsc;
using dsc::test::load_text;
using dsc::test::minimal;
using surface::SurfaceView;

namespace {

/// What a context said about a vertex.
struct Seen {
    Vec3 position, previous;
    int arrived;
    std::uint32_t age;
};
using Vertices = std::map<std::uint32_t, Seen>;  // by birth

Vertices seen_in(const SurfaceView& view) {
    Vertices all;
    for (std::size_t v = 0; v < view.vertex_count(); ++v)
        all[view.births[v]] = {view.positions[v], view.previous_positions[v], view.arrived[v],
                               view.age[v]};
    return all;
}

/// What the velocity was told and what it asked for.
struct Record {
    std::vector<std::pair<std::uint64_t, Vertices>> calls;  // with their steps
    std::map<std::uint32_t, Vec3> wanted;                   // destinations of the last step
};

/// Moves outwards; every seventh vertex is sent through the others, so that it cannot arrive. Half
/// of the last motion is added, and vertices that are young or late go another way: the answers
/// depend on all that the view tells about the past.
class Restless final : public hooks::VelocityField {
public:
    explicit Restless(Record& record) : record_(record) {}
    void prepare(const hooks::StepContext& context) override {
        surface_ = &context.surface;
        record_.calls.emplace_back(context.step, seen_in(context.surface));
        record_.wanted.clear();
        for (std::size_t v = 0; v < surface_->vertex_count(); ++v)
            record_.wanted[surface_->births[v]] = surface_->positions[v] + at(v);
    }
    void evaluate(hooks::Range range, std::span<Vec3> out) const override {
        for (std::size_t i = 0; i < out.size(); ++i) out[i] = at(range.begin + i);
    }

private:
    Vec3 at(std::size_t v) const {
        const SurfaceView& s = *surface_;
        if (s.births[v] % 7 == 0) return -1.5 * s.positions[v];
        Vec3 d = 0.02 * s.normals[v] + 0.5 * (s.positions[v] - s.previous_positions[v]);
        if (s.arrived[v] == 0) d *= 0.25;
        return d * (1.0 / (1.0 + static_cast<double>(s.age[v])));
    }
    Record& record_;
    const SurfaceView* surface_ = nullptr;
};

const std::vector<std::string> six_steps = {
    "schedule=[{steps: 3}, {refine: {type: all}}, {steps: 3}]"};

run::SimulationResult recorded_run(Record& record, const run::SimulationOptions& options = {},
                                   const cloud::TargetCloud* cloud = nullptr,
                                   std::unique_ptr<hooks::Observer> observer = nullptr) {
    const dsc::test::Strategies catalogue;
    const run::LoadedExperiment loaded =
        load_text(minimal + (observer ? "observers: [{type: counter}]\n" : ""), six_steps);
    run::Strategies strategies = run::make_strategies(loaded.experiment, catalogue);
    strategies.velocity = std::make_unique<Restless>(record);
    if (observer) strategies.observers[0] = std::move(observer);
    return run::simulate(loaded.experiment, strategies, cloud, options);
}

}  // namespace

TEST_CASE("previous positions are those of the last step, ages count completed steps") {
    Record record;
    recorded_run(record);
    const auto& calls = record.calls;
    REQUIRE(calls.size() == 6);
    std::size_t moved = 0, born = 0;
    for (std::size_t i = 0; i < calls.size(); ++i) {
        const auto& [step, vertices] = calls[i];
        CHECK(step == i + 1);
        for (const auto& [birth, seen] : vertices) {
            const bool first = i == 0 || calls[i - 1].second.count(birth) == 0;
            // A vertex keeps its age: the refinement after step 3 is the only source of vertices.
            if (first && i > 0) {
                CHECK(step == 4);
                ++born;
            }
            CHECK(seen.age == (calls[0].second.count(birth) > 0 ? step - 1 : step - 4));
            const Vec3 before = first ? seen.position : calls[i - 1].second.at(birth).position;
            CHECK(seen.previous == before);
            if (seen.previous != seen.position) ++moved;
            if (first) CHECK(seen.arrived == 1);
        }
    }
    CHECK(moved > 100);
    CHECK(born > 50);
}

TEST_CASE("a vertex has arrived if it is where it was to go, and the number of the others is in "
          "metrics.csv") {
    class Watch final : public hooks::Observer {
    public:
        explicit Watch(const Record& record) : record_(record) {}
        void begin(const hooks::StepContext& context) override {
            CHECK(context.step == 0);
            for (const auto& [birth, seen] : seen_in(context.surface)) CHECK(seen.arrived == 1);
        }
        hooks::Figures step(const hooks::StepContext& context,
                            const hooks::StepFigures& figures) override {
            CHECK(context.step == figures.step);
            double late = 0;
            for (const auto& [birth, seen] : seen_in(context.surface)) {
                const auto destination = record_.wanted.find(birth);
                REQUIRE(destination != record_.wanted.end());
                const double rest = (destination->second - seen.position).norm();
                // The kernel stops at a ten-thousandth of L.
                CHECK((seen.arrived == 1) == (rest < 1e-4 * context.target_length));
                late += seen.arrived == 0 ? 1 : 0;
            }
            return {{"late", late}};
        }
        hooks::Figures end(const hooks::StepContext&) override { return {}; }

    private:
        const Record& record_;
    };
    Record record;
    std::size_t late = 0;
    run::SimulationOptions options;
    options.on_step = [&](const run::StepMetrics& row, std::uint64_t) {
        if (row.step == 0) return;
        const double found = row.observers.at(0).second;
        CHECK(found == static_cast<double>(row.requested - row.arrived));
        late += static_cast<std::size_t>(found);
    };
    recorded_run(record, options, nullptr, std::make_unique<Watch>(record));
    CHECK(late > 20);
}

TEST_CASE("a resumed run gives the same bytes though its velocity depends on the past") {
    std::map<std::uint64_t, std::string> states;
    run::SimulationOptions options;
    options.checkpoint_every = 1;
    options.on_checkpoint = [&](std::string state, std::uint64_t steps) {
        states[steps] = std::move(state);
    };
    Record record;
    const run::SimulationResult whole = recorded_run(record, options);
    REQUIRE(states.size() >= 5);
    for (const auto& [steps, state] : states) {
        CAPTURE(steps);
        run::SimulationOptions resumed;
        resumed.resume = state;
        const run::SimulationResult rest = recorded_run(record, resumed);
        CHECK(rest.mesh.points == whole.mesh.points);
        CHECK(rest.mesh.tets == whole.mesh.tets);
        CHECK(rest.mesh.labels == whole.mesh.labels);
    }
}

TEST_CASE("the history knows vertices by their births") {
    run::VertexHistory history;
    SurfaceView view;
    const auto vertices = [&view](std::vector<std::uint32_t> births) {
        view.births = std::move(births);
        view.vertex_ids.assign(view.births.size(), 0);
        view.positions.clear();
        for (const std::uint32_t b : view.births) view.positions.emplace_back(b, 0, 0);
    };
    history.note_births(10, 0);
    vertices({2, 5, 9});
    history.apply(0, view);
    CHECK(view.age == std::vector<std::uint32_t>{0, 0, 0});
    CHECK(view.previous_positions == view.positions);
    history.begin_step(view);
    // Vertex 5 goes; 7, which existed inside, comes to the interface; 12 is made.
    const std::vector<std::uint32_t> late = {9, 5, 9};
    history.end_step(late);
    history.note_births(13, 1);
    history.note_births(13, 2);  // nothing was made
    vertices({2, 7, 9, 12});
    for (Vec3& p : view.positions) p.y() = 1.0;
    history.apply(2, view);
    CHECK(view.age == std::vector<std::uint32_t>{2, 2, 2, 1});
    CHECK(view.arrived == std::vector<std::uint8_t>{1, 1, 0, 1});
    CHECK(view.previous_positions ==
          std::vector<Vec3>{Vec3(2, 0, 0), Vec3(7, 1, 0), Vec3(9, 0, 0), Vec3(12, 1, 0)});
    StateWriter out;
    history.save(out);
    const std::string bytes = out.take();
    StateReader in(bytes);
    run::VertexHistory loaded;
    loaded.load(in);
    const SurfaceView before = view;
    loaded.apply(2, view);
    CHECK(view.age == before.age);
    CHECK(view.arrived == before.arrived);
    CHECK(view.previous_positions == before.previous_positions);
}

TEST_CASE("the volume view is the complex: labels, volumes, neighbours, in ascending order") {
    class Volume final : public hooks::Observer {
    public:
        void begin(const hooks::StepContext& context) override { look(context); }
        hooks::Figures step(const hooks::StepContext& context,
                            const hooks::StepFigures& figures) override {
            look(context);
            CHECK(volume_ == doctest::Approx(figures.volume));
            CHECK(quality_ == doctest::Approx(figures.min_tet_quality));
            return {};
        }
        hooks::Figures end(const hooks::StepContext& context) override {
            look(context);
            return {{"volume", volume_}};
        }

    private:
        void look(const hooks::StepContext& context) {
            REQUIRE(context.volume != nullptr);
            const mesh::VolumeView& volume = *context.volume;
            volume_ = 0.0;
            quality_ = 1.0;
            double all = 0.0;
            std::size_t tets = 0, faces = 0, vertices = 0, wrong = 0;
            mesh::TetId last = 0;
            std::set<mesh::VertexId> of_interface;
            for (const mesh::TetId t : volume.tets()) {
                wrong += tets > 0 && t <= last ? 1 : 0;
                last = t;
                ++tets;
                all += volume.volume(t);
                if (volume.label(t) > 0) volume_ += volume.volume(t);
                quality_ = std::min(quality_, volume.quality(t));
                for (unsigned f = 0; f < 4; ++f) {
                    const mesh::TetId other = volume.neighbour(t, f);
                    wrong +=
                        volume.label_across(t, f) != (other == mesh::none ? 0 : volume.label(other))
                            ? 1
                            : 0;
                    if (other != mesh::none) {
                        bool back = false;
                        for (unsigned k = 0; k < 4; ++k)
                            back = back || volume.neighbour(other, k) == t;
                        wrong += back ? 0 : 1;
                    }
                    if (volume.interface_face(t, f)) ++faces;
                }
            }
            for (const mesh::VertexId v : volume.vertices()) {
                ++vertices;
                if (volume.on_interface(v)) of_interface.insert(v);
            }
            CHECK(wrong == 0);
            CHECK(tets == volume.tet_count());
            CHECK(vertices == volume.vertex_count());
            CHECK(all == doctest::Approx(27.0));  // the box
            CHECK(faces == 2 * context.surface.face_count());
            CHECK(of_interface == std::set<mesh::VertexId>(context.surface.vertex_ids.begin(),
                                                           context.surface.vertex_ids.end()));
            for (std::size_t f = 0; f < context.surface.face_count(); ++f) {
                CHECK(context.surface.face_labels[f] == std::array<mesh::Label, 2>{0, 1});
                CHECK(volume.label(context.surface.face_tets[f]) == 1);
            }
        }
        double volume_ = 0.0, quality_ = 1.0;
    };
    Record record;
    recorded_run(record, {}, nullptr, std::make_unique<Volume>());
}

TEST_CASE("faces of points and support are filled where they are asked for") {
    class Asking final : public hooks::Observer {
    public:
        Asking(bool faces, bool support) : faces_(faces), support_(support) {}
        bool needs_faces_of_points() const override { return faces_; }
        bool needs_support() const override { return support_; }
        void begin(const hooks::StepContext& context) override { look(context); }
        hooks::Figures step(const hooks::StepContext& context, const hooks::StepFigures&) override {
            look(context);
            return {};
        }
        hooks::Figures end(const hooks::StepContext&) override { return {}; }

    private:
        void look(const hooks::StepContext& context) const {
            std::vector<surface::FacePoint> faces;
            surface::nearest_faces(context.surface, context.cloud->points(), faces);
            CHECK(context.faces_of_points.size() == (faces_ ? faces.size() : 0));
            for (std::size_t i = 0; i < context.faces_of_points.size(); ++i)
                CHECK(context.faces_of_points[i].face == faces[i].face);
            std::vector<double> support;
            hooks::measure_support(context.surface, *context.cloud, faces, support);
            CHECK(std::vector<double>(context.support.begin(), context.support.end()) ==
                  (support_ ? support : std::vector<double>()));
        }
        bool faces_, support_;
    };
    cloud::Normalized points;
    for (double x = -0.45; x < 0.5; x += 0.1) {
        for (double y = -0.45; y < 0.5; y += 0.1) points.points.emplace_back(x, y, 0.5);
    }
    const cloud::TargetCloud target(points);
    Record record;
    for (const bool faces : {false, true}) {
        for (const bool support : {false, true})
            recorded_run(record, {}, &target, std::make_unique<Asking>(faces, support));
    }
}

TEST_CASE("support is the part of the area for which there are points") {
    // Faces of the cube [-0.5, 0.5]^3 that the points cover: only the one at z = 0.5.
    Record record;
    cloud::Normalized points;
    const double width = 0.02;
    for (double x = -0.5 + width / 2; x < 0.5; x += width) {
        for (double y = -0.5 + width / 2; y < 0.5; y += width)
            points.points.emplace_back(x, y, 0.5);
    }
    const cloud::TargetCloud target(points);
    class Support final : public hooks::Observer {
    public:
        bool needs_support() const override { return true; }
        void begin(const hooks::StepContext& context) override {
            std::size_t covered = 0, bare = 0;
            for (std::size_t v = 0; v < context.surface.vertex_count(); ++v) {
                const Vec3& p = context.surface.positions[v];
                const bool inner = std::max(std::abs(p.x()), std::abs(p.y())) < 0.4;
                if (p.z() > 0.49 && inner) {
                    // A regular grid of width w has the area w^2 per point; the spacing is that
                    // of 12 neighbours, within 2 w.
                    CHECK(context.support[v] > 0.9);
                    ++covered;
                }
                if (p.z() < 0.2) {
                    CHECK(context.support[v] == 0.0);
                    ++bare;
                }
            }
            CHECK(covered > 4);
            CHECK(bare > 20);
        }
        hooks::Figures step(const hooks::StepContext&, const hooks::StepFigures&) override {
            return {};
        }
        hooks::Figures end(const hooks::StepContext&) override { return {}; }
    };
    recorded_run(record, {}, &target, std::make_unique<Support>());
}
