// Blanks, case, names, quotes, plurals, UTF-8.
#include <doctest/doctest.h>

#include <dsc/text/utf8.hpp>
#include <dsc/text/words.hpp>

namespace text = dsc::text;

TEST_CASE("words are divided by blanks") {
    std::string_view rest = " \tone\r two\v ";
    CHECK(text::next_word(rest) == "one");
    CHECK(text::next_word(rest) == "two");
    CHECK(text::next_word(rest).empty());
    CHECK(text::trim("\t a b \r") == "a b");
    CHECK(text::trim(" \f ").empty());
}

TEST_CASE("a word is not found inside another one") {
    CHECK(text::find_word("speeds speed", "speed") == 7);
    CHECK(text::find_word("_a a1 a-b", "a") == 6);
    CHECK(text::find_word("aa", "a") == std::string_view::npos);
}

TEST_CASE("lower case changes ASCII letters only") {
    CHECK(text::lower_case("AbZ\xC3\x84_9") == "abz\xC3\x84_9");
    CHECK(text::lower_case_extension("a.b/Scan.PLY") == ".ply");
    CHECK(text::lower_case_extension("a.b/scan").empty());
}

TEST_CASE("names") {
    for (const char* name : {"a", "a_1", "_a", "1a"}) CHECK(text::is_snake_case(name));
    for (const char* name : {"", "A", "a b", "a-b", "\xC3\xA4"})
        CHECK_FALSE(text::is_snake_case(name));
    for (const char* name : {"a", "A1", "_"}) CHECK(text::is_identifier(name));
    for (const char* name : {"", "1a", "a.b"}) CHECK_FALSE(text::is_identifier(name));
    for (const char* name : {"a", "a_1"}) CHECK(text::is_id(name));
    for (const char* name : {"", "_a", "1a", "aB"}) CHECK_FALSE(text::is_id(name));
}

TEST_CASE("a quoted text is one line that can be shown") {
    CHECK(text::in_quotes("") == "''");
    CHECK(text::in_quotes("gr\xC3\xBC\xC3\x9F") == "'gr\xC3\xBC\xC3\x9F'");
    CHECK(text::in_quotes(std::string_view("a\0b\x1b\xff", 5)) == "'a?b?\?'");
    CHECK(text::in_quotes("a\tb\nc") == "'a b c'");
    CHECK(text::in_quotes(std::string(60, 'x')) == "'" + std::string(60, 'x') + "'");
    CHECK(text::in_quotes(std::string(61, 'x')) == "'" + std::string(60, 'x') + "...'");
}

TEST_CASE("counts have their plural") {
    CHECK(text::counted(1, "point") == "1 point");
    CHECK(text::counted(0, "point") == "0 points");
    CHECK(text::counted(2, "cavity", "cavities") == "2 cavities");
    CHECK(text::counted(1, "cavity", "cavities") == "1 cavity");
}

TEST_CASE("UTF-8 is well-formed or not") {
    for (const char* good : {"a", "\xC3\xA4", "\xE2\x82\xAC", "\xF0\x9F\x98\x80", "\x01"})
        CHECK(text::is_utf8(good));
    // Alone, overlong, a surrogate, beyond the last character, cut off.
    for (const char* bad :
         {"\x80", "\xC0\x80", "\xE0\x80\x80", "\xED\xA0\x80", "\xF4\x90\x80\x80", "\xE2\x82"})
        CHECK_FALSE(text::is_utf8(bad));
    CHECK(text::character_count("\xC3\xA4\xE2\x82\xAC.") == 3);
    CHECK(text::first_characters("\xC3\xA4\xE2\x82\xAC.", 2) == "\xC3\xA4\xE2\x82\xAC");
    CHECK(text::first_non_text("a\tb\n\x02") == 4);
    CHECK_FALSE(text::first_non_text("a\tb\n").has_value());
    CHECK(text::printable("a\x02\xff\n") == "a ? ");
}
