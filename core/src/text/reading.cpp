// Reads a text strictly, with errors that name the place.
#include "dsc/text/reading.hpp"

#include <dsc/base/byte_order_mark.hpp>
#include <dsc/base/error.hpp>
#include <dsc/text/numbers.hpp>

namespace dsc::text {

void fail(const char* code, const Place& place, std::string_view cause, std::string_view remedy) {
    throw IoError(code, place.file, place.line > 0 ? std::to_string(place.line) : std::string{},
                  cause, remedy);
}

double read_value(std::string_view word, const Place& place) {
    double value = 0.0;
    switch (parse_number(word, value)) {
        case Number::ok:
        case Number::not_finite: return value;
        case Number::too_large:
            fail("io.not_finite", place, in_quotes(word) + " is out of the range of a double",
                 export_again);
        case Number::not_a_number: break;
    }
    const bool comma = word.find(',') != std::string_view::npos;
    fail("io.syntax", place, in_quotes(word) + " is not a number",
         comma ? decimal_comma_remedy : export_again);
}

double read_coordinate(std::string_view word, const Place& place) {
    double value = 0.0;
    if (parse_number(word, value) == Number::ok) return value;
    read_value(word, place);
    fail("io.not_finite", place, "coordinate " + in_quotes(word) + " is NaN or infinite",
         "remove the point and its faces or export the file again");
}

std::int64_t read_integer(std::string_view word, const Place& place) {
    std::int64_t value = 0;
    if (!parse_integer(word, value))
        fail("io.syntax", place, in_quotes(word) + " is not an integer", export_again);
    return value;
}

std::string_view Lines::take() {
    // The next line feed is looked for once, so that a text with line ends CR is not searched to
    // its end for every line.
    if (feed_ != std::string_view::npos && feed_ < at_) feed_ = text_.find('\n', at_);
    std::string_view line =
        text_.substr(at_, feed_ == std::string_view::npos ? feed_ : feed_ - at_);
    std::size_t end = feed_ == std::string_view::npos ? 0 : 1;  // number of its bytes
    if (const std::size_t carriage = line.find('\r'); carriage != std::string_view::npos) {
        end = carriage + 1 == line.size() ? end + 1 : 1;
        line = line.substr(0, carriage);
    }
    terminated_ = end > 0;
    at_ += line.size() + end;
    ++taken_;
    return line;
}

bool Lines::next(std::string_view& line) {
    if (at_ == text_.size()) return false;
    line = take();
    place_.line = taken_;
    if (!join_ || line.empty() || line.back() != '\\') return true;
    joined_.assign(line);
    while (!joined_.empty() && joined_.back() == '\\') {
        joined_.back() = ' ';
        if (at_ == text_.size()) break;
        joined_.append(take());
    }
    line = joined_;
    return true;
}

std::string_view Tokens::next() {
    std::size_t begin = 0;
    while (begin < rest_.size() && (is_blank(rest_[begin]) || rest_[begin] == '\n')) {
        if (rest_[begin] == '\n') ++line_;
        ++begin;
    }
    std::size_t end = begin;
    while (end < rest_.size() && !is_blank(rest_[end]) && rest_[end] != '\n') ++end;
    const std::string_view token = rest_.substr(begin, end - begin);
    rest_.remove_prefix(end);
    if (!token.empty()) place_.line = line_;
    return token;
}

bool Tokens::more_on_line() const {
    std::size_t at = 0;
    while (at < rest_.size() && is_blank(rest_[at])) ++at;
    return at < rest_.size() && rest_[at] != '\n';
}

void Lines::fail_short(const std::string& cause) const {
    fail(cut() ? "io.truncated" : "io.syntax", place_, cause, cut() ? copy_again : export_again);
}

std::string_view Tokens::require(std::string_view what) {
    const std::string_view token = next();
    if (token.empty())
        fail("io.truncated", place_, "the file ends where " + std::string(what) + " should be",
             copy_again);
    return token;
}

}  // namespace dsc::text
