#pragma once
// Reads and writes numbers as text: strict, fast, independent of the locale, with errors that name the place.

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace dsc::io {

/// The place of a reader. `line` 0: there is no line to name.
struct Place {
    std::string_view file;
    std::size_t line = 0;
};

/// Throws IoError "FILE:LINE: cause; remedy".
[[noreturn]] void fail(const char* code, const Place& place, const std::string& cause,
                       const std::string& remedy);

/// The usual remedy for a malformed file.
inline const std::string export_again = "correct the line or export the file again";
/// The usual remedy for a truncated file.
inline const std::string copy_again = "the file is incomplete: copy or export it again";

/// A token for a message: quoted, shortened, printable.
std::string in_quotes(std::string_view token);

/// The whole token as a finite double. Throws "io.syntax" or "io.not_finite".
double parse_coordinate(std::string_view token, const Place& place);

/// The whole token as a double; NaN and infinity are allowed. Throws "io.syntax", and "io.not_finite" beyond the range.
double parse_value(std::string_view token, const Place& place);

/// Whether the whole token is a finite double; for optional numbers.
bool read_number(std::string_view token, double& value);

/// The whole token as an integer. Throws "io.syntax".
std::int64_t parse_integer(std::string_view token, const Place& place);

/// A number with its noun: "1 point", "2 points".
std::string counted(std::uint64_t count, std::string_view noun);

/// Blank, tab, carriage return and similar characters, but not line feed.
bool is_blank(char c);

/// Cuts a line into fields at blanks.
class Fields {
public:
    explicit Fields(std::string_view line) : rest_(line) {}
    /// The next field; empty if there is none.
    std::string_view next();

private:
    std::string_view rest_;
};

/// Lines of a text in order. If requested, a backslash at the end of a line joins it with the next one.
class Lines {
public:
    Lines(std::string_view text, std::string_view file, bool join_backslash = false)
        : rest_(text), place_{file, 0}, join_(join_backslash) {}
    /// False at the end. The view is valid until the next call.
    bool next(std::string_view& line);
    /// The line that next() returned last; for a joined line the first one.
    const Place& place() const { return place_; }
    /// Whether the text is finished and its last line had no line feed, as in a truncated file.
    bool cut() const { return rest_.empty() && !ended_; }

private:
    std::string_view take();
    std::string_view rest_;
    Place place_;
    std::size_t taken_ = 0;
    bool join_;
    bool ended_ = true;
    std::string joined_;
};

/// Tokens of a text, separated by white space and line feeds.
class Tokens {
public:
    Tokens(std::string_view text, std::string_view file, std::size_t first_line = 1)
        : rest_(text), place_{file, first_line}, line_(first_line) {}
    /// The next token; empty at the end.
    std::string_view next();
    /// The next token; throws "io.truncated" naming what was expected at the end of the file.
    std::string_view require(std::string_view what);
    double coordinate() { return parse_coordinate(require("a number"), place_); }
    double value() { return parse_value(require("a number"), place_); }
    std::int64_t integer() { return parse_integer(require("an integer"), place_); }
    /// Whether another token follows on the same line.
    bool more_on_line() const;
    /// Line of the last token.
    const Place& place() const { return place_; }

private:
    std::string_view rest_;
    Place place_;
    std::size_t line_;
};

/// Appends the shortest text that reads back to the same number.
void append_number(std::string& out, double value);
void append_number(std::string& out, std::uint64_t value);

}  // namespace dsc::io
