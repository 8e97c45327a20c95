// The three forms of a report.
#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include <dsc/base/error.hpp>
#include <dsc/conformance/check.hpp>

namespace {

using dsc::conformance::Report;
using dsc::conformance::Status;

Report some_report() {
    Report report;
    report.file = "/plugins/libdsc_a.so";
    report.plugin = "a 1.0.0";
    report.outcomes = {{"lib.entry", "", Status::pass, "", 0.25},
                       {"det.threads", "velocity 'a'", Status::fail, "1 < 2 & \"3\" > \x01", 0.5},
                       {"param.fuzz", "velocity 'a'", Status::crash, "signal 11", 0.25},
                       {"cancel", "velocity 'a'", Status::timeout, "30 s", 30},
                       {"leak", "velocity 'a'", Status::skip, "no memory", 0},
                       {"perf.scale", "velocity 'a'", Status::warn, "slow", 1}};
    return report;
}

}  // namespace

TEST_CASE("text: a line a test, and the sums") {
    const std::string text = dsc::conformance::text(some_report());
    CHECK(text.find("pass    lib.entry        library\n") == 0);
    CHECK(text.find("CRASH   param.fuzz       velocity 'a'                       signal 11\n") !=
          std::string::npos);
    CHECK(text.find("libdsc_a.so FAILS at level standard, seed 1: 1 pass 1 warn 1 skip 1 fail 1 "
                    "crash 1 timeout\n") != std::string::npos);
}

TEST_CASE("JSON: read back") {
    const auto json = nlohmann::json::parse(dsc::conformance::json(some_report()));
    CHECK(json["passed"] == false);
    CHECK(json["outcomes"].size() == 6);
    CHECK(json["outcomes"][1]["status"] == "fail");
    CHECK(json["outcomes"][1]["message"] == "1 < 2 & \"3\" > \x01");
}

TEST_CASE("JUnit: escaped, and no control character that XML has not") {
    const std::string xml = dsc::conformance::junit(some_report());
    CHECK(xml.find("tests=\"6\" failures=\"1\" errors=\"2\" skipped=\"1\"") != std::string::npos);
    CHECK(xml.find("<failure message=\"1 &lt; 2 &amp; &quot;3&quot; &gt; ?\" type=\"fail\"/>") !=
          std::string::npos);
    CHECK(xml.find("<testcase classname=\"a 1.0.0\" name=\"lib.entry\" time=\"0.250\"/>") !=
          std::string::npos);
    CHECK(xml.find('\x01') == std::string::npos);
}

TEST_CASE("faults of the call itself") {
    dsc::conformance::CheckOptions options;
    CHECK_THROWS_AS(dsc::conformance::check("/nonexistent/libdsc_a.so", options), dsc::PluginError);
    options.only = {"det.thread"};
    try {
        dsc::conformance::check(DSC_TEST_PLUGINS "/libdsc_good.so", options);
        FAIL("an unknown test");
    } catch (const dsc::UsageError& error) {
        CHECK(std::string(error.what()).find("did you mean 'det.threads'?") != std::string::npos);
    }
    options.only.clear();
    options.strategies = {{dsc::plugin::Kind::velocity, "none"}};
    CHECK_THROWS_AS(dsc::conformance::check(DSC_TEST_PLUGINS "/libdsc_good.so", options),
                    dsc::UsageError);
}
