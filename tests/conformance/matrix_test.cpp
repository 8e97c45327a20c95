// Each test of `dsc plugin check` has a witness, a plugin that is bad in exactly this way: it must
// fail this test and no other.
#include <algorithm>
#include <set>
#include <string>
#include <utility>

#include <doctest/doctest.h>

#include <dsc/conformance/check.hpp>
#include <dsc/plugin/fingerprint.hpp>

namespace {

using dsc::conformance::CheckOptions;
using dsc::conformance::Level;
using dsc::conformance::Outcome;
using dsc::conformance::Report;
using dsc::conformance::Status;
using dsc::plugin::Kind;

std::filesystem::path library(const std::string& name) {
    return std::filesystem::path(DSC_TEST_PLUGINS) / ("libdsc_" + name + ".so");
}

CheckOptions strict() {
    CheckOptions options;
    options.level = Level::strict;
    options.limit = std::chrono::milliseconds(15000);
    return options;
}

bool has_sanitizer(const std::string& name) {
    return dsc::plugin::core_fingerprint().find("san=" + name) != std::string_view::npos;
}

/// The tests that the report does not show as passed or skipped.
std::set<std::string> failed(const Report& report) {
    std::set<std::string> tests;
    for (const Outcome& o : report.outcomes) {
        if (o.status != Status::pass && o.status != Status::skip) tests.insert(o.test);
    }
    return tests;
}

std::string listed(const std::set<std::string>& tests) {
    std::string text;
    for (const std::string& test : tests) text += test + " ";
    return text;
}

Report report_on(const std::string& plugin, Kind kind, const std::string& id) {
    CheckOptions options = strict();
    options.strategies = {{kind, id}};
    return dsc::conformance::check(library("bad_" + plugin), options);
}

struct Witness {
    const char* test;
    const char* plugin;
    Kind kind = Kind::velocity;
    const char* more = "";  // of the id
};

/// A witness' id is its test's, with underscores, and a word where a test has several.
constexpr Witness witnesses[] = {
    {"schema.lint", "parameters"},
    {"schema.roundtrip", "parameters"},
    {"schema.reject", "parameters"},
    {"param.default", "parameters"},
    {"param.bounds", "parameters"},
    {"param.fuzz", "parameters"},
    {"out.finite", "output"},
    {"out.complete", "output"},
    {"out.bounds", "output"},
    {"out.const", "output"},
    {"out.attributes", "output"},
    {"out.quiet", "output"},
    {"out.quiet", "output", Kind::velocity, "_stream"},
    {"out.quiet", "output", Kind::velocity, "_evaluate"},
    {"in.bounds", "reads"},
    {"in.bounds", "reads", Kind::velocity, "_random"},
    {"in.bounds", "reads", Kind::velocity, "_faces"},
    {"in.bounds", "reads", Kind::velocity, "_cloud"},
    {"det.repeat", "determinism"},
    {"det.threads", "determinism"},
    {"det.instances", "determinism"},
    {"det.order", "determinism"},
    {"det.env", "determinism"},
    {"det.clock", "clock"},
    {"det.clock", "clock", Kind::velocity, "_month"},
    {"det.clock", "clock", Kind::velocity, "_budget"},
    {"det.clock", "clock", Kind::velocity, "_patience"},
    {"det.clock", "clock", Kind::velocity, "_morning"},
    {"seed.used", "determinism"},
    {"geo.rigid", "state"},
    {"geo.scale", "scale"},
    {"geo.scale", "scale", Kind::velocity, "_tolerance"},
    {"geo.scale", "scale", Kind::curvature},
    {"geo.scale", "scale", Kind::refinement},
    {"state.roundtrip", "state"},
    {"state.prepare", "state"},
    {"state.bad", "state"},
    {"err.throw", "state"},
    {"prepare.state", "prepare"},
    {"prepare.surface", "prepare"},
    {"prepare.surface", "prepare", Kind::curvature},
    {"mesh.hostile", "hostile"},
    {"cloud.hostile", "hostile"},
    {"mesh.topology", "hostile", Kind::initial_mesh},
    {"policy.progress", "hostile", Kind::refinement},
    {"policy.sizing", "hostile", Kind::refinement},
    {"cloud.attributes", "filter", Kind::filter},
    {"cancel", "resources"},
    {"leak", "resources"},
    {"thr.race", "resources"},
    {"perf.scale", "resources"},
    {"long.steps", "long"},
    {"long.steps", "long", Kind::velocity, "_throw"},
    {"long.steps", "long", Kind::velocity, "_incomplete"},
    {"long.memory", "long"},
};

struct LibraryWitness {
    const char* test;
    const char* plugin;
};
constexpr LibraryWitness library_witnesses[] = {{"lib.entry", "bad_version"},
                                                {"lib.bind", "bad_symbol"},
                                                {"lib.scan", "bad_noisy"},
                                                {"lib.twice", "bad_once"}};

}  // namespace

TEST_CASE("every test has a witness") {
    std::set<std::string> seen;
    for (const Witness& w : witnesses) seen.insert(w.test);
    for (const LibraryWitness& w : library_witnesses) seen.insert(w.test);
    for (const auto& test : dsc::conformance::tests()) {
        CAPTURE(test.id);
        CHECK(seen.erase(test.id) == 1);
        CHECK_FALSE(test.doc.empty());
    }
    CHECK(seen.empty());
}

