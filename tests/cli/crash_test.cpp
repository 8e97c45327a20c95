// A crash inside a strategy: the strategy is named, exit 4, the last good state is kept.
#include <csignal>
#include <string>
#include <utility>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include <dsc/plugin/fingerprint.hpp>

#include "process.hpp"

using dsc::test::Cli;
using dsc::test::Result;

namespace {

/// A sanitizer reports crashes itself.
bool sanitized() {
    return dsc::plugin::core_fingerprint().find("san=none") == std::string_view::npos;
}

void write_experiment(const Cli& cli, const std::string& fault) {
    cli.write("a.yaml", "dsc: 1\nname: faulty\ninitial_mesh: {type: grid, cells: 24, half_width: "
                        "0.5}\nvelocity: {type: faulty, fault: " +
                            fault +
                            ", step: 3}\nimprovement: {type: dsc}\nschedule: [{steps: 5}]\n");
}

Result run(const Cli& cli, const std::string& fault, const std::string& threads = "1") {
    write_experiment(cli, fault);
    return cli.dsc(
        {"run", "a.yaml", "-o", "out", "--threads", threads, "--plugin", DSC_TEST_FAULTY});
}

/// The state after two steps, without a fault.
std::string good_state(const Cli& cli) {
    cli.write("good.yaml", "dsc: 1\ninitial_mesh: {type: grid, cells: 24, half_width: 0.5}\n"
                           "velocity: {type: faulty}\nimprovement: {type: dsc}\n"
                           "schedule: [{steps: 2}]\noutput: {volume: [dsc]}\n");
    REQUIRE(cli.dsc({"run", "good.yaml", "-o", "good", "-q", "--plugin", DSC_TEST_FAULTY}).code ==
            0);
    return cli.read("good/result/volume.dsc");
}

struct Crash {
    const char* fault;
    const char* hook;
    const char* cause;
};

constexpr Crash crashes[] = {
    {"segfaults", "evaluate", "signal 11 (segmentation fault): it used the address 0x0, which"},
    {"aborts", "evaluate", "signal 6 (abort): it called abort()"},
    {"divides", "evaluate", "signal 8 (arithmetic error): it divided an integer by zero"},
    {"overflows", "evaluate", "signal 11 (segmentation fault): its stack overflowed"},
    {"reads_beyond_a_file", "evaluate", "signal 7 (bus error): it used memory beyond the end"},
    {"executes_nonsense", "evaluate", "signal 4 (illegal instruction): it sent this signal"},
    {"terminates", "evaluate", "signal 6 (abort): it called abort()"},
    {"crashes_in_its_loop", "prepare", "signal 11 (segmentation fault): it used the address 0x0"},
};

}  // namespace

TEST_CASE("a crash names the strategy, the folder says failed, the last good state is kept") {
    if (sanitized()) return;
    const Cli good;
    const std::string expected = good_state(good);
    for (const Crash& crash : crashes) {
        for (const char* threads : {"1", "4"}) {
            CAPTURE(std::string(crash.fault));
            CAPTURE(std::string(threads));
            const Cli cli;
            const Result result = run(cli, crash.fault, threads);
            CHECK(result.code == 4);
            const std::string who = "velocity 'faulty' (plugin faulty 0.3.0, " DSC_TEST_FAULTY
                                    ", at 'velocity' in the experiment, a.yaml:4:11): " +
                                    std::string(crash.hook) + " at step 3 crashed with " +
                                    crash.cause;
            INFO(result.err);
            CHECK(result.err.find("error: " + who) != std::string::npos);
            CHECK(result.err.find("the state after step 2 is kept in out/last_good") !=
                  std::string::npos);
            CHECK_FALSE(dsc::test::looks_finished(cli.folder() / "out"));
            const auto status = nlohmann::json::parse(cli.read("out/status.json"));
            CHECK(status["state"] == "failed");
            CHECK(status["exit_code"] == 4);
            CHECK(status["error_code"] == "strategy.crash");
            CHECK(status["error"].get<std::string>().find(who) == 0);
            CHECK((cli.read("out/last_good/volume.dsc") == expected));
        }
    }
}

TEST_CASE("a damaged heap: the message and the exit code are the same") {
    if (sanitized()) return;
    const Cli cli;
    const Result result = run(cli, "damages_heap");
    CHECK(result.code == 4);
    CHECK(result.err.find("evaluate at step 3 crashed with signal ") != std::string::npos);
    CHECK(cli.read("out/status.json").find("\"strategy.crash\"") != std::string::npos);
}

TEST_CASE("a thread that a plugin has started: the plugin is named") {
    if (sanitized()) return;
    const Cli cli;
    const Result result = run(cli, "crashes_in_its_thread");
    CHECK(result.code == 4);
    CHECK(result.err.find("error: plugin faulty (" DSC_TEST_FAULTY
                          ") crashed in a thread of its own with signal 11 (segmentation fault)") !=
          std::string::npos);
    CHECK(cli.read("out/status.json").find("\"strategy.crash\"") != std::string::npos);
}

TEST_CASE("exit() also keeps the last good state") {
    const Cli good;
    const std::string expected = good_state(good);
    for (const char* fault : {"exits", "quick_exits", "ends"}) {
        const Cli cli;
        CHECK(run(cli, fault, "4").code == 4);
        CHECK((cli.read("out/last_good/volume.dsc") == expected));
    }
}

TEST_CASE("a signal from another process is not a crash") {
    if (sanitized()) return;
    const Cli cli;
    const Result result = run(cli, "gets_a_signal");
    CHECK(result.code == 128 + SIGSEGV);
    CHECK(result.err.find("crashed") == std::string::npos);
}

TEST_CASE("DSC_CORE_DUMP=1: the process ends by the signal, after the same report") {
    if (sanitized()) return;
    for (const auto& [fault, signal] : {std::pair("segfaults", SIGSEGV), {"aborts", SIGABRT}}) {
        Cli cli;
        cli.environment["DSC_CORE_DUMP"] = "1";
        const Result result = run(cli, fault);
        CHECK(result.code == 128 + signal);
        CHECK(cli.read("out/status.json").find("\"strategy.crash\"") != std::string::npos);
        CHECK(cli.exists("out/last_good/volume.dsc"));
    }
}

TEST_CASE("a crash of dsc itself: exit 1, and no strategy is blamed") {
    if (sanitized()) return;
    const Cli cli;
    write_experiment(cli, "none");
    const Result result = cli.program(DSC_TEST_CRASH_OUTSIDE, {"a.yaml", "out", DSC_TEST_FAULTY});
    CHECK(result.code == 1);
    CHECK(result.err.find("error: internal: dsc crashed outside every strategy with signal 11 "
                          "(segmentation fault): it used the address 0x0") == 0);
    CHECK(result.err.find("please report it") != std::string::npos);
    const auto status = nlohmann::json::parse(cli.read("out/status.json"));
    CHECK(status["state"] == "failed");
    CHECK(status["exit_code"] == 1);
    CHECK(status["error_code"] == "internal.crash");
}
