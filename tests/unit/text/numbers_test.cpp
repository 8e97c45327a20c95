// Numbers as text and back.
#include <cmath>
#include <cstdio>
#include <limits>

#include <doctest/doctest.h>

#include <dsc/text/numbers.hpp>

namespace text = dsc::text;
using text::Number;

TEST_CASE("texts of numbers are those of printf") {
    const double infinity = std::numeric_limits<double>::infinity();
    for (const double value : {0.0, -0.0, 1.0, 0.1, -2.5, 1e-7, 123456.5, 1234567.0, 1e100, 5e-324,
                               1.0 / 3.0, infinity, -infinity}) {
        char expected[400];
        for (const int digits : {1, 4, 6, 12, 17}) {
            std::snprintf(expected, sizeof expected, "%.*g", digits, value);
            CHECK(text::rounded(value, digits) == expected);
            std::snprintf(expected, sizeof expected, "%.*f", digits, value);
            CHECK(text::fixed(value, digits) == expected);
        }
    }
}

TEST_CASE("exact texts read back to the same number") {
    for (const double value : {0.1, -0.0, 1.0 / 3.0, 5e-324, 1.7976931348623157e308}) {
        double read = 1.0;
        CHECK(text::parse_number(text::exact(value), read) == Number::ok);
        CHECK(read == value);
        CHECK(std::signbit(read) == std::signbit(value));
    }
    std::string out = "n ";
    text::append_number(out, 0.5F);
    text::append_number(out, std::uint64_t{18446744073709551615U});
    CHECK(out == "n 0.518446744073709551615");
}

TEST_CASE("what is a number") {
    const auto kind = [](std::string_view word) {
        double value = 0.0;
        return text::parse_number(word, value);
    };
    for (const char* word : {"1", "+1", "-1", ".5", "5.", "1e5", "1E-5", "1e-999"})
        CHECK(kind(word) == Number::ok);
    for (const char* word : {"", "+", "++1", "+-1", "1x", "0x1", "1,5", " 1", "one"})
        CHECK(kind(word) == Number::not_a_number);
    for (const char* word : {"nan", "NaN", "inf", "-inf", "+inf"})
        CHECK(kind(word) == Number::not_finite);
    for (const char* word : {"1e999", "-1e999"}) CHECK(kind(word) == Number::too_large);
    double small = 1.0;
    text::parse_number("1e-999", small);
    CHECK(small == 0.0);
}

TEST_CASE("integers") {
    std::size_t count = 0;
    CHECK(text::parse_count("12", count));
    CHECK(count == 12);
    for (const char* word : {"", "-1", "+1", "1.0", "18446744073709551616"})
        CHECK_FALSE(text::parse_count(word, count));
    std::int64_t value = 0;
    CHECK(text::parse_integer("+7", value));
    CHECK(value == 7);
    CHECK(text::parse_integer("-7", value));
    CHECK(value == -7);
    for (const char* word : {"", "+", "+-7", "7.0", "99999999999999999999"})
        CHECK_FALSE(text::parse_integer(word, value));
}

TEST_CASE("decimal commas") {
    for (const char* word : {"1,5", "-2,5e3", "1,234.5", "1,234,567"})
        CHECK(text::has_decimal_comma(word));
    for (const char* word : {"1.5", ",5", "5,", "a,b", "1,23,4"})
        CHECK_FALSE(text::has_decimal_comma(word));
}
