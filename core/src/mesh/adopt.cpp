// Turns plain arrays into a complex, or names the first fault (method.md, section 1.3).
#include "dsc/mesh/adopt.hpp"

#include <cmath>
#include <string>

#include <dsc/base/error.hpp>
#include <dsc/base/release.hpp>
#include <dsc/base/union_find.hpp>
#include <dsc/geometry/point_text.hpp>
#include <dsc/geometry/predicates.hpp>
#include <dsc/geometry/quality.hpp>
#include <dsc/mesh/face_groups.hpp>
#include <dsc/mesh/unpinch.hpp>
#include <dsc/text/numbers.hpp>

namespace dsc::mesh {
namespace {

[[noreturn]] void refuse(std::string_view name, const std::string& code, const std::string& cause,
                         const std::string& remedy) {
    throw GeometryError(code, name, cause, remedy);
}

void check_arrays(const TetMesh& mesh, std::string_view name) {
    if (mesh.tets.empty())
        refuse(name, "mesh.empty", "the mesh has no tets",
               "provide a box filled with labelled tets");
    if (mesh.labels.size() != mesh.tets.size()) {
        refuse(name, "mesh.labels",
               std::to_string(mesh.labels.size()) + " labels for " +
                   std::to_string(mesh.tets.size()) + " tets",
               "provide exactly one label per tet");
    }
    for (std::size_t i = 0; i < mesh.points.size(); ++i) {
        if (!mesh.points[i].allFinite()) {
            refuse(name, "mesh.not_finite",
                   "vertex " + std::to_string(i) + " has a coordinate that is not finite",
                   "fix or remove this vertex and export the mesh again");
        }
    }
    for (std::size_t i = 0; i < mesh.tets.size(); ++i) {
        for (const std::uint32_t v : mesh.tets[i]) {
            if (v < mesh.points.size()) continue;
            refuse(name, "mesh.index",
                   "tet " + std::to_string(i) + " uses vertex " + std::to_string(v) + " of " +
                       std::to_string(mesh.points.size()),
                   "indices count from 0");
        }
    }
}

// Drops unused points; `tets` receive the new indices.
std::vector<Vec3> used_points(const TetMesh& mesh, LargeVector<TetCorners>& tets,
                              AdoptReport& report) {
    std::vector<std::uint32_t> index(mesh.points.size(), none);
    for (const auto& t : mesh.tets) {
        for (const std::uint32_t v : t) index[v] = 0;
    }
    std::vector<Vec3> points;
    for (std::size_t i = 0; i < index.size(); ++i) {
        if (index[i] == none) {
            ++report.dropped_vertices;
            continue;
        }
        index[i] = static_cast<std::uint32_t>(points.size());
        points.push_back(mesh.points[i]);
    }
    tets.resize(mesh.tets.size());
    for (std::size_t i = 0; i < tets.size(); ++i) {
        for (unsigned k = 0; k < 4; ++k) tets[i][k] = index[mesh.tets[i][k]];
    }
    return points;
}

constexpr std::size_t adopt_block = 16384;

// Results of the blocks of one loop, by block number.
template <class T>
std::vector<T> per_block(std::size_t count) {
    return std::vector<T>(count / adopt_block + 1);
}

void orient(const std::vector<Vec3>& points, LargeVector<TetCorners>& tets, std::string_view name,
            AdoptReport& report, Workers* workers) {
    struct Found {
        std::size_t turned = 0, flat = 0, first_flat = 0;
    };
    std::vector<Found> blocks = per_block<Found>(tets.size());
    for_blocks(workers, tets.size(), adopt_block, [&](std::size_t begin, std::size_t end) {
        Found found;
        for (std::size_t i = begin; i < end; ++i) {
            auto& v = tets[i];
            const int sign =
                geometry::orient3d(points[v[0]], points[v[1]], points[v[2]], points[v[3]]);
            if (sign < 0) {
                std::swap(v[2], v[3]);
                ++found.turned;
            } else if (sign == 0 && found.flat++ == 0) {
                found.first_flat = i;
            }
        }
        blocks[begin / adopt_block] = found;
    });
    std::size_t flat = 0, first = 0;
    for (const Found& found : blocks) {
        report.reoriented_tets += found.turned;
        if (flat == 0) first = found.first_flat;
        flat += found.flat;
    }
    if (flat == 0) return;
    refuse(name, "mesh.flat_tet",
           "tet " + std::to_string(first) + " at " + geometry::point_text(points[tets[first][0]]) +
               " has zero volume (" + std::to_string(flat) + " in total)",
           "remove flat tets, or write the coordinates with more digits");
}

// A forbidden kind of face: how many there are, and the first one.
struct Fault {
    std::size_t count = 0;
    std::uint32_t tet = 0, vertex = 0;

