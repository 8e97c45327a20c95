// cancel, leak, thr.*, perf.*: the resources that a strategy uses.
#include <malloc.h>

#include <fmt/core.h>

#include <dsc/plugin/fingerprint.hpp>

#include "process.hpp"
#include "test_table.hpp"

extern "C" __attribute__((weak)) int __lsan_do_recoverable_leak_check();

namespace dsc::conformance {
namespace {

constexpr double cancel_seconds = 2.0;

bool sanitized(std::string_view by) {
    return plugin::core_fingerprint().find("san=" + std::string(by)) != std::string_view::npos;
}

// A strategy that is cancelled before it begins returns soon, with or without an answer.
void cancel(const Subject& subject) {
    CancelToken token;
    token.cancel();
    const auto strategy = subject.make();
    const double begin = cpu_seconds();
    try {
        exercise(subject.kind(), *strategy, subject.fixture(), {.steps = 1, .cancel = &token});
    } catch (const std::exception&) {
        // most likely a CancelledError
    }
    const double seconds = cpu_seconds() - begin;
    if (seconds > cancel_seconds && !sanitized("address") && !sanitized("thread"))
        throw Failed(fmt::format("after it was cancelled, it works for another {:f} s", seconds));
}

void use_once(const Subject& subject, const Fixture& fixture) {
    const auto strategy = subject.make();
    try {
        exercise(subject.kind(), *strategy, fixture, {.steps = 1});
    } catch (const std::exception& error) {
        throw Skipped(std::string("it throws; see param.default: ") + error.what());
    }
}

// A strategy that is created, used and destroyed many times keeps no more memory than after a few
// times.
void leak(const Subject& subject) {
    const bool costly = subject.kind() == plugin::Kind::initial_mesh ||
                        subject.kind() == plugin::Kind::improvement ||
                        subject.kind() == plugin::Kind::filter;
    const unsigned repeats = costly ? 5 : 100;
    const Fixture small = costly ? subject.fixture() : triangles(2);
    for (unsigned i = 0; i < 3; ++i) use_once(subject, small);
    if (sanitized("address") && __lsan_do_recoverable_leak_check != nullptr) {
        for (unsigned i = 0; i < 3; ++i) use_once(subject, small);
        require(__lsan_do_recoverable_leak_check() == 0, "memory is lost");
        return;
    }
    if (sanitized("thread")) throw Skipped("memory is not counted under ThreadSanitizer");
    // The allocator counts its cache as used memory, which sometimes grows by some hundred bytes,
    // and Python keeps cyclic garbage for a while: a leak shows in every round.
    constexpr std::size_t much = 256;
    constexpr unsigned rounds = 12;
    std::size_t lost = much;
    for (unsigned round = 0; round < rounds && lost >= much; ++round) {
        const std::size_t before = mallinfo2().uordblks + mallinfo2().hblkhd;
        for (unsigned i = 0; i < repeats; ++i) use_once(subject, small);
        const std::size_t after = mallinfo2().uordblks + mallinfo2().hblkhd;
        lost = after > before ? (after - before) / repeats : 0;
    }
    require(lost < much,
            std::to_string(lost) + " bytes are lost each time it is created, used and destroyed");
}

// The sanitizer's report decides; the process that runs the test reads it.
void race(const Subject& subject) {
    if (!sanitized("thread")) throw Skipped("races are found only in a build with ThreadSanitizer");
    for (unsigned i = 0; i < 3; ++i) subject.answers({.threads = 4, .block = 8});
}

// A surface four times as large takes about four times as long.
void scale(const Subject& subject) {
    const auto time = [&](unsigned level) {
        const Fixture fixture = triangles(level);
        double best = 1e9;
        for (int i = 0; i < 3; ++i) {
            const auto strategy = subject.make();
            const double begin = cpu_seconds();
            exercise(subject.kind(), *strategy, fixture, {.steps = 1});
            best = std::min(best, cpu_seconds() - begin);
        }
        return best;
    };
    const double small = time(4);
    const double large = time(5);
    const double ratio = large / std::max(small, 1e-6);
    if (large > 0.02 && ratio > 9)
        throw Warned(fmt::format("a surface four times as large takes {:f} times as long; the time "
                                 "grows faster than the surface",
                                 ratio));
}

}  // namespace

void add_resource_tests(std::vector<Test>& table) {
    add(table, {"cancel", Level::standard, false, "It returns within 2 s after it is cancelled."},
        cancel);
    add(table,
        {"leak", Level::standard, false,
         "It loses no memory when it is created, used and destroyed."},
        leak);
    add(table,
        {"thr.race", Level::strict, false,
         "Concurrent calls have no data race (in a build with ThreadSanitizer)."},
        race);
    add(table, {"perf.scale", Level::strict, false, "The time grows no faster than the surface."},
        scale, {plugin::Kind::velocity, plugin::Kind::curvature, plugin::Kind::refinement});
}

}  // namespace dsc::conformance
