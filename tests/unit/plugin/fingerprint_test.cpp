#include <string>

#include <doctest/doctest.h>

#include <dsc/plugin/entry.hpp>

using dsc::plugin::compare_fingerprints;

namespace {
void enroll(dsc::plugin::Registrar&) {}
}  // namespace

TEST_CASE("equal fingerprints do not differ, in any order of their keys") {
    const std::string own(dsc::plugin::core_fingerprint());
    CHECK(compare_fingerprints(own, own).empty());
    CHECK(compare_fingerprints("b=2;a=1", "a=1;b=2").empty());
}

TEST_CASE("every key that memory layouts hang on is hard, the others are soft") {
    const std::string own(dsc::plugin::core_fingerprint());
    for (const std::string key : {"abi_major", "cxx11abi", "eigen", "align", "real", "index",
                                  "dbgstl", "san", "compiler", "cxx", "build"}) {
        std::string other = own;
        const std::size_t at = (";" + other).find(";" + key + "=");
        REQUIRE(at != std::string::npos);
        other.insert(at + key.size() + 1, "x");
        const auto differences = compare_fingerprints(other, own);
        REQUIRE(differences.size() == 1);
        CHECK(differences[0].key == key);
        CHECK(differences[0].plugin == "x" + differences[0].host);
        CHECK(differences[0].hard == (key != "compiler" && key != "cxx" && key != "build"));
    }
}

TEST_CASE("missing and additional keys") {
    const auto differences = compare_fingerprints("align=16;extra=1", "real=f64;align=16");
    REQUIRE(differences.size() == 2);
    CHECK(differences[0].key == "real");
    CHECK(differences[0].plugin.empty());
    CHECK(differences[0].hard);
    CHECK(differences[1].key == "extra");
    CHECK(differences[1].host.empty());
    CHECK_FALSE(differences[1].hard);
    CHECK(compare_fingerprints("", dsc::plugin::core_fingerprint()).size() == 11);
}

TEST_CASE("an entry holds what it was made of and fits the longest fingerprint") {
    constexpr dsc::plugin::PluginEntry entry =
        dsc::plugin::make_entry(&enroll, "name", "1.0.0", "MIT", "what it does");
    CHECK(entry.magic == dsc::plugin::entry_magic);
    CHECK(entry.struct_size == sizeof(dsc::plugin::PluginEntry));
    CHECK(std::string(entry.fingerprint) == dsc::plugin::core_fingerprint());
    CHECK(std::string(entry.summary) == "what it does");
    CHECK(std::string(entry.authors).empty());
    CHECK_THROWS_AS(
        dsc::plugin::make_entry(&enroll, std::string(64, 'n'), "1", "MIT", "too long a name"),
        std::length_error);
}
