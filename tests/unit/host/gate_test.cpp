// Every way of not being a plugin, with its exact text. The fixtures of the first part end the
// process if any of their code runs (tests/plugins/tripwire.hpp): that these tests end at all shows
// that the gate reads and does not load.
#include <doctest/doctest.h>

#include <dsc/plugin/entry.hpp>

#include "support.hpp"

namespace {
using support::fixture;
using support::refusal;
namespace fs = std::filesystem;

const std::string size = std::to_string(sizeof(dsc::plugin::PluginEntry));
}  // namespace

TEST_CASE("a file that is not there") {
    const auto [code, text] = refusal("/nowhere/libdsc_x.so");
    CHECK(code == "plugin.open");
    CHECK(text == "/nowhere/libdsc_x.so: cannot be opened (No such file or directory); check its "
                  "name and permissions");
}

TEST_CASE("a folder where a file is due") {
    const support::TemporaryFolder folder;
    const auto [code, text] = refusal(folder.path());
    CHECK(code == "plugin.open");
    CHECK(text == folder.path().string() +
                      ": is a folder, not a library; give the file libdsc_NAME.so in it");
}

TEST_CASE("files that are no libraries") {
    const support::TemporaryFolder folder;
    for (const std::string& bytes :
         {std::string(), std::string("#!/bin/sh\n"), std::string("\x7f"), std::string(500, 'x')}) {
        const fs::path file = folder.write("libdsc_text.so", bytes);
        const auto [code, text] = refusal(file);
        CHECK(code == "plugin.not_elf");
        CHECK(text == file.string() +
                          ": is not a shared library; give the file of a plugin, libdsc_NAME.so");
    }
    // A program is ELF too, but nothing to load.
    std::string header = support::read(fixture("good")).substr(0, 64);
    header[16] = 1;  // a relocatable object
    const fs::path object = folder.write("libdsc_object.so", header);
    CHECK(refusal(object).text ==
          object.string() + ": is not a shared library for this machine; build it on this machine");
}

TEST_CASE("a library cut short anywhere is refused and crashes nothing") {
    const support::TemporaryFolder folder;
    const std::string whole = support::read(fixture("good"));
    for (std::size_t part = 0; part < 64; ++part) {
        const fs::path file =
            folder.write("libdsc_cut.so", whole.substr(0, whole.size() * part / 64));
        CHECK(refusal(file).code == "plugin.not_elf");
    }
    const fs::path file = folder.write("libdsc_cut.so", whole.substr(0, whole.size() - 1));
    CHECK(refusal(file).text ==
          file.string() + ": is a damaged or truncated shared library; build or copy it again");
}

TEST_CASE("a library without an entry") {
    const auto [code, text] = refusal(fixture("bad_no_entry"));
    CHECK(code == "plugin.no_entry");
    CHECK(text == fixture("bad_no_entry").string() +
                      ": is a library without the symbol dsc_plugin_entry; write one "
                      "DSC_PLUGIN(...) { ... } in one source file of the plugin");
}

TEST_CASE("an entry that is none") {
    for (const char* name : {"bad_magic", "bad_short_entry"}) {
        const auto [code, text] = refusal(fixture(name));
        CHECK(code == "plugin.magic");
        CHECK(text == fixture(name).string() +
                          ": has a symbol dsc_plugin_entry that is not a valid plugin entry; write "
                          "the entry with DSC_PLUGIN(...) { ... }, never by hand");
    }
}

TEST_CASE("an entry of another size") {
    const auto [code, text] = refusal(fixture("bad_size"));
    CHECK(code == "plugin.size");
    CHECK(text == fixture("bad_size").string() + ": has an entry of " +
                      std::to_string(sizeof(dsc::plugin::PluginEntry) - 8) +
                      " bytes instead of the expected " + size +
                      " bytes; rebuild it with the headers of this dsc");
}

TEST_CASE("other versions of the ABI") {
    CHECK(refusal(fixture("bad_abi_old")).code == "plugin.abi");
    CHECK(refusal(fixture("bad_abi_old")).text ==
          fixture("bad_abi_old").string() + ": was built for ABI 7.0, this dsc has ABI 8.0; "
                                            "rebuild it with the headers of this dsc");
    CHECK(refusal(fixture("bad_abi_new")).code == "plugin.abi");
    CHECK(refusal(fixture("bad_abi_new")).text ==
          fixture("bad_abi_new").string() +
              ": needs ABI 8.1, this dsc has ABI 8.0; install a newer dsc, or rebuild the plugin "
              "with the headers of this one");
}

