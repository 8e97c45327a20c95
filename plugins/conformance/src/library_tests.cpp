// lib.*: the file, its entry, and the effects of loading it.
#include <regex>

#include <unistd.h>

#include <fmt/core.h>

#include <dsc/base/error.hpp>
#include <dsc/host/doctor.hpp>
#include <dsc/plugin/script_loader.hpp>

#include "process.hpp"
#include "test_table.hpp"

namespace dsc::conformance {
namespace {

namespace fs = std::filesystem;

// Fails with the doctor's message if one of these steps fails; skips if another step fails, which
// the test `before` reports.
void require_steps(const Subject& subject, std::initializer_list<std::string_view> mine,
                   std::string_view before) {
    for (const host::Examination& e : host::examine(subject.file(), {})) {
        if (e.result != host::Examination::Result::failed) continue;
        for (const std::string_view step : mine) {
            if (e.step == step) throw Failed(e.text);
        }
        throw Skipped("the library fails " + std::string(before) + ": " + e.text);
    }
}

plugin::PluginInfo info_of(const fs::path& file) {
    host::Host host;
    host.load(file);
    return host.plugins().front();
}

void entry(const Subject& subject) {
    require_steps(subject, {"file", "permissions", "library", "build", "register"}, "lib.bind");
    const plugin::PluginInfo info = info_of(subject.file());
    require(plugin::is_script(subject.file()) ||
                subject.file().filename() == "libdsc_" + info.name + ".so",
            "the file of plugin '" + info.name + "' must be libdsc_" + info.name + ".so");
    static const std::regex semver(
        R"((0|[1-9]\d*)\.(0|[1-9]\d*)\.(0|[1-9]\d*)([-+][0-9A-Za-z.+-]+)?)");
    require(std::regex_match(info.version, semver),
            "the version '" + info.version + "' is not a semantic version, MAJOR.MINOR.PATCH");
    static const std::regex spdx(R"([A-Za-z0-9][A-Za-z0-9.+ ()-]*)");
    require(
        std::regex_match(info.license, spdx),
        "the licence '" + info.license + "' is not an SPDX expression such as MIT or BSD-3-Clause");
    require(!info.summary.empty(), "the plugin has no summary");
}

void bind(const Subject& subject) { require_steps(subject, {"load"}, "lib.entry"); }

// For tests of loading: the library must not yet be loaded in this process.
void load(host::Host& host, const Subject& subject) {
    try {
        host.load(subject.file());
    } catch (const Error& error) {
        throw Skipped(std::string("it does not load; see lib.entry and lib.bind: ") + error.what());
    }
}

std::size_t count_entries(const char* folder) {
    std::size_t count = 0;
    std::error_code error;
    for (auto i = fs::directory_iterator(folder, error); i != fs::directory_iterator(); ++i)
        ++count;
    return count;
}

// A list of plugins loads them: loading must be quick, and must add nothing except the strategies.
void scan(const Subject& subject) {
    const std::size_t files = count_entries("/proc/self/fd");
    const std::size_t threads = count_entries("/proc/self/task");
    const std::size_t printed = printed_so_far();
    const double begin = cpu_seconds();
    host::Host host;
    load(host, subject);
    const double seconds = cpu_seconds() - begin;
    require(count_entries("/proc/self/task") == threads, "it starts a thread when it is loaded");
    require(count_entries("/proc/self/fd") == files,
            "it leaves a file or socket open when it is loaded");
    const bool silent = printed_so_far() == printed;
    require(silent, "it prints text when it is loaded: " + printed_since(printed));
    if (seconds > 5) throw Failed(fmt::format("it takes {:f} s to load", seconds));
    if (seconds > 0.5)
        throw Warned(fmt::format("it takes {:f} s to load; plugins should load quickly, because a "
                                 "list of plugins loads them all",
                                 seconds));
}

std::string names(const host::Host& host) {
    std::string text;
    for (const plugin::StrategyInfo& info : host.list()) {
        text +=
            std::string(plugin::kind_name(info.strategy->kind)) + " " + info.strategy->id + ": ";
        for (const std::string& name : info.strategy->schema->names()) text += name + " ";
        text += "\n";
    }
    return text;
}

void twice(const Subject& subject) {
    host::Host first;
    load(first, subject);
    host::Host second;
    try {
        second.load(subject.file());
    } catch (const Error& error) {
        throw Failed(std::string("a second host cannot load it: ") + error.what());
    }
    require(names(first) == names(second),
            "a second host gets different strategies or parameters from the first one");
}

}  // namespace

void add_library_tests(std::vector<Test>& table) {
    add(table,
        {"lib.entry", Level::smoke, true,
         "The host accepts the file; its name, version, licence and ids are well-formed."},
        entry);
    add(table,
        {"lib.bind", Level::smoke, true, "It loads by itself: no symbol or library is missing."},
        bind);
    add(table,
        {"lib.scan", Level::smoke, true,
         "It loads quickly, starts no thread, leaves no file open and prints nothing."},
        scan);
    add(table,
        {"lib.twice", Level::standard, true, "Two hosts in one process get the same strategies."},
        twice);
}

}  // namespace dsc::conformance
