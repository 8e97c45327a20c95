#include <memory>
#include <string>

#include <doctest/doctest.h>

#include <dsc/config/diagnostics.hpp>

#include "support.hpp"

using namespace dsc::config;

namespace {

std::shared_ptr<const SourceText> text(const std::string& name, const std::string& content) {
    return std::make_shared<const SourceText>(SourceText{SourceText::Kind::file, name, content});
}

}  // namespace

TEST_CASE("diagnostics of a file are sorted by place, files keep their order") {
    const auto a = text("a.yaml", "one\ntwo\nthree\n");
    const auto b = text("b.yaml", "four\n");
    Diagnostics diagnostics;
    diagnostics.error("config.x", {a, 3, 1, 5}, "third");
    diagnostics.error("config.y", {b, 1, 2, 2}, "fourth", "hint", {"note"});
    diagnostics.error("config.z", {a, 1, 2, 99}, "first");
    diagnostics.warning("config.w", {a, 2, 1, 3}, "second");
    diagnostics.error("config.x", {}, "fifth", "somewhere");
    CHECK(diagnostics.error_count() == 4);
    CHECK(test::error_of([&] { diagnostics.throw_if_errors(); }) == "a.yaml:1:2: error: first\n"
                                                                    "    1 | one\n"
                                                                    "      |  ^~\n"
                                                                    "a.yaml:3:1: error: third\n"
                                                                    "    3 | three\n"
                                                                    "      | ^~~~~\n"
                                                                    "b.yaml:1:2: error: fourth\n"
                                                                    "    1 | four\n"
                                                                    "      |  ^~  hint\n"
                                                                    "      note: note\n"
                                                                    "built in: error: fifth\n"
                                                                    "      note: somewhere\n"
                                                                    "4 errors; nothing was run");
    CHECK(diagnostics.text(Severity::warning) == "a.yaml:2:1: warning: second\n"
                                                 "    2 | two\n"
                                                 "      | ^~~\n");
}

TEST_CASE("warnings alone do not throw") {
    Diagnostics diagnostics;
    diagnostics.warning("config.w", {}, "careful");
    CHECK_NOTHROW(diagnostics.throw_if_errors());
    CHECK_FALSE(diagnostics.has_errors());
}

TEST_CASE("the code is that of the only error") {
    Diagnostics one;
    one.error("config.x", {}, "a");
    CHECK(test::code_of([&] { one.throw_if_errors(); }) == "config.x");
    one.error("config.x", {}, "b");
    CHECK(test::code_of([&] { one.throw_if_errors(); }) == "config.invalid");
}

TEST_CASE("a long line is cut round the caret") {
    const std::string line = std::string(500, 'a') + "X" + std::string(500, 'b');
    Diagnostics diagnostics;
    diagnostics.error("config.x", {text("a.yaml", line), 1, 501, 1}, "m");
    CHECK(diagnostics.text(Severity::error) == "a.yaml:1:501: error: m\n"
                                               "    1 | ..." +
                                                   std::string(60, 'a') + "X" +
                                                   std::string(59, 'b') +
                                                   "...\n"
                                                   "      | " +
                                                   std::string(63, ' ') + "^\n");
}

TEST_CASE("control characters never reach the terminal, and carets count characters") {
    Diagnostics diagnostics;
    diagnostics.error("config.x", {text("a.yaml", "\x1b[2J\t\xc3\xa9\xff: bad"), 1, 7, 1}, "m");
    CHECK(diagnostics.text(Severity::error) == "a.yaml:1:7: error: m\n"
                                               "    1 |  [2J \xc3\xa9?: bad\n"
                                               "      |       ^\n");
}

TEST_CASE("a flood of faults is cut, but counted") {
    Diagnostics diagnostics;
    for (int i = 0; i < 5000; ++i) diagnostics.error("config.x", {}, "m");
    const std::string message = test::error_of([&] { diagnostics.throw_if_errors(); });
    CHECK(message.size() < 5000);
    CHECK(message.find("... and 4900 more\n5000 errors; nothing was run") != std::string::npos);
}
