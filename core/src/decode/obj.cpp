// Reads Wavefront OBJ. Own reader, because those of the libraries round every coordinate to float.
#include "dsc/decode/obj.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include <fmt/core.h>

#include <dsc/base/log.hpp>
#include <dsc/text/numbers.hpp>
#include <dsc/text/words.hpp>

namespace dsc::decode {
namespace {

constexpr std::array<std::string_view, 42> skipped = {
    "vt",         "vn",        "vp",    "g",      "o",      "s",        "usemtl",
    "mtllib",     "l",         "p",     "mg",     "cstype", "deg",      "bmat",
    "step",       "curv",      "surf",  "curv2",  "parm",   "trim",     "hole",
    "scrv",       "sp",        "end",   "con",    "bevel",  "lod",      "call",
    "csh",        "ctech",     "stech", "maplib", "usemap", "c_interp", "d_interp",
    "shadow_obj", "trace_obj", "bsp",   "bzp",    "cdc",    "cdp",      "res"};

struct LateCorner {
    std::size_t line;
    std::int64_t index;
};

/// The number of a point or of a normal, counted from 0; negative numbers count backwards from the
/// last of `count`.
std::optional<std::size_t> index_of(std::string_view word, std::size_t count) {
    const bool backwards = !word.empty() && word.front() == '-';
    if (backwards) word.remove_prefix(1);
    std::size_t index = 0;
    if (!text::parse_count(word, index) || index == 0 || (backwards && index > count))
        return std::nullopt;
    return backwards ? count - index : index - 1;
}

class ObjReader {
public:
    ObjReader(std::string_view content, std::string_view file, const ObjOptions& options)
        : lines_(content, file, options.faces), options_(options) {}

    Obj read() {
        for (std::string_view line; lines_.next(line);) {
            text::Fields fields(line.substr(0, line.find('#')));
            const std::string_view keyword = fields.next();
            if (keyword.empty()) continue;
            if (keyword == "v")
                vertex(fields);
            else if (options_.faces)
                surface_line(keyword, fields);
            else
                cloud_line(keyword, fields);
        }
        check_later_vertices();
        return std::move(obj_);
    }

private:
    void surface_line(std::string_view keyword, text::Fields& fields) {
        if (keyword == "f" || keyword == "fo")
            face(fields);
        else if (std::find(skipped.begin(), skipped.end(), keyword) == skipped.end())
            text::fail("io.syntax", lines_.place(), "unknown keyword " + text::in_quotes(keyword),
                       text::export_again);
        else
            note_geometry(keyword);
    }

    void cloud_line(std::string_view keyword, text::Fields& fields) {
        if (keyword == "vn") normal(fields);
        if (keyword == "f" && !obj_.normals.empty()) normal_corners(fields);
    }

    /// Lines, points, curves and free-form surfaces are geometry that a triangle mesh cannot
    /// represent. One warning per keyword.
    void note_geometry(std::string_view keyword) {
        constexpr std::array<std::string_view, 5> geometry = {"l", "p", "curv", "curv2", "surf"};
        const auto found = std::find(geometry.begin(), geometry.end(), keyword);
        if (found == geometry.end() ||
            std::exchange(noted_[static_cast<std::size_t>(found - geometry.begin())], true))
            return;
        log(LogLevel::warning,
            fmt::format(
                "{}:{}: lines {} are not read; only the vertices and faces of an OBJ file are read",
                lines_.place().file, lines_.number(), text::in_quotes(keyword)));
    }

    /// Exactly three numbers after the coordinates are a colour; a single one is a weight.
    void vertex(text::Fields& fields) {
        Vec3 point = Vec3::Zero(), colour = Vec3::Zero();
        std::size_t count = 0;
        bool numbers = true;
        for (std::string_view word = fields.next(); !word.empty(); word = fields.next(), ++count) {
            double value = 0.0;
            if (count < 3 || !options_.faces)
                value = options_.coordinate(word, lines_.place());
            else
                numbers = numbers && text::parse_number(word, value) == text::Number::ok;
            if (count < 6) (count < 3 ? point : colour)[static_cast<int>(count % 3)] = value;
        }
        require_complete(count);
        obj_.points.push_back(point);
        if (count == 6 && numbers) obj_.colours.push_back(colour);
        previous_ = count;
    }

