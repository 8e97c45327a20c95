// The columns of a text cloud: separators, headers, and the choice of columns.
#include "columns.hpp"

#include <algorithm>

#include <fmt/core.h>

#include <dsc/base/error.hpp>
#include <dsc/text/numbers.hpp>
#include <dsc/text/words.hpp>

#include "attributes.hpp"

namespace dsc::cloud {

namespace {

/// Position of the first `wanted` outside double quotes.
std::size_t find_outside_quotes(std::string_view text, char wanted) {
    bool quoted = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] == '"') quoted = !quoted;
        if (text[i] == wanted && !quoted) return i;
    }
    return std::string_view::npos;
}

/// "a ""b""" without its quotes: a "b".
std::string unquoted(std::string_view column) {
    if (column.size() < 2 || column.front() != '"' || column.back() != '"')
        return std::string(column);
    column = column.substr(1, column.size() - 2);
    std::string text;
    for (std::size_t i = 0; i < column.size(); ++i) {
        text += column[i];
        if (column[i] == '"' && i + 1 < column.size() && column[i + 1] == '"') ++i;
    }
    return text;
}

/// The column with that name: first by the exact spelling, then without regard to case.
std::optional<std::size_t> find_name(const std::vector<std::string>& header,
                                     const std::string& name) {
    auto found = std::find(header.begin(), header.end(), name);
    if (found == header.end())
        found = std::find_if(header.begin(), header.end(), [&](const std::string& other) {
            return text::lower_case(other) == text::lower_case(name);
        });
    if (found == header.end()) return std::nullopt;
    return static_cast<std::size_t>(found - header.begin());
}

std::optional<std::array<std::size_t, 3>> find_names(const std::vector<std::string>& header,
                                                     const std::array<const char*, 3>& names) {
    std::array<std::size_t, 3> columns{};
    for (std::size_t k = 0; k < 3; ++k) {
        const std::optional<std::size_t> found = find_name(header, names[k]);
        if (!found) return std::nullopt;
        columns[k] = *found;
    }
    return columns;
}

/// A name in lower case, without its unit in brackets and without characters other than letters and
/// digits: "X [m]" is x, "Points:0" is points0.
std::string plain_name(const std::string& name) {
    std::string plain;
    for (const char c : text::lower_case(name.substr(0, name.find_first_of("[(")))) {
        if (text::is_lower(c) || text::is_digit(c)) plain += c;
    }
    return plain;
}

/// Usual names of coordinates in headers. Degrees are not included, because a longitude is not a
/// length.
constexpr std::array<std::array<std::string_view, 11>, 3> usual_names = {
    {{"x", "xcoord", "xcoordinate", "coordx", "posx", "positionx", "pointx", "points0", "xm",
      "easting", "east"},
     {"y", "ycoord", "ycoordinate", "coordy", "posy", "positiony", "pointy", "points1", "ym",
      "northing", "north"},
     {"z", "zcoord", "zcoordinate", "coordz", "posz", "positionz", "pointz", "points2", "zm",
      "elevation", "elev"}}};
constexpr std::array<std::string_view, 4> usual_heights = {"height", "altitude", "alt", "up"};

/// The three columns by their usual names; of several, the one whose name comes first in the list
/// above.
std::optional<std::array<std::size_t, 3>> find_usual(const std::vector<std::string>& header) {
    std::vector<std::string> plain;
    for (const std::string& name : header) plain.push_back(plain_name(name));
    std::array<std::size_t, 3> columns{};
    for (std::size_t k = 0; k < 3; ++k) {
        std::vector<std::string_view> names(usual_names[k].begin(), usual_names[k].end());
        if (k == 2) names.insert(names.end(), usual_heights.begin(), usual_heights.end());
        auto found = plain.end();
        for (std::size_t i = 0; i < names.size() && found == plain.end(); ++i) {
            found = std::find(plain.begin(), plain.end(), names[i]);
        }
        if (found == plain.end()) return std::nullopt;
        columns[k] = static_cast<std::size_t>(found - plain.begin());
    }
    return columns;
}

bool is_number(const std::string& column) {
    std::size_t value = 0;
    return text::parse_count(column, value);
}

std::string listed(const std::vector<std::string>& names) {
    constexpr std::size_t most = 12;
    std::string text;
    for (std::size_t i = 0; i < std::min(names.size(), most); ++i)
        text += (i > 0 ? ", " : "") + text::in_quotes(names[i]);
    return names.size() > most ? text + ", ..." : text;
}

}  // namespace

