// The .dsc text format of the original method: "v x y z" and "t i j k l label" in any order,
// indices from 0.
#include <limits>

#include <fmt/core.h>

#include <dsc/text/numbers.hpp>
#include <dsc/text/reading.hpp>
#include <dsc/text/words.hpp>

#include "io/codecs.hpp"

namespace dsc::io {
namespace {

struct LargestIndex {
    std::size_t line = 0;
    std::uint32_t index = 0;
};

std::uint32_t read_index(text::Tokens& tokens) {
    const std::int64_t index = tokens.integer();
    if (index < 0 || index >= std::numeric_limits<std::uint32_t>::max()) {
        text::fail("io.index", tokens.place(),
                   fmt::format("vertex index {} is out of range", index),
                   "indices count from 0; export the file again");
    }
    return static_cast<std::uint32_t>(index);
}

mesh::Label read_label(text::Tokens& tokens) {
    const std::int64_t label = tokens.integer();
    if (label < 0 || label > std::numeric_limits<mesh::Label>::max()) {
        text::fail("io.syntax", tokens.place(), fmt::format("label {} is out of range", label),
                   "labels are 0 (outside) or larger");
    }
    return static_cast<mesh::Label>(label);
}

}  // namespace

mesh::TetMesh decode_dsc(std::string_view content, std::string_view file) {
    mesh::TetMesh mesh;
    text::Tokens tokens(content, file);
    // The largest index decides whether all are in range, because vertices may follow the tets that
    // use them.
    LargestIndex largest;
    for (std::string_view tag = tokens.next(); !tag.empty(); tag = tokens.next()) {
        if (tag == "v") {
            const double x = tokens.coordinate(), y = tokens.coordinate(), z = tokens.coordinate();
            mesh.points.emplace_back(x, y, z);
        } else if (tag == "t") {
            std::array<std::uint32_t, 4> tet{};
            for (std::uint32_t& v : tet) {
                v = read_index(tokens);
                if (v > largest.index || largest.line == 0) largest = {tokens.place().line, v};
            }
            mesh.tets.push_back(tet);
            mesh.labels.push_back(read_label(tokens));
        } else {
            text::fail("io.syntax", tokens.place(),
                       text::in_quotes(tag) + " is neither 'v' nor 't'", text::export_again);
        }
    }
    if (!mesh.tets.empty() && largest.index >= mesh.points.size()) {
        text::fail("io.index", {file, largest.line},
                   fmt::format("vertex index {} of {}", largest.index, mesh.points.size()),
                   "indices count from 0; export the file again");
    }
    return mesh;
}

std::string encode_dsc(const mesh::TetMesh& mesh) {
    std::string out;
    out.reserve(60 * mesh.points.size() + 32 * mesh.tets.size());
    for (const Vec3& p : mesh.points) {
        out += 'v';
        for (int k = 0; k < 3; ++k) {
            out += ' ';
            text::append_number(out, p[k]);
        }
        out += '\n';
    }
    for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
        out += 't';
        for (const std::uint32_t v : mesh.tets[t]) {
            out += ' ';
            text::append_number(out, std::uint64_t{v});
        }
        out += ' ';
        out += std::to_string(mesh.labels[t]);
        out += '\n';
    }
    return out;
}

}  // namespace dsc::io
