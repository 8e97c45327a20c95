#pragma once
// Reads a text strictly, with errors that name the place: lines, fields, tokens and their numbers.

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include <dsc/text/words.hpp>

namespace dsc::text {

/// The place of a reader. `line` 0: there is no line to name.
struct Place {
    std::string_view file;
    std::size_t line = 0;
};

/// Throws IoError "FILE:LINE: cause; remedy".
[[noreturn]] void fail(const char* code, const Place& place, std::string_view cause,
                       std::string_view remedy);

/// The usual remedy for a malformed file.
inline constexpr std::string_view export_again = "correct the line or export the file again";
/// The usual remedy for a truncated file.
inline constexpr std::string_view copy_again = "the file is incomplete: copy or export it again";

/// The whole word as a double; NaN and infinity are allowed. Throws "io.syntax", and
/// "io.not_finite" beyond the range.
double read_value(std::string_view word, const Place& place);

/// The whole word as a finite double. Throws "io.syntax" or "io.not_finite".
double read_coordinate(std::string_view word, const Place& place);

/// The whole word as an integer. Throws "io.syntax".
std::int64_t read_integer(std::string_view word, const Place& place);

/// Cuts a line into fields at blanks.
class Fields {
public:
    explicit Fields(std::string_view line) : rest_(line) {}
    /// The next field; empty if there is none.
    std::string_view next() { return next_word(rest_); }

private:
    std::string_view rest_;
};

/// Iterates over the lines of a text with line ends LF, CR LF or CR; the ends are not part of a
/// line. If requested, a backslash at the end of a line joins it with the next one.
class Lines {
public:
    explicit Lines(std::string_view text, std::string_view file = {}, bool join_backslash = false)
        : text_(text), feed_(text.find('\n')), place_{file, 0}, join_(join_backslash) {}

    /// False at the end of the text. The view is valid until the next call.
    bool next(std::string_view& line);
    /// The line that next() returned last, counted from 1; for a joined line its first part.
    const Place& place() const { return place_; }
    std::size_t number() const { return place_.line; }
    /// Whether the last line had a line end.
    bool terminated() const { return terminated_; }
    /// Whether the text is finished and its last line had no line end, as in a truncated file.
    bool cut() const { return at_ == text_.size() && !terminated_; }
    /// Refuses the last line because it has too few entries: "io.truncated" where the text is cut,
    /// else "io.syntax".
    [[noreturn]] void fail_short(const std::string& cause) const;

private:
    std::string_view take();

    std::string_view text_;
    std::size_t at_ = 0;
    std::size_t feed_;  ///< position of the next line feed; npos if there is none
    Place place_;
    std::size_t taken_ = 0;
    bool join_;
    bool terminated_ = true;
    std::string joined_;
};

/// Tokens of a text, separated by blanks and line feeds.
class Tokens {
public:
    Tokens(std::string_view text, std::string_view file, std::size_t first_line = 1)
        : rest_(text), place_{file, first_line}, line_(first_line) {}

    /// The next token; empty at the end.
    std::string_view next();
    /// The next token; throws "io.truncated" naming what was expected at the end of the file.
    std::string_view require(std::string_view what);
    double coordinate() { return read_coordinate(require("a number"), place_); }
    double value() { return read_value(require("a number"), place_); }
    std::int64_t integer() { return read_integer(require("an integer"), place_); }
    /// Whether another token follows on the same line.
    bool more_on_line() const;
    /// Line of the last token.
    const Place& place() const { return place_; }

private:
    std::string_view rest_;
    Place place_;
    std::size_t line_;
};

}  // namespace dsc::text
