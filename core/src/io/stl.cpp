// STL, text and binary: separate float triangles; the reader joins equal corners.
#include <array>
#include <charconv>
#include <cmath>

#include <fmt/core.h>

#include <dsc/base/byte_order_mark.hpp>
#include <dsc/geometry/quality.hpp>
#include <dsc/surface/measure.hpp>
#include <dsc/text/numbers.hpp>
#include <dsc/text/reading.hpp>
#include <dsc/text/words.hpp>

#include "io/bytes.hpp"
#include "io/codecs.hpp"
#include "io/float_centre.hpp"

namespace dsc::io {
namespace {

constexpr std::size_t header_size = 80;
constexpr std::size_t data_start = header_size + 4;
constexpr std::size_t facet_size = 50;
constexpr std::string_view centre_mark = "dsc surface, add centre ";

/// Joins equal corners into points, in the order of their first use.
surface::TriangleMesh join(const std::vector<Vec3>& corners) {
    const auto first = surface::first_equal(corners);
    surface::TriangleMesh mesh;
    std::vector<std::uint32_t> index(corners.size());
    for (std::size_t i = 0; i < corners.size(); ++i) {
        if (first[i] == i) {
            index[i] = static_cast<std::uint32_t>(mesh.points.size());
            mesh.points.push_back(corners[i]);
        } else {
            index[i] = index[first[i]];
        }
    }
    for (std::size_t i = 0; i + 2 < corners.size(); i += 3)
        mesh.faces.push_back({index[i], index[i + 1], index[i + 2]});
    return mesh;
}

/// The centre that encode_stl() subtracted, from the header.
Vec3 centre_of(std::string_view header) {
    Vec3 centre = Vec3::Zero();
    if (header.substr(0, centre_mark.size()) != centre_mark) return centre;
    text::Fields fields(header.substr(centre_mark.size()));
    for (int k = 0; k < 3; ++k) {
        const std::string_view field = fields.next();
        float value = 0.0F;
        const auto result = std::from_chars(field.data(), field.data() + field.size(), value);
        if (result.ec != std::errc{} || !std::isfinite(value)) return Vec3::Zero();
        centre[k] = value;
    }
    return centre;
}

std::uint64_t facet_count(std::string_view content) {
    return load_number<std::uint32_t>(content.data() + header_size, std::endian::little);
}

surface::TriangleMesh decode_binary(std::string_view content, std::string_view file) {
    const std::uint64_t facets = facet_count(content);
    std::vector<Vec3> corners;
    corners.reserve(3 * facets);
    for (std::uint64_t f = 0; f < facets; ++f) {
        const std::size_t facet = data_start + facet_size * f;
        for (std::size_t c = 0; c < 3; ++c) {
            Vec3 p;
            for (std::size_t k = 0; k < 3; ++k) {
                const std::size_t at = facet + 12 + 12 * c + 4 * k;
                p[static_cast<Eigen::Index>(k)] =
                    load_number<float>(content.data() + at, std::endian::little);
            }
            if (!p.allFinite()) {
                text::fail(
                    "io.not_finite", {file, 0},
                    fmt::format("facet {} at byte {} has a coordinate that is NaN or infinite", f,
                                facet),
                    "remove the facet or export the file again");
            }
            corners.push_back(p);
        }
    }
    surface::TriangleMesh mesh = join(corners);
    const Vec3 centre = centre_of(content.substr(0, header_size));
    if (centre != Vec3::Zero()) {
        for (Vec3& p : mesh.points) p += centre;
    }
    return mesh;
}

/// In upper or lower case, because some programs write the words in capitals.
bool is_word(std::string_view found, std::string_view word) {
    return text::lower_case(found) == word;
}

class TextStl {
public:
    TextStl(std::string_view content, std::string_view file) : lines_(content, file) {}

    surface::TriangleMesh read() {
        std::string_view line;
        while (content_line(line)) {
            text::Fields fields(line);
            const std::string_view word = fields.next();
            if (is_word(word, "facet"))
                facet();
            else if (is_word(word, "endsolid"))
                open_ = false;
            else if (is_word(word, "solid") && !open_)
                open_ = true;
            else
                text::fail("io.syntax", lines_.place(),
                           text::in_quotes(word) + " where 'facet' or 'endsolid' should be",
                           text::export_again);
        }
        if (open_)
            text::fail("io.truncated", lines_.place(), "the file ends without 'endsolid'",
                       text::copy_again);
        return join(corners_);
    }

private:
    bool content_line(std::string_view& line) {
        while (lines_.next(line)) {
            if (line.find_first_not_of(" \t\r\v\f") != std::string_view::npos) return true;
        }
        return false;
    }

