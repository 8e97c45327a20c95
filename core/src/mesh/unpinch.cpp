// Makes irregular vertices regular by splitting or relabelling (method.md, section 8.6).
#include "dsc/mesh/unpinch.hpp"

#include <algorithm>
#include <string>

#include <dsc/base/error.hpp>
#include <dsc/geometry/point_text.hpp>
#include <dsc/mesh/local_star.hpp>
#include <dsc/mesh/vertex_split.hpp>

namespace dsc::mesh {
namespace {

constexpr double quality_floor = 1e-3;

// One face-connected group of a label in the star of the vertex.
struct Group {
    std::vector<TetId> tets;
    double volume = 0.0;
    bool on_box = false;
};

std::vector<Group> groups_of(const Complex& c, LocalStar& star) {
    std::vector<Group> groups(star.groups());
    for (std::size_t i = 0; i < star.nodes().size(); ++i) {
        Group& group = groups[star.group_of()[i]];
        const TetId t = star.nodes()[i];
        if (t == none) {
            group.on_box = true;
            continue;
        }
        group.tets.push_back(t);
        group.volume += c.volume(t);
    }
    // Smallest first; equal ones in the order of their first tet in the star's walk.
    std::stable_sort(groups.begin(), groups.end(), [](const Group& x, const Group& y) {
        return x.tets.size() != y.tets.size() ? x.tets.size() < y.tets.size() : x.volume < y.volume;
    });
    return groups;
}

bool split_group(Complex& c, VertexId v, const Group& group) {
    const std::vector<RimFace> rim = rim_of(c, v, group.tets);
    Edit edit;
    if (rim.empty() ||
        !plan_vertex_split(c, v, group.tets, rim, RimLabel::across, quality_floor, edit))
        return false;
    if (!c.link(edit)) return false;
    c.replace(edit);
    return true;
}

bool relabel_group(Complex& c, VertexId v, const Group& group) {
    if (group.on_box || group.tets.empty()) return false;
    for (const TetId t : group.tets) {
        for (const VertexId w : c.tet(t).v) {
            if (c.on_box(w)) return false;
        }
    }
    Label around = 0;
    bool known = false;
    for (const TetId t : group.tets) {
        for (unsigned f = 0; f < 4; ++f) {
            if (c.tet(t).v[f] == v || !c.interface_face(t, f)) continue;
            if (known && around != c.label_across(t, f)) return false;
            around = c.label_across(t, f);
            known = true;
        }
    }
    if (!known) return false;
    c.relabel(group.tets, around);
    return true;
}

[[noreturn]] void refuse(const Complex& c, VertexId v, LocalStar& star, std::string_view name) {
    std::vector<Label> labels;
    for (std::size_t i = 0; i < star.nodes().size(); ++i) labels.push_back(star.label(i));
    std::sort(labels.begin(), labels.end());
    labels.erase(std::unique(labels.begin(), labels.end()), labels.end());
    std::string list;
    for (const Label l : labels) list += (list.empty() ? "" : ", ") + std::to_string(l);
    throw GeometryError("mesh.pinched", name,
                        "labels " + list + " touch at vertex " + std::to_string(v) + " " +
                            geometry::point_text(c.position(v)) + " and cannot be separated",
                        "relabel the tets there");
}

}  // namespace

std::size_t unpinch(Complex& c, std::string_view name, std::span<const VertexId> seeds) {
    std::vector<VertexId> queue(seeds.begin(), seeds.end());
    LocalStar star(c);
    std::size_t treated = 0;
    // Each split separates one group from a vertex. Relabelling may move a problem to another
    // vertex, so the number of attempts is limited.
    std::size_t budget = 64 * (queue.size() + 16);
    for (std::size_t i = 0; i < queue.size(); ++i) {
        const VertexId v = queue[i];
        bool counted = false;
        while (c.vertex_alive(v) && c.on_interface(v)) {
            star.build(v);
            if (star.regular()) break;
            if (budget-- == 0) refuse(c, v, star, name);
            treated += counted ? 0 : 1;
            counted = true;
            const std::vector<Group> groups = groups_of(c, star);
            std::vector<VertexId> link;
            for (const TetId t : star.nodes()) {
                if (t != none) link.insert(link.end(), c.tet(t).v.begin(), c.tet(t).v.end());
            }
            bool done = false;
            for (const Group& group : groups) {
                if (done || group.on_box) continue;
                done = split_group(c, v, group);
            }
            for (const Group& group : groups) {
                if (done) break;
                done = relabel_group(c, v, group);
            }
            if (!done) refuse(c, v, star, name);
            std::sort(link.begin(), link.end());
            link.erase(std::unique(link.begin(), link.end()), link.end());
            for (const VertexId w : link) {
                if (w == v || !c.vertex_alive(w) || !c.on_interface(w)) continue;
                star.build(w);
                if (!star.regular()) queue.push_back(w);
            }
        }
    }
    return treated;
}

std::size_t unpinch(Complex& c, std::string_view name, Workers* workers) {
    const std::span<const VertexId> vertices = c.interface_vertices();
    std::vector<std::uint8_t> regular(vertices.size(), 0);
    for_blocks(workers, vertices.size(), 2048, [&](std::size_t begin, std::size_t end) {
        LocalStar star(c);
        for (std::size_t i = begin; i < end; ++i) {
            star.build(vertices[i]);
            regular[i] = star.regular() ? 1 : 0;
        }
    });
    std::vector<VertexId> irregular;
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        if (regular[i] == 0) irregular.push_back(vertices[i]);
    }
    std::sort(irregular.begin(), irregular.end(),
              [&c](VertexId a, VertexId b) { return c.birth(a) < c.birth(b); });
    return unpinch(c, name, irregular);
}

}  // namespace dsc::mesh
