// det.*, seed.*: the same calls return the same answers, bit by bit.
#include <algorithm>
#include <cmath>
#include <locale>
#include <memory>
#include <numeric>

#include <locale.h>
#include <stdlib.h>
#include <unistd.h>

#include <fmt/core.h>

#include <dsc/base/random.hpp>

#include "clock_shift.hpp"
#include "test_table.hpp"

namespace dsc::conformance {
namespace {

void require_same(const Trace& a, const Trace& b, const std::string& otherwise) {
    if (const auto difference = Trace::difference(a, b))
        throw Failed(otherwise + ": " + *difference);
}

void repeat(const Subject& subject) {
    const Exercise how{.seed = subject.seed()};
    const Trace first = subject.answers(how).trace;
    // This changes memory and addresses, so that answers that depend on them differ.
    const std::vector<std::unique_ptr<char[]>> shift = [] {
        std::vector<std::unique_ptr<char[]>> blocks;
        for (std::size_t i = 1; i < 200; ++i) blocks.push_back(std::make_unique<char[]>(37 * i));
        return blocks;
    }();
    require_same(first, subject.answers(how).trace,
                 "the same calls return different answers the second time");
}

void threads(const Subject& subject) {
    subject.require_repeatable();
    const Trace one = subject.answers().trace;
    struct Split {
        unsigned threads;
        std::size_t block;
    };
    for (const Split& split : {Split{2, 64}, Split{7, 17}, Split{1, 1}, Split{3, 100000}}) {
        const Trace other = subject.answers({.threads = split.threads, .block = split.block}).trace;
        require_same(
            one, other,
            fmt::format("{} threads and blocks of {} vertices against one thread and blocks of 64",
                        split.threads, split.block));
    }
}

// Steps of one instance between the steps of another instance must have no effect.
void instances(const Subject& subject) {
    subject.require_repeatable();
    const Fixture other = triangles(2);
    const auto alone = [&](const Fixture& fixture) {
        const auto strategy = subject.make();
        Trace all;
        for (std::uint64_t step = 1; step <= 3; ++step)
            all.add(std::span<const double>(
                exercise(subject.kind(), *strategy, fixture, {.first_step = step, .steps = 1})
                    .trace.values()));
        return all;
    };
    const Trace first = alone(subject.fixture());
    const Trace second = alone(other);
    const auto a = subject.make();
    const auto b = subject.make();
    Trace first_mixed;
    Trace second_mixed;
    for (std::uint64_t step = 1; step <= 3; ++step) {
        const Exercise how{.first_step = step, .steps = 1};
        first_mixed.add(std::span<const double>(
            exercise(subject.kind(), *a, subject.fixture(), how).trace.values()));
        second_mixed.add(
            std::span<const double>(exercise(subject.kind(), *b, other, how).trace.values()));
    }
    require_same(first, first_mixed, "two instances disturb each other");
    require_same(second, second_mixed, "two instances disturb each other");
}

// Compares the values of vertex i of the reordered fixture with those of order[i].
void require_permuted(const Trace& plain, const Trace& permuted,
                      const std::vector<std::uint32_t>& order, std::size_t width) {
    const std::size_t count = order.size() * width;
    require(plain.values().size() == permuted.values().size(),
            "a different order of the vertices changes the number of answers");
    double largest = 0;
    for (const double v : plain.values()) largest = std::max(largest, std::abs(v));
    for (std::size_t i = 0; i < count; ++i) {
        const double expected = plain.values()[order[i / width] * width + i % width];
        const double found = permuted.values()[i];
        if (std::abs(expected - found) <= 1e-9 * largest) continue;
        throw Failed(fmt::format(
            "vertex {} gets {:f} instead of {:f} when the vertices were born in a different order: "
            "it uses the index of a vertex, or it computes with the birth id; a birth id is only "
            "for random numbers and for state",
            order[i / width], found, expected));
    }
}

void order(const Subject& subject) {
    subject.require_repeatable();
    subject.require_finite();
    if (Trace::difference(subject.answers({.seed = 1}).trace, subject.answers({.seed = 2}).trace))
        throw Skipped("its random numbers belong to the birth ids, which are the order");
    if (Trace::difference(subject.answers().trace, subject.answers({.block = 17}).trace))
        throw Skipped("the split into blocks changes its answers; see det.threads");
    std::vector<std::uint32_t> order(subject.fixture().view.vertex_count());
    std::iota(order.begin(), order.end(), 0U);
    RandomStream random(RandomKey{subject.seed(), stream_id("order"), 0, 0});
    for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[random.index(i)]);
    const Exercise how{.steps = 1};
    const Trace plain = subject.answers(how).trace;
    const Trace permuted = subject.answers_on(reordered(subject.fixture(), order), how).trace;
    require_permuted(plain, permuted, order, subject.kind() == plugin::Kind::velocity ? 3 : 1);
}

// A locale with a decimal comma, as in half of the world.
class Comma : public std::numpunct<char> {
protected:
    char do_decimal_point() const override { return ','; }
    char do_thousands_sep() const override { return '.'; }
    std::string do_grouping() const override { return "\3"; }
};

void environment(const Subject& subject) {
    subject.require_repeatable();
    const Trace before = subject.answers().trace;
    const std::locale locale = std::locale::global(std::locale(std::locale::classic(), new Comma));
    for (const char* name : {"de_DE.UTF-8", "fr_FR.UTF-8", "C.UTF-8"}) {
        if (setlocale(LC_ALL, name) != nullptr) break;
    }
    setenv("LC_ALL", "de_DE.UTF-8", 1);
    setenv("LANG", "de_DE.UTF-8", 1);
    setenv("TZ", "Pacific/Kiritimati", 1);
    setenv("HOME", "/nonexistent", 1);
    if (chdir("/") != 0) throw Skipped("cannot change to another folder");
    const Trace after = subject.answers().trace;
    std::locale::global(locale);
    require_same(
        before, after,
        "a different locale, time zone, home folder or working folder changes the answers");
}

void clock(const Subject& subject) {
    subject.require_repeatable();
    const Trace now = subject.answers().trace;
    for (const ClockShift& shift : other_times) {
        shift_clocks(shift);
        const Trace then = subject.answers().trace;
        shift_clocks({});
        require_same(now, then,
                     shift.seconds_more > 0
                         ? std::string("on a slower machine its answers differ: it reads a clock")
                         : fmt::format("{} hours {} its answers differ: it reads a clock",
                                       std::abs(shift.seconds) / 3600,
                                       shift.seconds > 0 ? "later" : "earlier"));
    }
}

void seed(const Subject& subject) {
    subject.require_repeatable();
    const Trace one = subject.answers({.seed = 1}).trace;
    const Trace two = subject.answers({.seed = 2}).trace;
    const auto difference = Trace::difference(one, two);
    if (subject.record().traits.stochastic) {
        require(difference.has_value(),
                "it is declared stochastic, but two seeds give the same answers");
    } else if (difference) {
        throw Failed("two seeds give different answers, but it is not declared stochastic: " +
                     *difference);
    }
}

}  // namespace

void add_determinism_tests(std::vector<Test>& table) {
    add(table,
        {"det.repeat", Level::smoke, false, "The same calls return the same answers each time."},
        repeat);
    add(table,
        {"det.threads", Level::standard, false,
         "The number of threads and the split into blocks change no answer."},
        threads);
    add(table,
        {"det.instances", Level::standard, false,
         "Two instances that are called alternately do not disturb each other."},
        instances);
    add(table,
        {"det.order", Level::strict, false,
         "Vertices that were born in a different order get the same values, up to rounding."},
        order, per_vertex);
    add(table,
        {"det.env", Level::strict, false,
         "Locale, time zone, home folder and working folder change no answer."},
        environment);
    add(table,
        {"det.clock", Level::standard, false,
         "The time of day, the date and the speed of the machine change no answer."},
        clock);
    add(table,
        {"seed.used", Level::standard, false,
         "The seed changes the answers of strategies that are declared stochastic, and of no "
         "others."},
        seed);
}

}  // namespace dsc::conformance
