// Wavefront OBJ: reads vertices and polygons, skips everything else that the format defines.
#include <algorithm>
#include <array>
#include <cmath>
#include <dsc/base/log.hpp>
#include <dsc/text/numbers.hpp>
#include <dsc/text/reading.hpp>
#include <dsc/text/words.hpp>
#include <limits>
#include <string>
#include <utility>

#include "io/codecs.hpp"

namespace dsc::io {
namespace {

constexpr std::array<std::string_view, 42> skipped = {
    "vt",        "vn",   "vp",     "g",     "o",      "s",      "usemtl",   "mtllib",   "l",
    "p",         "mg",   "cstype", "deg",   "bmat",   "step",   "curv",     "surf",     "curv2",
    "parm",      "trim", "hole",   "scrv",  "sp",     "end",    "con",      "bevel",    "lod",
    "call",      "csh",  "ctech",  "stech", "maplib", "usemap", "c_interp", "d_interp", "shadow_obj",
    "trace_obj", "bsp",  "bzp",    "cdc",   "cdp",    "res"};

struct LateCorner {
    std::size_t line;
    std::int64_t index;
};

/// Fractions or bytes: only the largest number can decide.
std::vector<std::array<std::uint8_t, 3>> colours_in_bytes(const std::vector<Vec3>& colours) {
    double largest = 0.0;
    for (const Vec3& c : colours) largest = std::max(largest, c.maxCoeff());
    const double scale = largest > 1.0 ? 1.0 : 255.0;
    std::vector<std::array<std::uint8_t, 3>> bytes;
    bytes.reserve(colours.size());
    for (const Vec3& c : colours) {
        const auto byte = [&](double value) {
            return static_cast<std::uint8_t>(std::lround(std::clamp(value * scale, 0.0, 255.0)));
        };
        bytes.push_back({byte(c.x()), byte(c.y()), byte(c.z())});
    }
    return bytes;
}

class ObjReader {
public:
    ObjReader(std::string_view content, std::string_view file) : lines_(content, file, true) {}

    surface::TriangleMesh read() {
        std::string_view line;
        while (lines_.next(line)) {
            text::Fields fields(line.substr(0, line.find('#')));
            const std::string_view keyword = fields.next();
            if (keyword.empty()) continue;
            if (keyword == "v")
                vertex(fields);
            else if (keyword == "f" || keyword == "fo")
                face(fields);
            else if (std::find(skipped.begin(), skipped.end(), keyword) == skipped.end()) {
                text::fail("io.syntax", lines_.place(), "unknown keyword " + text::in_quotes(keyword), text::export_again);
            } else {
                note_geometry(keyword);
            }
        }
        check_later_vertices();
        if (colours_.size() == mesh_.points.size()) mesh_.colours = colours_in_bytes(colours_);
        return std::move(mesh_);
    }

private:
    /// Lines, points, curves and free-form surfaces are geometry that a triangle mesh cannot represent. One warning per
    /// keyword.
    void note_geometry(std::string_view keyword) {
        constexpr std::array<std::string_view, 5> geometry = {"l", "p", "curv", "curv2", "surf"};
        const auto found = std::find(geometry.begin(), geometry.end(), keyword);
        if (found == geometry.end() || std::exchange(noted_[static_cast<std::size_t>(found - geometry.begin())], true)) return;
        log(LogLevel::warning, std::string(lines_.place().file) + ":" + std::to_string(lines_.place().line) + ": lines " +
                                   text::in_quotes(keyword) + " are not read; only the vertices and faces of an OBJ file are read");
    }

    /// Code for a line with too few numbers: truncated at the end of the file, malformed elsewhere.
    const char* short_line() const { return lines_.cut() ? "io.truncated" : "io.syntax"; }
    std::string_view short_remedy() const { return lines_.cut() ? text::copy_again : text::export_again; }

    void vertex(text::Fields& fields) {
        Vec3 p;
        for (int k = 0; k < 3; ++k) {
            const std::string_view field = fields.next();
            if (field.empty()) {
                text::fail(short_line(), lines_.place(), "vertex with " + std::to_string(k) + " of 3 coordinates",
                     short_remedy());
            }
            p[k] = text::read_coordinate(field, lines_.place());
        }
        if (mesh_.points.size() == std::numeric_limits<std::uint32_t>::max()) {
            text::fail("io.count", lines_.place(), "more than 4294967295 vertices", "split the file");
        }
        mesh_.points.push_back(p);
        if (colours_.size() + 1 == mesh_.points.size()) colour(fields);
    }

