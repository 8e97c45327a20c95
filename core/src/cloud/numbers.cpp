// The numbers of text clouds, and the errors that several formats of clouds share.
#include <fmt/core.h>

#include <dsc/base/byte_order_mark.hpp>
#include <dsc/base/error.hpp>
#include <dsc/text/numbers.hpp>

#include "formats.hpp"
#include "header.hpp"

namespace dsc::cloud {

double coordinate(std::string_view word, const text::Place& place) {
    double value = 0.0;
    switch (text::parse_number(word, value)) {
        case text::Number::ok: return value;
        case text::Number::not_finite:
        case text::Number::too_large:
            text::fail("io.non_finite", place, text::in_quotes(word) + " is not a finite number",
                       "remove the point or write its true coordinates");
        case text::Number::not_a_number: break;
    }
    not_a_number(word, place, "a point needs three numbers");
}

void not_a_number(std::string_view word, const text::Place& place, std::string_view remedy) {
    const bool comma = word.find(',') != std::string_view::npos;
    text::fail("io.syntax", place, text::in_quotes(word) + " is not a number",
               comma ? decimal_comma_remedy : remedy);
}

void no_points(const std::string& file, std::string_view remedy) {
    throw IoError("io.no_points", file, "", "the file has no points", remedy);
}

void header_error(const std::string& file, std::size_t line, const std::string& cause) {
    throw IoError("io.syntax", file, std::to_string(line), cause, "save the cloud again");
}

void truncated(const std::string& file, const std::string& promised, std::size_t held) {
    throw IoError("io.truncated", file, "",
                  fmt::format("the header announces {}, the file contains {}", promised, held),
                  "the file is cut off, write it again");
}

}  // namespace dsc::cloud
