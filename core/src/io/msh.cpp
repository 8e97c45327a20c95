// Gmsh MSH 4.1 as text. Each label is a separate volume and the physical group "label_N", both with
// the tag N + 1, because tags count from 1. The number of an element is that of its tet plus 1, so
// a reader can restore the order of the tets.
#include <limits>
#include <map>

#include <fmt/core.h>

#include <dsc/base/error.hpp>
#include <dsc/text/numbers.hpp>

#include "io/codecs.hpp"

namespace dsc::io {
namespace {

/// The tets per label, in their order.
std::map<mesh::Label, std::vector<std::size_t>> by_label(const mesh::TetMesh& mesh) {
    std::map<mesh::Label, std::vector<std::size_t>> groups;
    for (std::size_t t = 0; t < mesh.tets.size(); ++t) groups[mesh.labels[t]].push_back(t);
    for (const auto& [label, tets] : groups) {
        if (label >= 0 && label < std::numeric_limits<mesh::Label>::max()) continue;
        throw GeometryError("volume.label", "volume",
                            fmt::format("tet {} has the label {}", tets.front(), label),
                            ".msh can store labels from 0 to 2147483646, write a .vtu or .dsc");
    }
    return groups;
}

std::string tag_of(mesh::Label label) { return std::to_string(std::int64_t{label} + 1); }

void append_point(std::string& out, const Vec3& p, char end) {
    for (int k = 0; k < 3; ++k) {
        text::append_number(out, p[k]);
        out += k < 2 ? ' ' : end;
    }
}

/// "1 COUNT 1 COUNT" or "BLOCKS COUNT 1 COUNT": blocks, elements, their least and greatest number.
void append_counts(std::string& out, std::size_t blocks, std::size_t count) {
    out +=
        std::to_string(blocks) + ' ' + std::to_string(count) + " 1 " + std::to_string(count) + '\n';
}

Box3 box_of(const mesh::TetMesh& mesh, const std::vector<std::size_t>& tets) {
    Box3 box;
    for (const std::size_t t : tets) {
        for (const std::uint32_t v : mesh.tets[t]) box.extend(mesh.points[v]);
    }
    return box;
}

}  // namespace

std::string encode_msh(const mesh::TetMesh& mesh) {
    const auto groups = by_label(mesh);
    std::string out = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$PhysicalNames\n";
    out.reserve(70 * mesh.points.size() + 40 * mesh.tets.size() + 256 * groups.size() + 512);
    out += std::to_string(groups.size()) + '\n';
    for (const auto& [label, tets] : groups) {
        out += fmt::format("3 {} \"label_{}\"\n", tag_of(label), label);
    }
    out += "$EndPhysicalNames\n$Entities\n0 0 0 " + std::to_string(groups.size()) + '\n';
    for (const auto& [label, tets] : groups) {
        const Box3 box = box_of(mesh, tets);
        out += tag_of(label) + ' ';
        append_point(out, box.low, ' ');
        append_point(out, box.high, ' ');
        out += "1 " + tag_of(label) + " 0\n";
    }
    out += "$EndEntities\n$Nodes\n";
    // All nodes in one block, in the order of the points. The block belongs to the first volume,
    // because every node must belong to one.
    append_counts(out, 1, mesh.points.size());
    out += "3 " + (groups.empty() ? "1" : tag_of(groups.begin()->first)) + " 0 " +
           std::to_string(mesh.points.size()) + '\n';
    for (std::size_t i = 1; i <= mesh.points.size(); ++i) {
        text::append_number(out, std::uint64_t{i});
        out += '\n';
    }
    for (const Vec3& p : mesh.points) append_point(out, p, '\n');
    out += "$EndNodes\n$Elements\n";
    append_counts(out, groups.size(), mesh.tets.size());
    for (const auto& [label, tets] : groups) {
        out += "3 " + tag_of(label) + " 4 " + std::to_string(tets.size()) + '\n';
        for (const std::size_t t : tets) {
            text::append_number(out, std::uint64_t{t} + 1);
            for (const std::uint32_t v : mesh.tets[t]) {
                out += ' ';
                text::append_number(out, std::uint64_t{v} + 1);
            }
            out += '\n';
        }
    }
    out += "$EndElements\n";
    return out;
}

}  // namespace dsc::io
