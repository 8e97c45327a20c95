// A strategy that is told to stop may return early: its answers are discarded, and the run goes on
// later as if nothing had happened.
#include <thread>

#include <doctest/doctest.h>

#include <dsc/base/error.hpp>
#include <dsc/base/state.hpp>
#include <dsc/run/input.hpp>
#include <dsc/run/measure.hpp>
#include <dsc/run/metrics.hpp>
#include <dsc/run/simulation.hpp>

#include "fakes.hpp"

using namespace dsc;
using dsc::test::load_text;
using dsc::test::minimal;

namespace {

/// When a strategy makes the run stop, before it asks: a step, or a pass of a refinement.
struct Stop {
    CancelToken* token = nullptr;
    std::uint64_t step = 0;
    unsigned pass = 0;
    bool waits = false;  ///< until it is told, as for a time budget
};

void ask_to_stop(const Stop& stop) {
    if (stop.token != nullptr) stop.token->cancel();
}

template <class T>
void save_value(std::ostream& out, T value) {
    StateWriter state;
    state.value(value);
    const std::string bytes = state.take();
    out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

template <class T>
void load_value(std::istream& in, T& value) {
    const std::string bytes{std::istreambuf_iterator<char>(in), {}};
    StateReader state(bytes);
    state.value(value);
}

/// Shrinks faster with every step; gives no displacements after it is told to stop.
class Polite final : public hooks::VelocityField {
public:
    explicit Polite(Stop stop) : stop_(stop) {}
    void advance(const hooks::StepContext& context) override {
        speed_ = 0.5 * speed_ + 0.01;
        if (context.step != stop_.step) return;
        ask_to_stop(stop_);
        while (stop_.waits && !context.cancelled()) std::this_thread::yield();
    }
    void prepare(const hooks::StepContext& context) override { context_ = &context; }
    void evaluate(hooks::Range range, std::span<Vec3> out) const override {
        if (context_->cancelled()) return;
        for (std::size_t i = 0; i < out.size(); ++i)
            out[i] = -speed_ * context_->surface.positions[range.begin + i];
    }
    void save(std::ostream& out) const override { save_value(out, speed_); }
    void load(std::istream& in) override { load_value(in, speed_); }

private:
    Stop stop_;
    double speed_ = 0.0;
    const hooks::StepContext* context_ = nullptr;
};

/// Splits some faces, others in each pass and call; gives half of them after it is told to stop.
class PoliteSplit final : public hooks::RefinementPolicy {
public:
    explicit PoliteSplit(Stop stop) : stop_(stop) {}
    unsigned passes() const override { return 3; }
    void refine(const hooks::RefinementContext& context, hooks::RefinementRequests& out) override {
        calls_ += 1.0;
        if (context.step.step == stop_.step && context.pass == stop_.pass) ask_to_stop(stop_);
        const std::size_t count = context.step.surface.face_count();
        const auto first = static_cast<std::uint32_t>(calls_);
        for (std::uint32_t f = first; f < count; f += 40) {
            if (f > count / 2 && context.step.cancelled()) return;
            out.split_faces.push_back(f);
        }
    }
    void save(std::ostream& out) const override { save_value(out, calls_); }
    void load(std::istream& in) override { load_value(in, calls_); }

private:
    Stop stop_;
    double calls_ = 0.0;
};

struct End {
    run::SimulationResult result;
    std::string rows;
    std::string state;
    std::uint64_t steps = 0;
};

End simulate(const std::vector<std::string>& schedule, Stop velocity, Stop refinement,
             const CancelToken* token, std::string_view resume = {}) {
    const dsc::test::Strategies catalogue;
    const run::LoadedExperiment loaded = load_text(minimal, schedule);
    run::Strategies strategies = run::make_strategies(loaded.experiment, catalogue);
    strategies.velocity = std::make_unique<Polite>(velocity);
    for (auto& policy : strategies.refinements) {
        if (policy) policy = std::make_unique<PoliteSplit>(refinement);
    }
    End end;
    run::SimulationOptions options;
    options.cancel = token;
    options.resume = resume;
    options.on_step = [&](const run::StepMetrics& row, std::uint64_t) {
        end.rows += run::csv_row(row);
    };
    options.on_checkpoint = [&](std::string state, std::uint64_t steps) {
        end.state = std::move(state);
        end.steps = steps;
    };
    end.result = run::simulate(loaded.experiment, strategies, nullptr, options);
    return end;
}

void check_same(const End& whole, const End& stopped, const End& rest) {
    CHECK(stopped.rows + rest.rows == whole.rows);
    CHECK(run::identical(rest.result.surface, whole.result.surface));
    CHECK(rest.result.mesh.tets == whole.result.mesh.tets);
    CHECK(rest.result.totals.refinements == whole.result.totals.refinements);
    CHECK(rest.result.totals.refine_committed == whole.result.totals.refine_committed);
    REQUIRE(rest.result.totals.refinement_items.size() ==
            whole.result.totals.refinement_items.size());
    for (std::size_t i = 0; i < whole.result.totals.refinement_items.size(); ++i) {
        CHECK(rest.result.totals.refinement_items[i].made ==
              whole.result.totals.refinement_items[i].made);
        CHECK(rest.result.totals.refinement_items[i].committed ==
              whole.result.totals.refinement_items[i].committed);
    }
}

}  // namespace

TEST_CASE("told to stop in a step: the step is discarded, and made again later") {
    const std::vector<std::string> schedule = {"schedule=[{steps: 5}]"};
    const End whole = simulate(schedule, {}, {}, nullptr);
    CancelToken token;
    const End stopped = simulate(schedule, {&token, 3}, {}, &token);
    CHECK(stopped.result.totals.status == run::Status::cancelled);
    CHECK(stopped.result.totals.steps == 2);
    CHECK(stopped.steps == 2);
    check_same(whole, stopped, simulate(schedule, {}, {}, nullptr, stopped.state));
}

TEST_CASE("told to stop in any pass of a refinement: the pass is discarded, and made again later") {
    for (const std::string schedule : {"schedule=[{steps: 2}, {refine: {type: all}}, {steps: 2}]",
                                       "schedule=[{steps: 4, every: 2, refine: {type: all}}]"}) {
        const End whole = simulate({schedule}, {}, {}, nullptr);
        CHECK(whole.result.totals.refine_committed > 0);
        for (const unsigned pass : {0U, 1U, 2U}) {
            CAPTURE(pass);
            CAPTURE(schedule);
            CancelToken token;
            const End stopped = simulate({schedule}, {}, {&token, 2, pass}, &token);
            CHECK(stopped.result.totals.status == run::Status::cancelled);
            CHECK(stopped.steps == 2);
            check_same(whole, stopped, simulate({schedule}, {}, {}, nullptr, stopped.state));
        }
    }
}

TEST_CASE("the end of a time budget is told like a request") {
    const std::vector<std::string> schedule = {"schedule=[{steps: 4}]"};
    const End whole = simulate(schedule, {}, {}, nullptr);
    // Long enough for two steps of milliseconds on a busy machine.
    const CancelToken token(nullptr, CancelToken::Clock::now() + std::chrono::seconds(5));
    const End stopped = simulate(schedule, {nullptr, 3, 0, true}, {}, &token);
    CHECK(stopped.result.totals.steps == 2);
    check_same(whole, stopped, simulate(schedule, {}, {}, nullptr, stopped.state));
}

TEST_CASE("a request that no strategy hears of ends the run after a whole step") {
    CancelToken token;
    const std::vector<std::string> schedule = {"schedule=[{steps: 4}]"};
    const dsc::test::Strategies catalogue;
    const run::LoadedExperiment loaded = load_text(minimal, schedule);
    run::Strategies strategies = run::make_strategies(loaded.experiment, catalogue);
    run::SimulationOptions options;
    options.cancel = &token;
    options.on_step = [&](const run::StepMetrics& row, std::uint64_t) {
        if (row.step == 2) token.cancel();
    };
    const auto result = run::simulate(loaded.experiment, strategies, nullptr, options);
    CHECK(result.totals.steps == 2);
    CHECK_FALSE(token.told());
}

TEST_CASE("a token knows its outer token, its deadline, and whether somebody was told") {
    CancelToken outer;
    const CancelToken inner(&outer);
    CHECK_FALSE(inner.cancelled());
    CHECK_FALSE(inner.told());
    outer.cancel();
    CHECK(inner.requested());
    CHECK_FALSE(inner.told());
    CHECK(inner.cancelled());
    CHECK(inner.told());
    CHECK_FALSE(outer.told());
    const CancelToken late(nullptr, CancelToken::Clock::now() + std::chrono::hours(1));
    CHECK_FALSE(late.cancelled());
    const CancelToken over(nullptr, CancelToken::Clock::now());
    CHECK(over.cancelled());
}

TEST_CASE("an initial mesh that is told to stop is discarded") {
    class PoliteBox final : public hooks::InitialMesh {
    public:
        explicit PoliteBox(std::unique_ptr<hooks::InitialMesh> whole) : whole_(std::move(whole)) {}
        mesh::TetMesh build(const hooks::InitialMeshContext& context) override {
            mesh::TetMesh mesh = whole_->build(context);
            if (context.cancel != nullptr && context.cancel->cancelled())
                std::fill(mesh.labels.begin(), mesh.labels.end(), 0);
            return mesh;
        }

    private:
        std::unique_ptr<hooks::InitialMesh> whole_;
    };
    const dsc::test::Strategies catalogue;
    const run::LoadedExperiment loaded = load_text(minimal);
    run::Strategies strategies = run::make_strategies(loaded.experiment, catalogue);
    strategies.initial_mesh = std::make_unique<PoliteBox>(std::move(strategies.initial_mesh));
    CancelToken token;
    token.cancel();
    run::SimulationOptions options;
    options.cancel = &token;
    CHECK_THROWS_AS(run::simulate(loaded.experiment, strategies, nullptr, options), CancelledError);
}
