// OBJ, and the numbers of all clouds in text. Our own readers because PCL's round every coordinate to float.
#include <algorithm>
#include <array>
#include <cmath>

#include <dsc/base/byte_order_mark.hpp>
#include <dsc/base/error.hpp>

#include "formats.hpp"
#include "text.hpp"

namespace dsc::cloud {

double coordinate(const std::string& file, std::size_t line, std::string_view word) {
    double value = 0.0;
    switch (parse_number(word, value)) {
        case Number::ok:
            return value;
        case Number::not_finite:
            throw IoError("io.non_finite", file, std::to_string(line), in_quotes(word) + " is not a finite number",
                          "remove the point or write its true coordinates");
        case Number::not_a_number:
            break;
    }
    not_a_number(file, line, word, "a point needs three numbers");
}

void not_a_number(const std::string& file, std::size_t line, std::string_view word, std::string_view remedy) {
    const bool comma = word.find(',') != std::string_view::npos;
    throw IoError("io.syntax", file, std::to_string(line), in_quotes(word) + " is not a number",
                  comma ? decimal_comma_remedy : remedy);
}

std::vector<std::array<std::uint8_t, 3>> to_bytes(const std::vector<Vec3>& colours, double largest_value) {
    const double scale = 255.0 / largest_value;
    std::vector<std::array<std::uint8_t, 3>> bytes(colours.size());
    for (std::size_t i = 0; i < colours.size(); ++i)
        for (int k = 0; k < 3; ++k)
            bytes[i][static_cast<std::size_t>(k)] =
                static_cast<std::uint8_t>(std::lround(std::clamp(colours[i][k] * scale, 0.0, 255.0)));
    return bytes;
}

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
        std::array<double, 6> values{};
        std::size_t count = 0;
        for (std::string_view word = next_word(rest); !word.empty() && word.front() != '#';
             word = next_word(rest)) {
            const double value = coordinate(file, lines.number(), word);
            if (count < values.size()) values[count] = value;
            ++count;
        }
        const bool cut = !lines.terminated() && count < previous;
        if (count < 3 || count == 5 || cut)
            throw IoError(
                "io.syntax", file, std::to_string(lines.number()),
                "the vertex has " + counted(count, "number") +
                    (cut && count >= 3 ? ", the one before has more" : ""),
                "a 'v' line is 'v x y z' or 'v x y z r g b'; the file may be cut off, write it again");
        cloud.points.emplace_back(values[0], values[1], values[2]);
        if (count == 6) colours.emplace_back(values[3], values[4], values[5]);
        previous = count;
    }
    if (cloud.points.empty()) no_points(file, "a cloud in OBJ has a line 'v x y z' for each point");
    if (colours.size() == cloud.points.size()) {
        // Fractions or bytes, which only the largest number tells.
        double largest = 0.0;
        for (const Vec3& c : colours) largest = std::max(largest, c.maxCoeff());
        cloud.colours = to_bytes(colours, largest > 1.0 ? 255.0 : 1.0);
    }
    return cloud;
}

}  // namespace dsc::cloud
