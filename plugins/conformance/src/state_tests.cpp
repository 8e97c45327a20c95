// state.*: what a checkpoint holds of a strategy.
#include <dsc/base/random.hpp>
#include <sstream>

#include "test_table.hpp"

namespace dsc::conformance {
namespace {

std::string saved(const hooks::Strategy& strategy) {
    std::ostringstream out(std::ios::binary);
    strategy.save(out);
    return out.str();
}

// Two steps, saved, read by another instance: both go on to the same answers, and hold the same state.
void state_roundtrip(const Subject& subject) {
    subject.require_repeatable();
    const auto original = subject.make();
    exercise(subject.kind(), *original, subject.fixture(), {.first_step = 1, .steps = 2});
    const std::string state = saved(*original);
    const auto resumed = subject.make();
    try {
        std::istringstream in(state, std::ios::binary);
        resumed->load(in);
    } catch (const std::exception& error) {
        throw Failed(std::string("it cannot read what it has saved: ") + error.what());
    }
    require(saved(*resumed) == state, "saved, read and saved again, the state differs");
    const Exercise on{.first_step = 3, .steps = 2};
    const Trace uninterrupted = exercise(subject.kind(), *original, subject.fixture(), on).trace;
    const Trace continued = exercise(subject.kind(), *resumed, subject.fixture(), on).trace;
    if (const auto difference = Trace::difference(uninterrupted, continued))
        throw Failed("a resumed run is another run: " + *difference);
}

// Damaged states: an empty one is refused; no other ends in anything but an exception or a reading.
void damaged(const Subject& subject) {
    const auto original = subject.make();
    exercise(subject.kind(), *original, subject.fixture(), {.steps = 2});
    const std::string state = saved(*original);
    if (state.empty()) throw Skipped("it has no state");
    const auto refuses = [&](const std::string& bytes) {
        const auto strategy = subject.make();
        std::istringstream in(bytes, std::ios::binary);
        try {
            strategy->load(in);
        } catch (const std::exception&) {
            return true;
        }
        return false;
    };
    require(refuses(""), "it reads an empty state as if it were one");
    for (std::size_t part = 1; part < 16; ++part) refuses(state.substr(0, state.size() * part / 16));
    RandomStream random(RandomKey{subject.seed(), stream_id("state"), 0, 0});
    for (int i = 0; i < 50; ++i) {
        std::string bytes = state;
        for (int k = 0; k < 4; ++k) bytes[random.index(bytes.size())] = static_cast<char>(random.index(256));
        refuses(bytes);
    }
}

// State belongs to advance(): a step in which prepare() is called again is the same step.
void prepare_again(const Subject& subject) {
    subject.require_repeatable();
    const Trace once = subject.answers({.steps = 3}).trace;
    const Trace often = subject.answers({.steps = 3, .prepares = 3}).trace;
    if (const auto difference = Trace::difference(once, often)) {
        throw Failed("calling prepare() again changes its answers, so it changes a state that belongs to advance(): " + *difference);
    }
}

}  // namespace

void add_state_tests(std::vector<Test>& table) {
    add(table,
        {"state.roundtrip", Level::standard, false,
         "Saved and read by another instance, a run goes on as if nothing had been."},
        state_roundtrip);
    add(table,
        {"state.prepare", Level::standard, false, "prepare() may be called more than once per step and changes no answer."}, prepare_again,
        per_vertex);
    add(table, {"state.bad", Level::standard, false, "Damaged states end in an exception, never in a crash."},
        damaged);
}

}  // namespace dsc::conformance
