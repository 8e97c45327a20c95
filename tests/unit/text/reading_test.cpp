// Lines, fields and tokens, and the places in errors.
#include <vector>

#include <doctest/doctest.h>

#include <dsc/base/error.hpp>
#include <dsc/text/reading.hpp>

namespace text = dsc::text;

namespace {

std::vector<std::string> lines_of(std::string_view content, bool join = false) {
    text::Lines lines(content, "f", join);
    std::vector<std::string> out;
    for (std::string_view line; lines.next(line);)
        out.push_back(std::to_string(lines.number()) + ":" + std::string(line));
    return out;
}

template <class Read>
std::string error_of(Read&& read) {
    try {
        read();
    } catch (const dsc::IoError& error) {
        return error.code() + " " + error.what();
    }
    return "no error";
}

}  // namespace

TEST_CASE("lines end with LF, CR LF or CR") {
    CHECK(lines_of("a\nb\r\nc\rd") == std::vector<std::string>{"1:a", "2:b", "3:c", "4:d"});
    CHECK(lines_of("\n\r\n\rx\n") == std::vector<std::string>{"1:", "2:", "3:", "4:x"});
    CHECK(lines_of("").empty());
}

TEST_CASE("a backslash joins lines on request") {
    CHECK(lines_of("v 1 \\\n2 \\\r\n3\nnext", true) ==
          std::vector<std::string>{"1:v 1  2  3", "4:next"});
    CHECK(lines_of("a\\\nb") == std::vector<std::string>{"1:a\\", "2:b"});
    CHECK(lines_of("a\\", true) == std::vector<std::string>{"1:a "});
}

TEST_CASE("a text without a line end may be cut off") {
    text::Lines lines("a\nb");
    std::string_view line;
    CHECK(lines.next(line));
    CHECK(lines.terminated());
    CHECK_FALSE(lines.cut());
    CHECK(lines.next(line));
    CHECK_FALSE(lines.terminated());
    CHECK(lines.cut());
    CHECK_FALSE(lines.next(line));
}

TEST_CASE("tokens know their line") {
    text::Tokens tokens("1 2.5\n\n nan", "f");
    CHECK(tokens.integer() == 1);
    CHECK(tokens.more_on_line());
    CHECK(tokens.coordinate() == 2.5);
    CHECK_FALSE(tokens.more_on_line());
    CHECK(error_of([&] { tokens.coordinate(); }) ==
          "io.not_finite f:3: coordinate 'nan' is NaN or infinite; remove the point and its faces "
          "or export the file again");
    CHECK(error_of([&] { tokens.value(); }) ==
          "io.truncated f:3: the file ends where a number should be; the file is incomplete: copy "
          "or export it again");
}

TEST_CASE("numbers that are not accepted name their place") {
    const text::Place place{"f", 7};
    CHECK(error_of([&] { text::read_value("1e999", place); }) ==
          "io.not_finite f:7: '1e999' is out of the range of a double; correct the line or export "
          "the file again");
    CHECK(error_of([&] { text::read_value("x", place); }) ==
          "io.syntax f:7: 'x' is not a number; correct the line or export the file again");
    CHECK(error_of([&] { text::read_value("1,5", place); }) ==
          "io.syntax f:7: '1,5' is not a number; write decimals with a point, not with a comma");
    CHECK(error_of([&] {
              text::read_integer("1.0", {"f", 0});
          }) == "io.syntax f: '1.0' is not an integer; correct the line or export the file again");
    CHECK(text::read_value("1e-999", place) == 0.0);
}