TEST_CASE("a witness fails its own test and no other") {
    for (const Witness& w : witnesses) {
        std::string id = w.test;
        std::replace(id.begin(), id.end(), '.', '_');
        id += w.more;
        INFO("the witness ", id);
        std::set<std::string> expected = {w.test};
        // Races show under ThreadSanitizer only; neither time nor memory is measured under a
        // sanitizer as without.
        if (std::string(w.test) == "thr.race" && !has_sanitizer("thread")) expected.clear();
        if (std::string(w.test) == "cancel" && !has_sanitizer("none")) expected.clear();
        if (std::string(w.test) == "leak" && has_sanitizer("thread")) expected.clear();
        if (std::string(w.test) == "long.memory" && !has_sanitizer("none")) expected.clear();
        // A sanitizer finds these in whatever test they happen, or not at all.
        if (std::string(w.test) == "in.bounds" && !has_sanitizer("none")) continue;
        const Report report = report_on(w.plugin, w.kind, id);
        INFO(dsc::conformance::text(report));
        CHECK(listed(failed(report)) == listed(expected));
    }
}

TEST_CASE("a witness of the library fails its own test and no other") {
    for (const LibraryWitness& w : library_witnesses) {
        INFO("the witness of ", std::string(w.test));
        CHECK(listed(failed(dsc::conformance::check(library(w.plugin), strict()))) ==
              listed({w.test}));
    }
}

TEST_CASE("good plugins pass") {
    const Report report = dsc::conformance::check(library("good"), strict());
    CHECK(report.passed());
    CHECK(report.count(Status::pass) > 40);
    CHECK(report.plugin == "good 1.2.3");
}

TEST_CASE("the birth ids ascend in every test") {
    CheckOptions options = strict();
    options.strategies = {{Kind::velocity, "by_birth"}};
    const Report report = dsc::conformance::check(library("bad_determinism"), options);
    INFO(dsc::conformance::text(report));
    CHECK(report.passed());
}

TEST_CASE("a read beyond an input is reported as that, with the input and the call") {
    if (!has_sanitizer("none")) return;
    for (const auto& [id, input] :
         {std::pair("in_bounds", "the positions of the surface, in evaluate at step 1"),
          {"in_bounds_random", "the normals of the surface, in evaluate at step 1"},
          {"in_bounds_faces", "the faces of the surface, in prepare at step 1"},
          {"in_bounds_cloud", "the points of the cloud, in prepare at step 1"}}) {
        CheckOptions options = strict();
        options.strategies = {{Kind::velocity, id}};
        options.only = {"in.bounds", "det.repeat"};
        const Report report = dsc::conformance::check(library("bad_reads"), options);
        REQUIRE(report.outcomes.size() == 2);
        const std::string fault = std::string("it uses memory beyond the end of ") + input;
        CHECK(report.outcomes[0].test == "in.bounds");
        CHECK(report.outcomes[0].status == Status::fail);
        CHECK(report.outcomes[0].message == fault);
        CHECK(report.outcomes[1].status == Status::skip);
        CHECK(report.outcomes[1].message == "see in.bounds: " + fault);
    }
}

TEST_CASE("a crash is reported with the signal, the call and how to debug it") {
    if (!has_sanitizer("none")) return;
    struct Crash {
        const char* id;
        const char* test;
        const char* message;
    };
    for (const Crash& crash :
         {Crash{"no_cloud", "cloud.hostile",
                "signal 11 (Segmentation fault) in evaluate at step 1"},
          Crash{"aborts", "mesh.hostile", "signal 6 (Aborted) in prepare at step 1"},
          Crash{"divides", "mesh.hostile", "signal 8 (Floating point exception) in prepare at"},
          Crash{"leaves", "mesh.hostile", "it ended the process with exit code 0 in prepare at"},
          Crash{"always", "param.default", "signal 6 (Aborted) in advance at step 1"}}) {
        CheckOptions options = strict();
        options.level = Level::standard;
        options.strategies = {{Kind::velocity, crash.id}};
        const Report report = dsc::conformance::check(library("bad_crashes"), options);
        INFO(dsc::conformance::text(report));
        std::size_t crashes = 0;
        for (const Outcome& o : report.outcomes) {
            if (o.status == Status::pass || o.status == Status::skip) continue;
            ++crashes;
            CHECK(o.test == crash.test);
            CHECK(o.status == Status::crash);
            CHECK(o.message.find(crash.message) == 0);
            CHECK(o.message.find("--in-process --only " + o.test) != std::string::npos);
        }
        CHECK(crashes == 1);
    }
}

TEST_CASE("what a plugin does to its process is told, and goes no further") {
    CheckOptions options = strict();
    options.only = {"lib.bind"};
    options.limit = std::chrono::milliseconds(2000);
    CHECK(failed(dsc::conformance::check(library("bad_crash"), options)) ==
          std::set<std::string>{"lib.bind"});
    options.limit = std::chrono::milliseconds(500);
    const Report hanging = dsc::conformance::check(library("bad_hang"), options);
    REQUIRE(hanging.outcomes.size() == 1);
    if (has_sanitizer("none")) CHECK(hanging.outcomes[0].status == Status::timeout);
}

TEST_CASE("the same seed is the same check, another one tries other parameters") {
    CheckOptions options = strict();
    options.only = {"param.fuzz"};
    options.strategies = {{Kind::velocity, "param_fuzz"}};
    const auto message = [&](std::uint64_t seed) {
        options.seed = seed;
        return dsc::conformance::check(library("bad_parameters"), options).outcomes.back().message;
    };
    CHECK(message(7) == message(7));
    CHECK(message(7) != message(100));
    CHECK(message(7).find("with seed ") == 0);
}