    text::Fields expect(std::string_view word) {
        std::string_view line;
        if (!content_line(line)) {
            text::fail("io.truncated", lines_.place(),
                       "the file ends where '" + std::string(word) + "' should be",
                       text::copy_again);
        }
        text::Fields fields(line);
        const std::string_view found = fields.next();
        if (!is_word(found, word)) {
            text::fail("io.syntax", lines_.place(),
                       text::in_quotes(found) + " where '" + std::string(word) + "' should be",
                       text::export_again);
        }
        return fields;
    }

    void facet() {
        expect("outer");
        for (int c = 0; c < 3; ++c) {
            text::Fields fields = expect("vertex");
            Vec3 p;
            for (int k = 0; k < 3; ++k) {
                const std::string_view field = fields.next();
                if (field.empty()) {
                    lines_.fail_short(fmt::format("vertex with {} of 3 coordinates", k));
                }
                p[k] = text::read_coordinate(field, lines_.place());
            }
            corners_.push_back(p);
        }
        expect("endloop");
        expect("endfacet");
    }

    text::Lines lines_;
    bool open_ = false;
    std::vector<Vec3> corners_;
};

/// Whether a file whose size does not fit a binary STL is text. A truncated binary file may also
/// begin with the word, but it contains zeros, which text does not.
bool is_text_stl(std::string_view content) {
    const std::size_t begin = content.find_first_not_of(" \t\r\n");
    constexpr std::size_t looked_at = 512;
    return begin != std::string_view::npos && is_word(content.substr(begin, 5), "solid") &&
           content.substr(0, looked_at).find('\0') == std::string_view::npos;
}

std::string header_of(const Vec3& centre) {
    std::string header =
        centre == Vec3::Zero() ? std::string("dsc surface") : std::string(centre_mark);
    if (centre != Vec3::Zero()) {
        for (int k = 0; k < 3; ++k) {
            text::append_number(header, static_cast<float>(centre[k]));
            header += ' ';
        }
    }
    header.resize(header_size, ' ');
    return header;
}

}  // namespace

surface::TriangleMesh decode_stl(std::string_view content, std::string_view file) {
    const bool fits = content.size() >= data_start &&
                      content.size() == data_start + facet_size * facet_count(content);
    if (fits) return decode_binary(content, file);
    if (has_wide_byte_order_mark(content)) {
        text::fail("io.format", {file, 0}, std::string(wide_text_cause),
                   std::string(wide_text_remedy));
    }
    const std::string_view text = without_byte_order_mark(content);
    if (is_text_stl(text)) return TextStl(text, file).read();
    if (content.size() < data_start) {
        text::fail("io.truncated", {file, 0},
                   fmt::format("a binary STL of {} is too short for its {} bytes of header",
                               text::counted(content.size(), "byte"), data_start),
                   text::copy_again);
    }
    const std::uint64_t expected = data_start + facet_size * facet_count(content);
    text::fail(expected > content.size() ? "io.truncated" : "io.count", {file, 0},
               fmt::format("the header announces {}, {} bytes in total, but the file has {}",
                           text::counted(facet_count(content), "facet"), expected, content.size()),
               text::copy_again);
}

std::string encode_stl(const surface::TriangleMesh& mesh) {
    const Vec3 centre = centre_to_subtract(mesh);
    std::string out = header_of(centre);
    out.reserve(data_start + facet_size * mesh.faces.size());
    append_bytes(out, static_cast<std::uint32_t>(mesh.faces.size()));
    for (const auto& face : mesh.faces) {
        std::array<Vec3, 3> p;
        for (std::size_t c = 0; c < 3; ++c) p[c] = mesh.points[face[c]] - centre;
        const Vec3 normal = geometry::triangle_normal(p[0], p[1], p[2]);
        for (const Vec3& v : {normal, p[0], p[1], p[2]}) {
            for (int k = 0; k < 3; ++k) append_bytes(out, static_cast<float>(v[k]));
        }
        append_bytes(out, std::uint16_t{0});
    }
    return out;
}

}  // namespace dsc::io
