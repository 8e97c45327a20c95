// state.*: the state of a strategy in a checkpoint.
#include <sstream>

#include <dsc/base/random.hpp>

#include "test_table.hpp"

namespace dsc::conformance {
namespace {

std::string saved(const hooks::Strategy& strategy) {
    std::ostringstream out(std::ios::binary);
    strategy.save(out);
    return out.str();
}

// After two steps the state is saved and read by another instance: both then give the same answers,
// and store the same state.
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
        throw Failed(std::string("it cannot read the state that it has saved: ") + error.what());
    }
    require(saved(*resumed) == state, "the state differs after it is saved, read and saved again");
    const Exercise on{.first_step = 3, .steps = 2};
    const Trace uninterrupted = exercise(subject.kind(), *original, subject.fixture(), on).trace;
    const Trace continued = exercise(subject.kind(), *resumed, subject.fixture(), on).trace;
    if (const auto difference = Trace::difference(uninterrupted, continued))
        throw Failed("a resumed run gives different answers: " + *difference);
}

// Damaged states: an empty one is refused; any other is read or leads to an exception.
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
    require(refuses(""), "it accepts an empty state");
    for (std::size_t part = 1; part < 16; ++part)
        refuses(state.substr(0, state.size() * part / 16));
    RandomStream random(RandomKey{subject.seed(), stream_id("state"), 0, 0});
    for (int i = 0; i < 50; ++i) {
        std::string bytes = state;
        for (int k = 0; k < 4; ++k)
            bytes[random.index(bytes.size())] = static_cast<char>(random.index(256));
        refuses(bytes);
    }
}

// Only advance() may change the state: a second prepare() in a step changes nothing.
void prepare_again(const Subject& subject) {
    subject.require_repeatable();
    const Trace once = subject.answers({.steps = 3}).trace;
    const Trace often = subject.answers({.steps = 3, .prepares = 3}).trace;
    if (const auto difference = Trace::difference(once, often)) {
        throw Failed("a second call of prepare() changes its answers; only advance() may change "
                     "the state: " +
                     *difference);
    }
}

}  // namespace

void add_state_tests(std::vector<Test>& table) {
    add(table,
        {"state.roundtrip", Level::standard, false,
         "After another instance has read its saved state, the run continues with the same "
         "answers."},
        state_roundtrip);
    add(table,
        {"state.prepare", Level::standard, false,
         "prepare() may be called more than once per step and changes no answer."},
        prepare_again, per_vertex);
    add(table,
        {"state.bad", Level::standard, false,
         "Damaged states lead to an exception, never to a crash."},
        damaged);
}

}  // namespace dsc::conformance