namespace {

// The text of a refusal for one differing key; the plugin's fingerprint is the core's with that key
// changed.
std::string fingerprint_text(const std::string& name, const std::string& key,
                             const std::string& theirs) {
    std::string ours(dsc::plugin::core_fingerprint());
    const std::size_t begin = ours.find(";" + key + "=") + key.size() + 2;
    const std::string own = ours.substr(begin, ours.find(';', begin) - begin);
    std::string plugin = ours;
    plugin.replace(begin, own.size(), theirs);
    return fixture(name).string() + ": was built differently from this dsc: " + key + " is '" +
           theirs + "' in the plugin and '" + own +
           "' in dsc; build it with dsc_add_plugin and the compiler options of this dsc (-march "
           "and -mavx change " +
           "align)\n  plugin: " + plugin + "\n  dsc:    " + ours;
}

}  // namespace

TEST_CASE("plugins built in another way are refused with both fingerprints") {
    CHECK(refusal(fixture("bad_debug_stl")).code == "plugin.fingerprint");
    CHECK(refusal(fixture("bad_debug_stl")).text ==
          fingerprint_text("bad_debug_stl", "dbgstl", "1"));
    const bool has_align = fs::exists(fs::path(DSC_TEST_PLUGINS) / "libdsc_bad_align.so");
    if (has_align)
        CHECK(refusal(fixture("bad_align")).text == fingerprint_text("bad_align", "align", "32"));
    const bool has_sanitizer = fs::exists(fs::path(DSC_TEST_PLUGINS) / "libdsc_bad_sanitizer.so");
    if (has_sanitizer) {
        CHECK(refusal(fixture("bad_sanitizer")).text ==
              fingerprint_text("bad_sanitizer", "san", "address"));
    }
}

TEST_CASE("a library whose needs cannot be met") {
    const auto [code, text] = refusal(fixture("bad_symbol"));
    CHECK(code == "plugin.load");
    CHECK(text == fixture("bad_symbol").string() +
                      ": does not load: " + fixture("bad_symbol").string() +
                      ": undefined symbol: dsc_test_missing_function; a symbol or library that it "
                      "needs is missing; link with -Wl,-z,defs to find it at build time");
}

TEST_CASE("plugins that register something wrong") {
    const auto expect = [](const std::string& name, const std::string& cause) {
        const auto [code, text] = refusal(fixture(name));
        CHECK(code == "plugin.enroll");
        CHECK(text ==
              fixture(name).string() + ": " + cause + "; report this to the plugin's authors");
    };
    expect("bad_no_enroll", "has no enroll function");
    expect("bad_name", "has the name 'Bad Name', which is not of the form [a-z][a-z0-9_]*");
    expect("bad_throws", "plugin 'bad_throws' failed to register: the licence server is away");
    expect("bad_throws_int", "plugin 'bad_throws_int' failed to register: it threw something that "
                             "is not a std::exception");
    expect("bad_empty", "plugin 'bad_empty' registers no strategy");
    expect("bad_id", "plugin 'bad_id' failed to register: velocity 'Stand-Still': its id is not "
                     "of the form [a-z][a-z0-9_]*");
    expect("bad_twice",
           "plugin 'bad_twice' failed to register: velocity 'still': it is registered twice");
    const auto silent = refusal(fixture("bad_schema"));
    CHECK(silent.code == "plugin.enroll");
    CHECK(silent.text.find("plugin 'bad_schema' failed to register: ") != std::string::npos);
    CHECK(silent.text.find("mystery") != std::string::npos);
}

TEST_CASE("libraries that others may write are refused") {
    const support::TemporaryFolder folder;
    const fs::path file = folder.copy("good");
    CHECK(refusal(file).text.empty());

    fs::permissions(file, fs::perms::others_write, fs::perm_options::add);
    CHECK(refusal(file).code == "plugin.writable");
    CHECK(refusal(file).text ==
          file.string() +
              ": can be written by everyone, and loading a plugin runs its code; remove this "
              "permission (chmod o-w) or move the plugin to your own folder");
    fs::permissions(file, fs::perms::others_write, fs::perm_options::remove);

    fs::permissions(folder.path(), fs::perms::all);
    CHECK(refusal(file).code == "plugin.writable");
    CHECK(refusal(file).text.find(folder.path().string() + ": can be written by everyone") == 0);
    // As in the system's folder for temporary files: nobody else can replace the named file, but
    // anyone can add one.
    fs::permissions(folder.path(), fs::perms::all | fs::perms::sticky_bit);
    CHECK(refusal(file).text.empty());
    dsc::host::Host host;
    const std::vector<dsc::host::SearchEntry> entries = {{folder.path(), "--plugin", true}};
    CHECK_THROWS_WITH_AS(host.load_all(entries), doctest::Contains("can be written by everyone"),
                         dsc::PluginError);
}