    /// Exactly three further numbers are a colour; a single one is a weight. After the first vertex without a colour no colours
    /// are read: a surface has all colours or none.
    void colour(text::Fields& fields) {
        Vec3 rgb;
        for (int k = 0; k < 3; ++k) {
            if (text::parse_number(fields.next(), rgb[k]) != text::Number::ok) return;
        }
        if (fields.next().empty()) colours_.push_back(rgb);
    }

    void face(text::Fields& fields) {
        polygon_.clear();
        for (std::string_view field = fields.next(); !field.empty(); field = fields.next()) {
            polygon_.push_back(corner(field));
        }
        if (polygon_.size() < 3) {
            text::fail(short_line(), lines_.place(),
                 "face with " + text::counted(polygon_.size(), "corner") + ", at least 3 are needed",
                 short_remedy());
        }
        append_fan(mesh_, polygon_);
    }

    /// "7", "7/1", "7//3", "7/1/3"; indices count from 1; negative ones count backwards from the last vertex.
    std::uint32_t corner(std::string_view field) {
        const std::size_t slash = field.find('/');
        if (slash != std::string_view::npos &&
            field.find_first_not_of("0123456789/-+", slash) != std::string_view::npos) {
            text::fail("io.syntax", lines_.place(), text::in_quotes(field) + " is not a corner", text::export_again);
        }
        const std::int64_t index = text::read_integer(field.substr(0, slash), lines_.place());
        const auto count = static_cast<std::int64_t>(mesh_.points.size());
        if (index == 0)
            text::fail("io.index", lines_.place(), "vertex index 0", "OBJ counts from 1; export the file again");
        if (index < -count) {
            text::fail("io.index", lines_.place(),
                 "vertex index " + std::to_string(index) + " reaches back beyond the first of " +
                     std::to_string(count),
                 text::export_again);
        }
        if (index > std::numeric_limits<std::uint32_t>::max())
            later_.push_back({lines_.place().line, index});
        else if (index > count)
            later_.push_back({lines_.place().line, index});
        return static_cast<std::uint32_t>(index > 0 ? index - 1 : count + index);
    }

    void check_later_vertices() {
        for (const LateCorner& r : later_) {
            if (r.index <= static_cast<std::int64_t>(mesh_.points.size())) continue;
            text::fail("io.index", {lines_.place().file, r.line},
                 "vertex index " + std::to_string(r.index) + " of " + std::to_string(mesh_.points.size()),
                 text::export_again);
        }
    }

    text::Lines lines_;
    std::array<bool, 5> noted_{};
    surface::TriangleMesh mesh_;
    std::vector<std::uint32_t> polygon_;
    std::vector<Vec3> colours_;     ///< of the vertices so far, as long as every vertex had one
    std::vector<LateCorner> later_;  ///< corners that name a vertex which had not been read yet
};

}  // namespace

surface::TriangleMesh decode_obj(std::string_view content, std::string_view file) {
    return ObjReader(content, file).read();
}

std::string encode_obj(const surface::TriangleMesh& mesh, const std::vector<Vec3>& normals) {
    std::string out;
    out.reserve(60 * mesh.points.size() + 24 * mesh.faces.size());
    for (std::size_t i = 0; i < mesh.points.size(); ++i) {
        out += 'v';
        for (int k = 0; k < 3; ++k) {
            out += ' ';
            text::append_number(out, mesh.points[i][k]);
        }
        if (!mesh.colours.empty()) {
            for (const std::uint8_t c : mesh.colours[i]) {
                out += ' ';
                text::append_number(out, c / 255.0);
            }
        }
        out += '\n';
    }
    for (const Vec3& normal : normals) {
        out += "vn";
        for (int k = 0; k < 3; ++k) {
            out += ' ';
            text::append_number(out, normal[k]);
        }
        out += '\n';
    }
    for (const auto& face : mesh.faces) {
        out += 'f';
        for (const std::uint32_t v : face) {
            out += ' ';
            text::append_number(out, std::uint64_t{v} + 1);
            if (normals.empty()) continue;
            out += "//";
            text::append_number(out, std::uint64_t{v} + 1);
        }
        out += '\n';
    }
    return out;
}

}  // namespace dsc::io
