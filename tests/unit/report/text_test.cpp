// The small parts of a report: escaping, tables of figures, plots.
#include <cmath>

#include <doctest/doctest.h>

#include <dsc/base/error.hpp>

#include "report/html.hpp"
#include "report/plot.hpp"
#include "report/record.hpp"
#include "run/state_series.hpp"

using namespace dsc;
namespace html = dsc::report::html;

TEST_CASE("text cannot become markup, whatever its bytes are") {
    CHECK(html::text("<script>\"'&</script>") == "&lt;script&gt;&quot;&#39;&amp;&lt;/script&gt;");
    CHECK(html::text("Zeile\n\tzwei \xC3\xA9 \xE2\x82\xAC \xF0\x9F\x98\x80") ==
          "Zeile\n\tzwei \xC3\xA9 \xE2\x82\xAC \xF0\x9F\x98\x80");
    const std::string bad = "\xEF\xBF\xBD";
    CHECK(html::text(std::string("a\0b", 3)) == "a" + bad + "b");
    for (const char* broken : {"\xFF", "\xC0\xBC" /* '<' in two bytes */, "\xE0\x80\xBC",
                               "\xED\xA0\x80", "\xF4\x90\x80\x80", "\xC3", "\xE2\x82"}) {
        const std::string shown = html::text(std::string(broken) + "<");
        CAPTURE(shown);
        CHECK(shown.substr(0, 3) == bad);
        CHECK(shown.substr(shown.size() - 4) == "&lt;");
        CHECK(shown.find(broken) == std::string::npos);
    }
    CHECK(html::json_in_script("{\"a\":\"</script><!--\"}") ==
          "{\"a\":\"\\u003c/script>\\u003c!--\"}");
    CHECK(html::table({"<a>"}, {{"<b>"}}).find("<b>") == std::string::npos);
    CHECK(html::facts({{"<a>", "<i>"}}).find("<i>") == std::string::npos);
}

TEST_CASE("base64 as in RFC 4648, numbers for people") {
    for (const auto& [plain, packed] : {std::pair{"", ""},
                                        {"f", "Zg=="},
                                        {"fo", "Zm8="},
                                        {"foo", "Zm9v"},
                                        {"foob", "Zm9vYg=="},
                                        {"\xFF\xFE\xFD", "//79"}}) {
        CHECK(html::base64(plain) == packed);
    }
    CHECK(html::integer(0) == "0");
    CHECK(html::integer(999) == "999");
    CHECK(html::integer(-1234567) == "-1,234,567");
    CHECK(html::integer(std::nan("")) == "-");
    CHECK(html::real(0.0123456) == "0.01235");
}

TEST_CASE("a page is filled in one pass: what is put in is text") {
    CHECK(html::fill("@a@-@b@-@a@ me@here", {{"a", "@b@"}, {"b", "@a@"}}) == "@b@-@a@-@b@ me@here");
    CHECK_THROWS_AS(html::fill("nothing", {{"a", "x"}}), Error);
}

TEST_CASE("metrics: columns, empty cells, and tables that are none") {
    const report::MetricsTable table =
        report::parse_metrics("step,a,b\n0,1.5,\n1,-2e-3,4\n", "m.csv");
    CHECK(table.rows() == 2);
    REQUIRE(table.find("b") != nullptr);
    CHECK(std::isnan((*table.find("b"))[0]));
    CHECK((*table.find("b"))[1] == 4);
    CHECK((*table.find("a"))[1] == -2e-3);
    CHECK(table.find("c") == nullptr);
    CHECK(report::parse_metrics("", "m.csv").rows() == 0);
    CHECK_THROWS_WITH_AS(report::parse_metrics("step,a\n1\n", "m.csv"),
                         "m.csv:2: 1 cells for 2 columns; run the experiment again", IoError);
    CHECK_THROWS_AS(report::parse_metrics("step\nx\n", "m.csv"), IoError);
}

TEST_CASE("plots: round ticks, gaps, a logarithmic axis, names escaped") {
    CHECK(report::axis_ticks(0, 10, 5) == std::vector<double>{0, 2, 4, 6, 8, 10});
    CHECK(report::axis_ticks(3, 3, 5).empty());
    CHECK_FALSE(std::signbit(report::axis_ticks(0, 10, 5).front()));
    const double none = std::nan("");
    const report::Plot plot{
        .title = "<t>",
        .x_label = "<x>",
        .curves = {{"<c>", {0, 1, 2, 3, 4}, {1, none, 3, 4, 5}}, {"d", {0, 4}, {2, 2}}}};
    const std::string svg = report::svg_plot(plot);
    CHECK(svg.find("<t>") == std::string::npos);
    CHECK(svg.find("<x>") == std::string::npos);
    CHECK(svg.find("<c>") == std::string::npos);
    CHECK(svg.find("&lt;c&gt;") != std::string::npos);
    // Pen up at the gap: the first point is alone, the curve goes on at the third.
    const std::size_t at = svg.find("<path d=\"");
    const std::string d = svg.substr(at + 9, svg.find('"', at + 9) - at - 9);
    CHECK(std::count(d.begin(), d.end(), 'M') == 2);
    CHECK(std::count(d.begin(), d.end(), 'L') == 2);
    CHECK(report::svg_plot({.title = "t", .x_label = "x", .curves = {{"c", {0, 1}, {none, 1}}}})
              .empty());
    CHECK(
        report::svg_plot(
            {.title = "t", .x_label = "x", .curves = {{"c", {0, 1}, {0, -1}}}, .logarithmic = true})
            .empty());
    const std::string logarithmic = report::svg_plot({.title = "t",
                                                      .x_label = "x",
                                                      .curves = {{"c", {0, 1, 2}, {0.001, 0.0, 1}}},
                                                      .logarithmic = true});
    CHECK(logarithmic.find(">0.01<") != std::string::npos);
    CHECK(logarithmic.find("nan") == std::string::npos);
    CHECK(report::svg_plot({.title = "t", .x_label = "x", .curves = {{"c", {0, 1}, {7, 7}}}})
              .find("nan") == std::string::npos);
}

TEST_CASE("histograms count every value once; shares leave out nothing that took time") {
    CHECK(report::count_bins({0, 0.1, 0.5, 0.99, 1, 2, -1, std::nan("")}, 0, 1, 2) ==
          std::vector<std::size_t>{3, 4});
    CHECK(report::svg_histogram("t", "x", 0, 1, {3, 0, 4}).find(": 4<") != std::string::npos);
    const std::string shares = report::svg_shares({{"a", 1}, {"b", 0}, {"c", 3}}, "s");
    CHECK(shares.find("a 1 s") != std::string::npos);
    CHECK(shares.find("b 0 s") == std::string::npos);
    CHECK(shares.find("width=\"705.0\"") != std::string::npos);
    CHECK(report::svg_shares({{"a", 0}}, "s").empty());
}

TEST_CASE("a report keeps a handful of steps, from the first one on, closer at the start") {
    const std::set<std::uint64_t> steps = run::report_steps(140);
    CHECK(steps.size() == run::report_frames - 1);
    CHECK(*steps.begin() == 0);
    CHECK(*steps.rbegin() < 140);
    CHECK(*std::next(steps.begin()) < 140 / 11);
    CHECK(run::report_steps(2) == std::set<std::uint64_t>{0, 1, 2});
    CHECK(run::report_steps(0) == std::set<std::uint64_t>{0});
}