char separator_of(std::string_view line, bool tabs) {
    if (find_outside_quotes(line, ';') != std::string_view::npos) return ';';
    if (find_outside_quotes(line, ',') != std::string_view::npos) return ',';
    if (tabs && find_outside_quotes(line, '\t') != std::string_view::npos) return '\t';
    return ' ';
}

void split_columns(std::string_view line, char separator, std::vector<std::string>& columns) {
    columns.clear();
    if (separator == ' ') {
        for (std::string_view word = text::next_word(line); !word.empty();
             word = text::next_word(line))
            columns.push_back(unquoted(word));
        return;
    }
    while (!text::trim(line).empty()) {
        const std::size_t end = find_outside_quotes(line, separator);
        columns.push_back(unquoted(text::trim(line.substr(0, end))));
        line.remove_prefix(end == std::string_view::npos ? line.size() : end + 1);
    }
}

ColumnChoice::ColumnChoice(const std::string& file, const ReadOptions& options)
    : file_(file), options_(options) {
    wants_names_ = !std::all_of(options.columns.begin(), options.columns.end(), is_number);
    if (wants_names_ || options.columns.empty()) return;
    std::string missing;
    take(resolve({}, missing).value());
}

std::optional<std::vector<std::size_t>> ColumnChoice::resolve(
    const std::vector<std::string>& header, std::string& missing) const {
    std::vector<std::size_t> columns;
    for (const std::string& wanted : options_.columns) {
        std::size_t number = 0;
        if (text::parse_count(wanted, number)) {
            if (number == 0)
                throw IoError("io.columns", file_, "", "column 0 is chosen",
                              "count columns from 1");
            columns.push_back(number - 1);
        } else if (const auto found = find_name(header, wanted)) {
            columns.push_back(*found);
        } else {
            missing = wanted;
            return std::nullopt;
        }
    }
    return columns;
}

void ColumnChoice::take(const std::vector<std::size_t>& columns) {
    for (std::size_t i = 0; i < columns.size(); ++i) {
        const auto end = columns.begin() + static_cast<std::ptrdiff_t>(i);
        if (std::find(columns.begin(), end, columns[i]) != end)
            throw IoError("io.columns", file_, "",
                          "column " + text::in_quotes(options_.columns[i]) + " is chosen twice",
                          "choose a different column for each coordinate and colour");
    }
    std::copy_n(columns.begin(), 3, coordinates_.begin());
    if (columns.size() == 6) std::copy_n(columns.begin() + 3, 3, colours_.emplace().begin());
    wants_names_ = false;
}

bool ColumnChoice::knows(const std::vector<std::string>& words) const {
    std::string missing;
    return chosen() ? resolve(words, missing).has_value()
                    : find_names(words, {"x", "y", "z"}).has_value();
}

void ColumnChoice::take_names(const std::vector<std::string>& names, bool comment) {
    if (chosen()) {
        std::string missing;
        if (wants_names_ && knows(names)) take(resolve(names, missing).value());
        return;
    }
    auto coordinates = find_names(names, {"x", "y", "z"});
    if (!coordinates && !comment) coordinates = find_usual(names);
    if (!coordinates) return;
    named_ = true;
    coordinates_ = *coordinates;
    const AttributeColumns attributes = attribute_columns(names);
    colours_ = attributes.colours;
    normals_ = attributes.normals;
    intensity_ = attributes.intensity;
}

void ColumnChoice::require_names(const std::vector<std::string>& header, std::size_t line) const {
    if (chosen() ? !wants_names_ || knows(header) : knows(header) || find_usual(header).has_value())
        return;
    double value = 0.0;
    const bool numbers = std::any_of(header.begin(), header.end(), [&](const std::string& word) {
        return text::parse_number(word, value) == text::Number::ok;
    });
    if (!chosen()) {
        throw IoError(
            "io.columns", file_, std::to_string(line),
            numbers
                ? "the first line contains words, but they do not say which columns are x, y and z"
                : "the header " + listed(header) + " does not say which columns are x, y and z",
            "choose three columns by their names or by their numbers from 1");
    }
    std::string missing;
    resolve(header, missing);
    throw IoError("io.columns", file_, std::to_string(line),
                  "no column has the name " + text::in_quotes(missing),
                  numbers
                      ? "the file seems to have no header; choose columns by their numbers from 1"
                      : "choose of " + listed(header) + " or a number from 1");
}

std::string ColumnChoice::of_needed(std::size_t last) const {
    return chosen() || named_ ? fmt::format(", column {} is needed", last + 1) : "";
}

}  // namespace dsc::cloud
