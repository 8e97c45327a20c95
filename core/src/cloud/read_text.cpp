// OBJ and XYZ. Our own readers because PCL's round every coordinate to float.
#include <algorithm>
#include <array>
#include <cmath>

#include <dsc/base/error.hpp>

#include "formats.hpp"
#include "text.hpp"

namespace dsc::cloud {

namespace {

struct Place {
    const std::string& file;
    std::size_t line;
};

[[noreturn]] void syntax(const Place& at, const std::string& cause, std::string_view remedy) {
    throw IoError("io.syntax", at.file, std::to_string(at.line), cause, remedy);
}

double coordinate(const Place& at, std::string_view word) {
    double value = 0.0;
    switch (parse_number(word, value)) {
        case Number::ok:
            return value;
        case Number::not_finite:
            throw IoError("io.non_finite", at.file, std::to_string(at.line),
                          in_quotes(word) + " is not a finite number",
                          "remove the point or write its true coordinates");
        case Number::not_a_number:
            break;
    }
    const bool comma = word.find(',') != std::string_view::npos;
    syntax(at, in_quotes(word) + " is not a number",
           comma ? "write decimals with a point, not with a comma" : "a point needs three numbers");
}

/// Colours of an OBJ as they stand, and whether they are fractions or bytes, which only the largest tells.
std::vector<std::array<std::uint8_t, 3>> to_bytes(const std::vector<Vec3>& colours) {
    double largest = 0.0;
    for (const Vec3& c : colours) largest = std::max(largest, c.maxCoeff());
    const double scale = largest > 1.0 ? 1.0 : 255.0;
    std::vector<std::array<std::uint8_t, 3>> bytes(colours.size());
    for (std::size_t i = 0; i < colours.size(); ++i)
        for (int k = 0; k < 3; ++k)
            bytes[i][static_cast<std::size_t>(k)] =
                static_cast<std::uint8_t>(std::lround(std::clamp(colours[i][k] * scale, 0.0, 255.0)));
    return bytes;
}

/// How the columns of a line are divided. A line with a semicolon keeps its commas, one with a comma its
/// blanks, so that decimal commas are refused and not read as two columns.
char separator_of(std::string_view line) {
    if (line.find(';') != std::string_view::npos) return ';';
    if (line.find(',') != std::string_view::npos) return ',';
    return ' ';
}

/// Takes the next column off; false at the end. A separator at the end of the line opens no column.
bool next_column(std::string_view& rest, char separator, std::string_view& column) {
    if (separator == ' ') {
        column = next_word(rest);
        return !column.empty();
    }
    if (trim(rest).empty()) return false;
    const std::size_t end = rest.find(separator);
    column = trim(rest.substr(0, end));
    rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
    return true;
}

std::size_t count_columns(std::string_view line, char separator) {
    std::size_t count = 0;
    std::string_view column;
    while (next_column(line, separator, column)) ++count;
    return count;
}

/// A block of points that a count line announced.
struct Announced {
    bool any = false;
    std::size_t line = 0;
    std::size_t count = 0;
    std::size_t first = 0;  ///< number of points before it
};

void check_announced(const std::string& file, const Announced& block, std::size_t points) {
    const std::size_t got = points - block.first;
    if (!block.any || got == block.count) return;
    throw IoError(
        got < block.count ? "io.truncated" : "io.syntax", file, std::to_string(block.line),
        "the count line promises " + counted(block.count, "point") + ", the file has " + std::to_string(got),
        got < block.count ? "the file is cut off, write it again" : "correct the count");
}

}  // namespace

void no_points(const std::string& file, std::string_view remedy) {
    throw IoError("io.no_points", file, "", "the file has no points", remedy);
}

Cloud read_obj(const std::string& file, std::string_view text) {
    Cloud cloud;
    std::vector<Vec3> colours;
    std::size_t previous = 0;  // numbers of the v line before
    Lines lines(text);
    for (std::string_view line; lines.next(line);) {
        std::string_view rest = line;
        if (next_word(rest) != "v") continue;
        const Place at{file, lines.number()};
        std::array<double, 6> values{};
        std::size_t count = 0;
        for (std::string_view word = next_word(rest); !word.empty() && word.front() != '#';
             word = next_word(rest)) {
            const double value = coordinate(at, word);
            if (count < values.size()) values[count] = value;
            ++count;
        }
        const bool cut = !lines.terminated() && count < previous;
        if (count < 3 || count == 5 || cut)
            syntax(at,
                   "the vertex has " + counted(count, "number") +
                       (cut && count >= 3 ? ", the one before has more" : ""),
                   "a 'v' line is 'v x y z' or 'v x y z r g b'; the file may be cut off, write it again");
        cloud.points.emplace_back(values[0], values[1], values[2]);
        if (count == 6) colours.emplace_back(values[3], values[4], values[5]);
        previous = count;
    }
    if (cloud.points.empty()) no_points(file, "a cloud in OBJ has a line 'v x y z' for each point");
    if (colours.size() == cloud.points.size()) cloud.colours = to_bytes(colours);
    return cloud;
}

Cloud read_xyz(const std::string& file, std::string_view text) {
    Cloud cloud;
    Announced block;
    bool header = false;
    std::size_t previous = 0;  // columns of the point before
    Lines lines(text);
    for (std::string_view line; lines.next(line);) {
        line = trim(line);
        if (line.empty() || line.front() == '#' || line.substr(0, 2) == "//") continue;
        const Place at{file, lines.number()};
        const char separator = separator_of(line);
        const std::size_t columns = count_columns(line, separator);

        std::size_t count = 0;
        const bool block_full =
            cloud.points.empty() || (block.any && cloud.points.size() - block.first == block.count);
        if (columns == 1 && block_full && parse_count(line, count)) {
            check_announced(file, block, cloud.points.size());
            block = {true, at.line, count, cloud.points.size()};
            continue;
        }
        std::array<std::string_view, 3> words;
        std::string_view rest = line;
        for (auto& word : words) next_column(rest, separator, word);
        double value = 0.0;
        if (cloud.points.empty() && !header && parse_number(words[0], value) == Number::not_a_number) {
            header = true;  // names of the columns
            continue;
        }
        const bool cut = !lines.terminated() && columns < previous;
        if (columns < 3 || cut)
            syntax(
                at,
                "the line has " + counted(columns, "column") +
                    (cut && columns >= 3 ? ", the one before has more" : ""),
                "a point needs x, y and z, divided by blanks, commas or semicolons; the file may be cut off");
        Vec3 point;
        for (int k = 0; k < 3; ++k) {
            const std::string_view word = words[static_cast<std::size_t>(k)];
            if (word.empty())
                syntax(at, "column " + std::to_string(k + 1) + " is empty", "a point needs x, y and z");
            point[k] = coordinate(at, word);
        }
        cloud.points.push_back(point);
        previous = columns;
    }
    check_announced(file, block, cloud.points.size());
    if (cloud.points.empty()) no_points(file, "a cloud in text has a line 'x y z' for each point");
    return cloud;
}

}  // namespace dsc::cloud
