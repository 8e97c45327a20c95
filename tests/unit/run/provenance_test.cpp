// What a result says about where it comes from, and what it keeps to itself.
#include <algorithm>
#include <cctype>

#include <pwd.h>
#include <sys/utsname.h>
#include <unistd.h>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include <dsc/base/read_file.hpp>
#include <dsc/run/provenance.hpp>
#include <dsc/run/sha256.hpp>

#include "fakes.hpp"

using namespace dsc;
using dsc::test::Folder;
using dsc::test::load_text;
using dsc::test::minimal;
namespace fs = std::filesystem;

namespace {

/// Whether `word` stands in `text` as a word of its own.
bool has_word(const std::string& text, const std::string& word) {
    const auto letter = [](char c) {
        return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
    };
    for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) {
        const std::size_t end = at + word.size();
        if ((at == 0 || !letter(text[at - 1])) && (end == text.size() || !letter(text[end])))
            return true;
    }
    return false;
}

/// The environment of a user of that home, and the folder to be in.
class At {
public:
    At(const fs::path& home, const fs::path& folder) : before_(fs::current_path()) {
        const char* const old = std::getenv("HOME");
        home_ = old == nullptr ? "" : old;
        setenv("HOME", home.c_str(), 1);
        fs::current_path(folder);
    }
    ~At() {
        fs::current_path(before_);
        setenv("HOME", home_.c_str(), 1);
    }
    At(const At&) = delete;
    At& operator=(const At&) = delete;

private:
    fs::path before_;
    std::string home_;
};

}  // namespace

TEST_CASE("the home folder becomes ~ where a path begins with it, and nowhere else") {
    const std::string home = "/home/ann";
    CHECK(run::without_home("/home/ann/a.ply", home) == "~/a.ply");
    CHECK(run::without_home("/home/ann", home) == "~");
    CHECK(run::without_home("input.cloud.file=/home/ann/a.ply", home) ==
          "input.cloud.file=~/a.ply");
    CHECK(run::without_home("/home/ann/x:/home/ann/y", home) == "~/x:~/y");
    CHECK(run::without_home("/home/anna/a.ply", home) == "/home/anna/a.ply");
    CHECK(run::without_home("/home/ann.old/a", home) == "/home/ann.old/a");
    CHECK(run::without_home("/backup/home/ann/a", home) == "/backup/home/ann/a");
    CHECK(run::without_home("a.ply", home) == "a.ply");
    CHECK(run::without_home("/a.ply", "/") == "/a.ply");
    CHECK(run::without_home("/a.ply", "") == "/a.ply");
}

TEST_CASE("provenance: everything that made the result, nobody who made it") {
    const Folder folder;
    const fs::path home = folder.path() / "homes" / "mallory", work = home / "project";
    folder.write("homes/mallory/project/libdsc_fake.so", "stands for a plugin");
    const std::string near = folder.write("homes/mallory/project/near.csv", "x,y,z\n1,2,3\n");
    const std::string far = folder.write("homes/mallory/clouds/far.xyz", "1 2 3\n");
    const dsc::test::Strategies catalogue;
    const At at(home, work);
    utsname machine{};
    uname(&machine);
    const passwd* const user = getpwuid(getuid());

    for (const std::string& file : {near, far}) {
        CAPTURE(file);
        const run::LoadedExperiment loaded =
            load_text(minimal + "seed: 77\ninput: {cloud: {file: " + file + "}}\n");
        const std::string text = run::provenance_json(
            loaded, catalogue, "the hash",
            {home.string() + "/bin/dsc", "run", "a.yaml", "input.cloud.file=" + file}, 3,
            "2024-05-06T07:08:09Z", "2024-05-06T07:08:19Z", 10.25);
        const auto json = nlohmann::json::parse(text);

        CHECK(json["format"] == "dsc-provenance-1");
        CHECK(json["config_sha256"] == "the hash");
        CHECK(json["seed"] == 77);
        CHECK(json["command"][0] == "~/bin/dsc");
        CHECK(json["command"][1] == "run");
        CHECK(json["started"] == "2024-05-06T07:08:09Z");
        CHECK(json["finished"] == "2024-05-06T07:08:19Z");
        CHECK(json["usage"]["wall_s"] == 10.25);
        CHECK(json["usage"]["cpu_s"].get<double>() > 0.0);
        CHECK(json["usage"]["peak_rss_mb"].get<double>() > 1.0);
        for (const char* name : {"dsc", "compiler", "build", "eigen", "boost", "pcl", "openmesh",
                                 "vtk", "embree", "yaml-cpp", "fmt"}) {
            CAPTURE(name);
            CHECK_FALSE(json["versions"][name].get<std::string>().empty());
        }
        CHECK(json["fingerprint"].get<std::string>().find("abi_major=") == 0);
        CHECK(json["plugins"][0]["file"] == "libdsc_fake.so");
        CHECK(json["plugins"][0]["sha256"] == run::sha256("stands for a plugin"));
        REQUIRE(json["inputs"].size() == 1);
        CHECK(json["inputs"][0]["file"] == (file == near ? "near.csv" : "~/clouds/far.xyz"));
        CHECK(json["inputs"][0]["bytes"] == fs::file_size(file));
        CHECK(json["inputs"][0]["sha256"] == run::sha256(read_file(file)));
        CHECK(json["machine"]["threads"] == 3);
        CHECK(json["machine"]["cores"].get<int>() >= 1);
        CHECK(json["machine"]["memory_mb"].get<double>() > 64.0);
        CHECK(json["machine"]["kernel"] == machine.release);
        CHECK_FALSE(json["machine"]["cpu"].get<std::string>().empty());

        CHECK(text.find(home.string()) == std::string::npos);
        CHECK_FALSE(has_word(text, "mallory"));
        CHECK_FALSE(has_word(text, machine.nodename));
        if (user != nullptr) CHECK_FALSE(has_word(text, user->pw_name));
    }
    CHECK(nlohmann::json::parse(run::provenance_json(load_text(minimal), catalogue, "", {}, 1,
                                                     "now", "", 0.0))["finished"]
              .is_null());
}

TEST_CASE("provenance: how the seed varied the cloud") {
    const Folder folder;
    const dsc::test::Strategies catalogue;
    folder.write("libdsc_fake.so", "stands for a plugin");
    const At at(folder.path(), folder.path());
    const std::string file = folder.write("near.csv", "x,y,z\n1,2,3\n");
    const auto variation = [&](const std::string& vary) {
        const run::LoadedExperiment loaded = load_text(
            minimal + "seed: 77\ninput: {cloud: {file: " + file + ", vary: " + vary + "}}\n");
        return nlohmann::json::parse(
            run::provenance_json(loaded, catalogue, "", {}, 1, "now", "", 0.0))["variation"];
    };
    const nlohmann::json turned = variation("{subsample: 0.8, jitter: 0.5}");
    CHECK(turned["seed"] == 77);
    CHECK(turned["subsample"] == 0.8);
    CHECK(turned["jitter_spacings"] == 0.5);
    REQUIRE(turned["rotation"].size() == 4);
    double squares = 0.0;
    for (const auto& part : turned["rotation"]) squares += part.get<double>() * part.get<double>();
    CHECK(squares == doctest::Approx(1.0));
    CHECK(variation("{rotate: false}")["rotation"].is_null());
    CHECK(variation("null").is_null());
}
