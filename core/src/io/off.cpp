// Geomview OFF: a header, the counts, one line per vertex, one line per polygon; colours and
// normals are skipped.
#include <algorithm>
#include <array>

#include <fmt/core.h>

#include <dsc/decode/obj.hpp>
#include <dsc/text/numbers.hpp>
#include <dsc/text/reading.hpp>
#include <dsc/text/words.hpp>

#include "io/codecs.hpp"

namespace dsc::io {
namespace {

class OffReader {
public:
    OffReader(std::string_view content, std::string_view file)
        : size_(content.size()), lines_(content, file) {}

    surface::TriangleMesh read() {
        header();
        surface::TriangleMesh mesh;
        mesh.points.reserve(vertices_);
        for (std::size_t i = 0; i < vertices_; ++i) mesh.points.push_back(vertex(i));
        for (std::size_t i = 0; i < faces_; ++i) face(i, mesh);
        std::string_view line;
        if (content_line(line)) {
            text::fail("io.count", lines_.place(),
                       "data after the last of " + text::counted(faces_, "face"),
                       "the counts of the header are wrong: export the file again");
        }
        return mesh;
    }

private:
    /// The next line that is not only blanks and comments.
    bool content_line(std::string_view& line) {
        while (lines_.next(line)) {
            line = line.substr(0, line.find('#'));
            if (!std::all_of(line.begin(), line.end(), text::is_blank)) return true;
        }
        return false;
    }

    text::Fields require_line(std::string_view what) {
        std::string_view line;
        if (!content_line(line)) ends_before(what);
        return text::Fields(line);
    }

    /// The line of an item of a list. Its text is made only for an error.
    text::Fields require_line(std::string_view item, std::size_t index, std::size_t of) {
        std::string_view line;
        if (!content_line(line)) ends_before(fmt::format("{} {} of {}", item, index, of));
        return text::Fields(line);
    }

    [[noreturn]] void ends_before(std::string_view what) const {
        text::fail("io.truncated", lines_.place(),
                   fmt::format("the file ends where {} should be", what), text::copy_again);
    }

    void header() {
        constexpr std::array<std::string_view, 5> known = {"OFF", "COFF", "NOFF", "CNOFF", "STOFF"};
        text::Fields fields = require_line("the word OFF");
        const std::string_view word = fields.next();
        if (std::find(known.begin(), known.end(), word) == known.end()) {
            text::fail("io.syntax", lines_.place(),
                       "the file starts with " + text::in_quotes(word) + ", not with OFF",
                       "check that the file is an OFF file");
        }
        std::string_view field = fields.next();
        if (field == "BINARY") {
            text::fail("io.format", lines_.place(), "binary OFF is not read",
                       "export the file as text");
        }
        if (field.empty()) {
            fields = require_line("the counts of vertices and faces");
            field = fields.next();
        }
        vertices_ = count(field, "vertices");
        faces_ = count(fields.next(), "faces");
    }

    /// Every vertex and every face takes at least six bytes, so a false count cannot make the
    /// program reserve too much memory.
    std::size_t count(std::string_view field, const char* what) {
        if (field.empty()) {
            text::fail("io.syntax", lines_.place(),
                       std::string("the number of ") + what + " is missing", text::export_again);
        }
        const std::int64_t value = text::read_integer(field, lines_.place());
        if (value < 0 || static_cast<std::uint64_t>(value) > size_ / 6 + 1) {
            text::fail("io.count", lines_.place(),
                       fmt::format("{} {} cannot be in a file of {}", value, what,
                                   text::counted(size_, "byte")),
                       text::copy_again);
        }
        return static_cast<std::size_t>(value);
    }

    Vec3 vertex(std::size_t i) {
        text::Fields fields = require_line("vertex", i, vertices_);
        Vec3 p;
        for (int k = 0; k < 3; ++k) {
            const std::string_view field = fields.next();
            if (field.empty()) lines_.fail_short(fmt::format("vertex with {} of 3 coordinates", k));
            p[k] = text::read_coordinate(field, lines_.place());
        }
        return p;
    }

    void face(std::size_t i, surface::TriangleMesh& mesh) {
        text::Fields fields = require_line("face", i, faces_);
        const std::int64_t corners = text::read_integer(fields.next(), lines_.place());
        if (corners < 3) {
            text::fail("io.syntax", lines_.place(),
                       fmt::format("face with {} corners, at least 3 are needed", corners),
                       text::export_again);
        }
        polygon_.clear();
        for (std::int64_t k = 0; k < corners; ++k) {
            const std::string_view field = fields.next();
            if (field.empty()) {
                lines_.fail_short(fmt::format("face with {} of {} corners", k, corners));
            }
            const std::int64_t index = text::read_integer(field, lines_.place());
            if (index < 0 || index >= static_cast<std::int64_t>(vertices_)) {
                text::fail("io.index", lines_.place(),
                           fmt::format("vertex index {} of {}", index, vertices_),
                           "OFF counts from 0; export the file again");
            }
            polygon_.push_back(static_cast<std::uint32_t>(index));
        }
        decode::append_fan(mesh.faces, polygon_);
    }

    std::size_t size_;
    text::Lines lines_;
    std::size_t vertices_ = 0;
    std::size_t faces_ = 0;
    std::vector<std::uint32_t> polygon_;
};

}  // namespace

surface::TriangleMesh decode_off(std::string_view content, std::string_view file) {
    return OffReader(content, file).read();
}

std::string encode_off(const surface::TriangleMesh& mesh) {
    std::string out = "OFF\n";
    out.reserve(60 * mesh.points.size() + 24 * mesh.faces.size() + 64);
    text::append_number(out, std::uint64_t{mesh.points.size()});
    out += ' ';
    text::append_number(out, std::uint64_t{mesh.faces.size()});
    out += " 0\n";
    for (const Vec3& p : mesh.points) {
        for (int k = 0; k < 3; ++k) {
            text::append_number(out, p[k]);
            out += k < 2 ? ' ' : '\n';
        }
    }
    for (const auto& face : mesh.faces) {
        out += '3';
        for (const std::uint32_t v : face) {
            out += ' ';
            text::append_number(out, std::uint64_t{v});
        }
        out += '\n';
    }
    return out;
}

}  // namespace dsc::io