    void require_complete(std::size_t count) const {
        if (options_.faces) {
            if (count < 3) lines_.fail_short(fmt::format("vertex with {} of 3 coordinates", count));
            if (obj_.points.size() == std::numeric_limits<std::uint32_t>::max())
                text::fail("io.count", lines_.place(), "more than 4294967295 vertices",
                           "split the file");
            return;
        }
        const bool cut = lines_.cut() && count < previous_;
        if (count >= 3 && count != 5 && !cut) return;
        text::fail(
            "io.syntax", lines_.place(),
            "the vertex has " + text::counted(count, "number") +
                (cut && count >= 3 ? ", the previous one has more" : ""),
            "a 'v' line is 'v x y z' or 'v x y z r g b'; the file may be cut off, write it again");
    }

    void face(text::Fields& fields) {
        polygon_.clear();
        for (std::string_view field = fields.next(); !field.empty(); field = fields.next())
            polygon_.push_back(corner(field));
        if (polygon_.size() < 3)
            lines_.fail_short("face with " + text::counted(polygon_.size(), "corner") +
                              ", at least 3 are needed");
        append_fan(obj_.faces, polygon_);
    }

    /// "7", "7/1", "7//3", "7/1/3"; indices count from 1; negative ones count backwards from the
    /// last vertex.
    std::uint32_t corner(std::string_view field) {
        const std::size_t slash = field.find('/');
        if (slash != std::string_view::npos &&
            field.find_first_not_of("0123456789/-+", slash) != std::string_view::npos)
            text::fail("io.syntax", lines_.place(), text::in_quotes(field) + " is not a corner",
                       text::export_again);
        const std::int64_t index = text::read_integer(field.substr(0, slash), lines_.place());
        const auto count = static_cast<std::int64_t>(obj_.points.size());
        if (index == 0)
            text::fail("io.index", lines_.place(), "vertex index 0",
                       "OBJ counts from 1; export the file again");
        if (index < -count)
            text::fail(
                "io.index", lines_.place(),
                fmt::format("vertex index {} reaches back beyond the first of {}", index, count),
                text::export_again);
        if (index > count) later_.push_back({lines_.number(), index});
        return static_cast<std::uint32_t>(index > 0 ? index - 1 : count + index);
    }

    void check_later_vertices() const {
        for (const LateCorner& corner : later_) {
            if (corner.index <= static_cast<std::int64_t>(obj_.points.size())) continue;
            text::fail("io.index", {lines_.place().file, corner.line},
                       fmt::format("vertex index {} of {}", corner.index, obj_.points.size()),
                       text::export_again);
        }
    }

    /// A normal may be NaN: its point then has none.
    void normal(text::Fields& fields) {
        Vec3 normal = Vec3::Zero();
        for (int k = 0; k < 3; ++k) {
            const std::string_view word = fields.next();
            if (word.empty())
                text::fail("io.syntax", lines_.place(), "the normal has fewer than 3 numbers",
                           "a 'vn' line is 'vn x y z'; the file may be cut off, write it again");
            if (text::parse_number(word, normal[k]) == text::Number::not_a_number)
                options_.coordinate(word, lines_.place());
        }
        obj_.normals.push_back(normal);
    }

    /// The corners of a face that name a point and a normal: "7//3", "7/1/3". Anything else is
    /// ignored, because a cloud does not need faces.
    void normal_corners(text::Fields& fields) {
        for (std::string_view word = fields.next(); !word.empty(); word = fields.next()) {
            const std::size_t first = word.find('/');
            const std::size_t last = word.rfind('/');
            if (first == std::string_view::npos || first == last) continue;
            const auto point = index_of(word.substr(0, first), obj_.points.size());
            const auto normal = index_of(word.substr(last + 1), obj_.normals.size());
            if (point && normal) obj_.corners.push_back({*point, *normal});
        }
    }

    text::Lines lines_;
    const ObjOptions& options_;
    Obj obj_;
    std::array<bool, 5> noted_{};
    std::vector<std::uint32_t> polygon_;
    std::vector<LateCorner> later_;  ///< corners that name a vertex which had not been read yet
    std::size_t previous_ = 0;       ///< number of values of the previous vertex
};

}  // namespace

Obj decode_obj(std::string_view content, std::string_view file, const ObjOptions& options) {
    return ObjReader(content, file, options).read();
}

std::vector<std::array<std::uint8_t, 3>> colour_bytes(const std::vector<Vec3>& colours,
                                                      double largest) {
    const double scale = 255.0 / largest;
    std::vector<std::array<std::uint8_t, 3>> bytes(colours.size());
    for (std::size_t i = 0; i < colours.size(); ++i) {
        for (std::size_t k = 0; k < 3; ++k) {
            const double value = colours[i][static_cast<int>(k)] * scale;
            bytes[i][k] = static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0, 255.0)));
        }
    }
    return bytes;
}

}  // namespace dsc::decode