    void note(const FaceKey& key, const FaceUse& use) {
        if (count++ == 0) *this = {1, use.code >> 2U, key[0]};
    }
    void add(const Fault& later) {
        const std::size_t sum = count + later.count;
        if (count == 0) *this = later;
        count = sum;
    }
};

// Joins equal faces: `neighbours` receive what lies across each face. Positive tets on the two
// sides of a face have its vertices in opposite order.
void join_faces(const std::vector<Vec3>& points, const LargeVector<TetCorners>& tets,
                LargeVector<TetNeighbours>& neighbours, std::string_view name, Workers* workers) {
    neighbours.assign(tets.size(), {none, none, none, none});
    FaceTable table =
        deal_faces(points.size(), tets.size(), [&](std::size_t t) { return &tets[t]; });
    struct Found {
        Fault crowded, same_side;
    };
    std::vector<Found> blocks = per_block<Found>(points.size());
    for_blocks(workers, points.size(), adopt_block, [&](std::size_t begin, std::size_t end) {
        Found found;
        visit_faces(table, begin, end, [&](const FaceKey& key, std::span<const FaceUse> uses) {
            if (uses.size() > 2) {
                found.crowded.note(key, uses[2]);
            } else if (uses.size() == 2) {
                if (uses[0].odd == uses[1].odd) {
                    found.same_side.note(key, uses[1]);
                } else {
                    neighbours[uses[0].code >> 2U][uses[0].code & 3U] = uses[1].code;
                    neighbours[uses[1].code >> 2U][uses[1].code & 3U] = uses[0].code;
                }
            }
        });
        blocks[begin / adopt_block] = found;
    });
    Fault crowded, same_side;
    for (const Found& found : blocks) {
        crowded.add(found.crowded);
        same_side.add(found.same_side);
    }
    const auto face_text = [&](const Fault& fault) {
        return "tet " + std::to_string(fault.tet) + " at " +
               geometry::point_text(points[fault.vertex]);
    };
    if (crowded.count > 0) {
        refuse(name, "mesh.crowded_face",
               face_text(crowded) + " has a face that two other tets already have (" +
                   std::to_string(crowded.count) + " in total)",
               "remove duplicate tets: some writers repeat the last line of the file");
    }
    if (same_side.count > 0) {
        refuse(name, "mesh.same_side",
               face_text(same_side) + " lies on the same side of a face as its neighbour (" +
                   std::to_string(same_side.count) + " in total)",
               "tets must not overlap");
    }
}

void check_volume(const std::vector<Vec3>& points, const LargeVector<TetCorners>& tets,
                  std::string_view name) {
    double sum = 0.0;
    for (const TetCorners& v : tets)
        sum += geometry::tet_volume(points[v[0]], points[v[1]], points[v[2]], points[v[3]]);
    const Vec3 size = bounding_box(points).size();
    const double box = size.x() * size.y() * size.z();
    if (std::abs(sum - box) <= 1e-9 * box) return;
    refuse(name, "mesh.volume",
           "the tets' volumes add up to " + text::rounded(sum, 12) + ", their bounding box has " +
               text::rounded(box, 12),
           "the tets must fill an axis-parallel box without gaps or overlaps");
}

// Whether every face without a second tet lies exactly in one side of the box. Then the tets of
// every vertex are joined through faces. Reason: the tets are positive and joined on both sides of
// every other face, so they cover the inside of the box equally often everywhere; this is once,
// because their volumes add up to the box. If the tets of a vertex were not joined through faces,
// each group of them would cover the surroundings of the vertex.
bool open_faces_are_on_box(const Complex& c) {
    const Box3 box = c.box();
    const auto side_of = [&](const Vec3& p) {
        unsigned sides = 0;
        for (unsigned i = 0; i < 3; ++i)
            sides |= (p[i] == box.low[i] ? 1U << i : 0U) | (p[i] == box.high[i] ? 8U << i : 0U);
        return sides;
    };
    for (TetId t = 0; t < c.tet_slots(); ++t) {
        for (unsigned f = 0; f < 4; ++f) {
            if (c.across(t, f) != none) continue;
            unsigned common = ~0U;
            for (const auto k : face_vertices[f]) common &= side_of(c.position(c.tet(t).v[k]));
            if (common == 0) return false;
        }
    }
    return true;
}

void check_stars(const Complex& c, std::string_view name) {
    if (open_faces_are_on_box(c)) return;
    std::vector<std::uint32_t> degree(c.vertex_slots(), 0);
    for (TetId t = 0; t < c.tet_slots(); ++t) {
        for (const VertexId v : c.tet(t).v) ++degree[v];
    }
    std::vector<TetId> star;
    for (VertexId v = 0; v < c.vertex_slots(); ++v) {
        c.star(v, star);
        if (star.size() == degree[v]) continue;
        refuse(name, "mesh.torn_star",
               "the tets at vertex " + std::to_string(v) + " " +
                   geometry::point_text(c.position(v)) + " are not joined through faces",
               "the mesh must be conforming");
    }
}

// Marks the tets of face-connected components of equal label that are clearly larger than the
// volume. Most tets belong to such components, and a union over the tets in their order uses the
// memory better than a walk from tet to tet.
std::vector<char> tets_of_large_components(const Complex& c, double volume) {
    const auto count = static_cast<TetId>(c.tet_slots());
    UnionFind components(count);
    for (TetId t = 0; t < count; ++t) {
        if (!c.tet_alive(t)) continue;
        for (unsigned f = 0; f < 4; ++f) {
            const std::uint32_t code = c.across(t, f);
            if (code == none || neighbour_tet(code) > t ||
                c.label(neighbour_tet(code)) != c.label(t))
                continue;
            components.join(t, neighbour_tet(code));
        }
    }
    std::vector<char> large(count, 0);
    std::vector<double> sums(count, 0.0);
    for (TetId t = 0; t < count; ++t) {
        const TetId first = components.find(t);
        if (!c.tet_alive(t) || large[first] != 0) continue;
        sums[first] += c.volume(t);
        large[first] = sums[first] > 2 * volume ? 1 : 0;
    }
    for (TetId t = 0; t < count; ++t) large[t] = large[components.find(t)];
    return large;
}

// Face-connected components of equal label below the volume take the label around them if there is
// exactly one. The largest component of label 0, and all components on the box, stay.
std::size_t remove_small_components(Complex& c, double volume) {
    std::size_t removed = 0;
    std::vector<char> seen = tets_of_large_components(c, volume);
    std::vector<TetId> component;
    for (TetId start = 0; start < c.tet_slots(); ++start) {
        if (!c.tet_alive(start) || seen[start] != 0) continue;
        component.assign(1, start);
        seen[start] = 1;
        double sum = 0.0;
        Label around = c.label(start);
        bool one = true, box = false;
        for (std::size_t i = 0; i < component.size(); ++i) {
            sum += c.volume(component[i]);
            for (unsigned f = 0; f < 4; ++f) {
                const std::uint32_t code = c.across(component[i], f);
                if (code == none) {
                    box = true;
                    continue;
                }
                const TetId next = neighbour_tet(code);
                if (c.label(next) != c.label(start)) {
                    if (around != c.label(start) && around != c.label(next)) one = false;
                    around = c.label(next);
                } else if (seen[next] == 0) {
                    seen[next] = 1;
                    component.push_back(next);
                }
            }
        }
        if (sum >= volume || box || !one || around == c.label(start)) continue;
        c.relabel(component, around);
        ++removed;
    }
    return removed;
}

}  // namespace

std::size_t orient(TetMesh& mesh) {
    std::size_t turned = 0;
    for (auto& [a, b, c, d] : mesh.tets) {
        if (geometry::orient3d(mesh.points[a], mesh.points[b], mesh.points[c], mesh.points[d]) >= 0)
            continue;
        std::swap(c, d);
        ++turned;
    }
    return turned;
}

Complex adopt(TetMesh mesh, std::string_view name, AdoptReport* report, double min_component,
              Workers* workers) {
    AdoptReport local;
    AdoptReport& out = report != nullptr ? *report : local;
    out = {};
    check_arrays(mesh, name);
    LargeVector<TetCorners> tets;
    LargeVector<TetNeighbours> neighbours;
    std::vector<Vec3> points = used_points(mesh, tets, out);
    release(mesh.points);
    release(mesh.tets);
    orient(points, tets, name, out, workers);
    join_faces(points, tets, neighbours, name, workers);
    check_volume(points, tets, name);
    Complex complex = Complex::assemble(std::move(points), std::move(tets), std::move(neighbours),
                                        mesh.labels, workers);
    check_stars(complex, name);
    out.unpinched_vertices = unpinch(complex, name, workers);
    const double edge = mean_interface_edge(complex);
    out.vanished_components =
        remove_small_components(complex, min_component * geometry::regular_tet_volume(edge));
    return complex;
}

}  // namespace dsc::mesh
