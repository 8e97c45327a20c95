// OBJ clouds, and the numbers of all text clouds. Own readers, because PCL's readers round every coordinate to float.
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include <dsc/base/byte_order_mark.hpp>
#include <dsc/base/error.hpp>
#include <dsc/text/reading.hpp>
#include <dsc/text/numbers.hpp>
#include <dsc/text/words.hpp>

#include "attributes.hpp"
#include "formats.hpp"

namespace dsc::cloud {

double coordinate(const std::string& file, std::size_t line, std::string_view word) {
    double value = 0.0;
    switch (text::parse_number(word, value)) {
        case text::Number::ok:
            return value;
        case text::Number::not_finite:
        case text::Number::too_large:
            throw IoError("io.non_finite", file, std::to_string(line), text::in_quotes(word) + " is not a finite number",
                          "remove the point or write its true coordinates");
        case text::Number::not_a_number:
            break;
    }
    not_a_number(file, line, word, "a point needs three numbers");
}

void not_a_number(const std::string& file, std::size_t line, std::string_view word, std::string_view remedy) {
    const bool comma = word.find(',') != std::string_view::npos;
    throw IoError("io.syntax", file, std::to_string(line), text::in_quotes(word) + " is not a number",
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

namespace {

/// Normals of an OBJ: the lines `vn`, and the point to which each belongs.
class ObjNormals {
public:
    void add(const std::string& file, std::size_t line, std::string_view rest) {
        Vec3 normal = Vec3::Zero();
        for (int k = 0; k < 3; ++k) {
            const std::string_view word = text::next_word(rest);
            if (word.empty()) throw_short(file, line);
            if (text::parse_number(word, normal[k]) == text::Number::not_a_number) coordinate(file, line, word);
        }
        normals_.push_back(direction_of(normal));
    }

    /// The corners of a face that name a point and a normal: "7//3", "7/1/3"; negative numbers count backwards from the last.
    /// Anything else is ignored, because faces are not needed for a cloud.
    void add_corners(std::string_view rest, std::size_t points) {
        for (std::string_view word = text::next_word(rest); !word.empty() && word.front() != '#'; word = text::next_word(rest)) {
            const std::size_t first = word.find('/');
            const std::size_t last = word.rfind('/');
            if (first == std::string_view::npos || first == last) continue;
            const auto point = index_of(word.substr(0, first), points);
            const auto normal = index_of(word.substr(last + 1), normals_.size());
            if (point && normal) corners_.emplace_back(*point, *normal);
        }
    }

    bool any() const { return !normals_.empty(); }

    /// Per point: the mean of the normals from its corners; or its own normal if there are as many normals as points. A normal
    /// that all corners repeat keeps its bits.
    std::vector<Vec3> of_points(std::size_t points) const {
        std::vector<Vec3> out;
        if (corners_.empty()) return normals_.size() == points ? normals_ : out;
        out.assign(points, Vec3::Zero());
        for (const auto& [point, normal] : corners_)
            if (point < points && normal < normals_.size() && out[point] != normals_[normal]) out[point] += normals_[normal];
        for (Vec3& normal : out) normal = direction_of(normal);
        return out;
    }

private:
    [[noreturn]] static void throw_short(const std::string& file, std::size_t line) {
        throw IoError("io.syntax", file, std::to_string(line), "the normal has fewer than 3 numbers",
                      "a 'vn' line is 'vn x y z'; the file may be cut off, write it again");
    }

    static std::optional<std::size_t> index_of(std::string_view word, std::size_t count) {
        const bool backwards = !word.empty() && word.front() == '-';
        if (backwards) word.remove_prefix(1);
        std::size_t index = 0;
        if (!text::parse_count(word, index) || index == 0 || (backwards && index > count)) return std::nullopt;
        return backwards ? count - index : index - 1;
    }

    std::vector<Vec3> normals_;
    std::vector<std::pair<std::size_t, std::size_t>> corners_;
};

}  // namespace

Cloud read_obj(const std::string& file, std::string_view text, std::vector<std::string>& names) {
    Cloud cloud;
    std::vector<Vec3> colours;
    std::size_t previous = 0;  // number of values in the previous v line
    ObjNormals normals;
    text::Lines lines(text);
    for (std::string_view line; lines.next(line);) {
        std::string_view rest = line;
        const std::string_view keyword = text::next_word(rest);
        if (keyword == "vn") normals.add(file, lines.number(), rest);
        if (keyword == "f" && normals.any()) normals.add_corners(rest, cloud.points.size());
        if (keyword != "v") continue;
        std::array<double, 6> values{};
        std::size_t count = 0;
        for (std::string_view word = text::next_word(rest); !word.empty() && word.front() != '#';
             word = text::next_word(rest)) {
            const double value = coordinate(file, lines.number(), word);
            if (count < values.size()) values[count] = value;
            ++count;
        }
        const bool cut = !lines.terminated() && count < previous;
        if (count < 3 || count == 5 || cut)
            throw IoError(
                "io.syntax", file, std::to_string(lines.number()),
                "the vertex has " + text::counted(count, "number") +
                    (cut && count >= 3 ? ", the previous one has more" : ""),
                "a 'v' line is 'v x y z' or 'v x y z r g b'; the file may be cut off, write it again");
        cloud.points.emplace_back(values[0], values[1], values[2]);
        if (count == 6) colours.emplace_back(values[3], values[4], values[5]);
        previous = count;
    }
    if (cloud.points.empty()) no_points(file, "a cloud in OBJ has a line 'v x y z' for each point");
    // Fractions or bytes: only the largest number can decide.
    if (colours.size() == cloud.points.size()) cloud.colours = colours_from(colours, false);
    cloud.normals = normals.of_points(cloud.points.size());
    keep_whole_normals(cloud);
    names = {"x", "y", "z"};
    if (!colours.empty()) names.insert(names.end(), {"r", "g", "b"});
    if (normals.any()) names.insert(names.end(), {"nx", "ny", "nz"});
    return cloud;
}

}  // namespace dsc::cloud
