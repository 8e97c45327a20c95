// Builds the flat view of the interface of a complex.
#include "dsc/surface/surface_view.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include <boost/sort/spreadsort/integer_sort.hpp>

#include <dsc/geometry/quality.hpp>
#include <dsc/surface/measure.hpp>

namespace dsc::surface {
namespace {

using RawFace = ViewMemory::Face;

constexpr std::size_t walk_block = 1024;     // vertices
constexpr std::size_t measure_block = 4096;  // vertices or faces

// Interface faces round v in which v has the least birth, each once, oriented out of the larger
// label.
void faces_led_by(const mesh::Complex& c, mesh::VertexId v, mesh::StarWalk& walk,
                  std::vector<RawFace>& out) {
    for (const mesh::TetId t : c.cached_star(v, walk).tets) {
        const mesh::Tet& tet = c.tet(t);
        for (unsigned f = 0; f < 4; ++f) {
            if (tet.v[f] == v) continue;
            // Of the two tets at a face the one with the larger label reports it.
            const mesh::Label across = c.label_across(t, f);
            if (c.label(t) <= across) continue;
            std::array<mesh::VertexId, 3> corners{};
            bool least = true;
            for (unsigned k = 0; k < 3; ++k) {
                corners[k] = tet.v[mesh::face_vertices[f][k]];
                least = least && c.birth(v) <= c.birth(corners[k]);
            }
            if (!least) continue;
            while (corners[0] != v)
                std::rotate(corners.begin(), corners.begin() + 1, corners.end());
            out.push_back({corners, t, {across, c.label(t)}});
        }
    }
}

}  // namespace

bool ViewMemory::known(const mesh::Complex& complex, mesh::VertexId v, std::uint32_t i) const {
    // Another vertex may use the slot now. The clock goes back if the dates are renewed.
    return i < births_.size() && births_[i] == complex.birth(v) &&
           complex.shape_date(v) <= clock_ && clock_ <= complex.clock();
}

std::span<const ViewMemory::Face> ViewMemory::faces_led_by(const mesh::Complex& complex,
                                                           mesh::VertexId v, std::uint32_t i,
                                                           bool& is_known) const {
    is_known = known(complex, v, i);
    if (!is_known) return {};
    return std::span(faces_).subspan(starts_[i], starts_[i + 1] - starts_[i]);
}

bool ViewMemory::only_moved(const mesh::Complex& complex, const SurfaceView& view) const {
    const auto interface = complex.interface_vertices();
    if (births_.empty() || interface.size() != births_.size() || view.births != births_ ||
        view.faces.size() != faces_.size() || view.vertex_faces.size() != 3 * faces_.size())
        return false;
    const std::vector<std::uint32_t>& index = arrays_.index;
    if (!std::all_of(interface.begin(), interface.end(), [&](mesh::VertexId v) {
            return v < index.size() && known(complex, v, index[v]);
        }))
        return false;
    // The caller may have given the view of another memory.
    for (std::size_t f = 0; f < faces_.size(); ++f) {
        for (std::size_t k = 0; k < 3; ++k) {
            if (view.vertex_ids[view.faces[f][k]] != faces_[f].vertices[k]) return false;
        }
        if (view.face_tets[f] != faces_[f].tet || view.face_labels[f] != faces_[f].labels)
            return false;
    }
    return true;
}

void ViewMemory::keep(const mesh::Complex& complex, const SurfaceView& view,
                      std::span<const std::uint32_t> counts, Workers* workers) {
    clock_ = complex.clock();
    births_ = view.births;
    starts_.resize(counts.size() + 1);
    starts_[0] = 0;
    std::partial_sum(counts.begin(), counts.end(), starts_.begin() + 1);
    faces_.resize(view.faces.size());
    for_blocks(workers, faces_.size(), measure_block, [&](std::size_t begin, std::size_t end) {
        for (std::size_t f = begin; f < end; ++f) {
            const auto& [a, b, c] = view.faces[f];
            faces_[f] = {{view.vertex_ids[a], view.vertex_ids[b], view.vertex_ids[c]},
                         view.face_tets[f],
                         view.face_labels[f]};
        }
    });
}

namespace {

// The interface vertices in ascending birth order.
void list_vertices(const mesh::Complex& c, SurfaceView& view, Workers* workers,
                   ViewMemory::Arrays& arrays) {
    const auto interface = c.interface_vertices();
    const std::size_t n = interface.size();
    std::vector<std::uint64_t>& keys = arrays.keys;
    // The birth before the vertex, so that sorting does not look into the complex.
    keys.resize(n);
    for_blocks(workers, n, measure_block, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            keys[i] = std::uint64_t{c.birth(interface[i])} << 32U | interface[i];
    });
    boost::sort::spreadsort::integer_sort(keys.begin(), keys.end());
    view.vertex_ids.resize(n);
    view.births.resize(n);
    view.movable.resize(n);
    arrays.last.resize(n);
    if (arrays.index.size() < c.vertex_slots()) arrays.index.resize(c.vertex_slots());
    for_blocks(workers, n, measure_block, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const auto v = static_cast<mesh::VertexId>(keys[i]);
            view.vertex_ids[i] = v;
            arrays.last[i] = std::exchange(arrays.index[v], static_cast<std::uint32_t>(i));
            view.births[i] = static_cast<std::uint32_t>(keys[i] >> 32U);
            view.movable[i] = c.movable(v) ? 1 : 0;
        }
    });
}

// Joins the faces of the blocks, which hold those of `n` vertices.
void list_faces(SurfaceView& view, std::size_t n, Workers* workers, ViewMemory::Arrays& arrays) {
    const std::size_t used = block_count(n, walk_block);
    std::size_t count = 0;
    for (std::size_t b = 0; b < used; ++b) {
        arrays.blocks[b].first = count;
        count += arrays.blocks[b].faces.size();
    }
    view.faces.resize(count);
    view.face_tets.resize(count);
    view.face_labels.resize(count);
    for_blocks(workers, used, 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t b = begin; b < end; ++b) {
            std::size_t f = arrays.blocks[b].first;
            for (const RawFace& face : arrays.blocks[b].faces) {
                for (std::size_t k = 0; k < 3; ++k)
                    view.faces[f][k] = arrays.index[face.vertices[k]];
                view.face_tets[f] = face.tet;
                view.face_labels[f] = face.labels;
                ++f;
            }
        }
    });
}

// Vertices, faces and what belongs to them, but not what depends on positions.
void connect(const mesh::Complex& c, SurfaceView& view, Workers* workers, ViewMemory* memory) {
    ViewMemory::Arrays own;
    ViewMemory::Arrays& arrays = memory != nullptr ? memory->arrays() : own;
    list_vertices(c, view, workers, arrays);
    const std::size_t n = view.vertex_ids.size();
    std::vector<ViewMemory::Arrays::Block>& blocks = arrays.blocks;
    blocks.resize(std::max(blocks.size(), block_count(n, walk_block)));
    struct Job {
        const mesh::Complex& c;
        const SurfaceView& view;
        ViewMemory::Arrays& arrays;
        const ViewMemory* memory;
    } const job{c, view, arrays, memory};
    arrays.counts.resize(n);
    for_blocks(workers, n, walk_block, [&job](std::size_t begin, std::size_t end) {
        const std::vector<std::uint32_t>& index = job.arrays.index;
        mesh::StarWalk& walk = job.arrays.blocks[begin / walk_block].walk;
        std::vector<RawFace>& raw = job.arrays.blocks[begin / walk_block].faces;
        raw.clear();
        for (std::size_t i = begin; i < end; ++i) {
            const auto first = static_cast<std::ptrdiff_t>(raw.size());
            const mesh::VertexId v = job.view.vertex_ids[i];
            bool known = false;
            if (job.memory != nullptr) {
                const std::span<const RawFace> faces =
                    job.memory->faces_led_by(job.c, v, job.arrays.last[i], known);
                raw.insert(raw.end(), faces.begin(), faces.end());
            }
            if (!known) {
                faces_led_by(job.c, v, walk, raw);
                std::sort(raw.begin() + first, raw.end(), [&](const RawFace& a, const RawFace& b) {
                    return std::pair(index[a.vertices[1]], index[a.vertices[2]]) <
                           std::pair(index[b.vertices[1]], index[b.vertices[2]]);
                });
            }
            job.arrays.counts[i] = static_cast<std::uint32_t>(raw.end() - raw.begin() - first);
        }
    });
    list_faces(view, n, workers, arrays);
    if (memory != nullptr) memory->keep(c, view, arrays.counts, workers);
}

// The faces round each vertex.
void list_faces_of_vertices(SurfaceView& view) {
    const std::size_t n = view.vertex_ids.size();
    view.face_offsets.assign(n + 1, 0);
    for (const auto& face : view.faces) {
        for (const auto v : face) ++view.face_offsets[v + 1];
    }
    for (std::size_t i = 0; i < n; ++i) view.face_offsets[i + 1] += view.face_offsets[i];
    view.vertex_faces.resize(3 * view.faces.size());
    // Filling in the order of the faces keeps the faces of each vertex in ascending order; the
    // shift below restores the offsets.
    for (std::size_t f = 0; f < view.faces.size(); ++f) {
        for (const auto v : view.faces[f])
            view.vertex_faces[view.face_offsets[v]++] = static_cast<std::uint32_t>(f);
    }
    for (std::size_t i = n; i > 0; --i) view.face_offsets[i] = view.face_offsets[i - 1];
    view.face_offsets[0] = 0;
}

// The normals of some vertices.
void find_normals(SurfaceView& view, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
        Vec3 sum = Vec3::Zero();
        for (std::uint32_t k = view.face_offsets[i]; k < view.face_offsets[i + 1]; ++k)
            sum += view.face_normals[view.vertex_faces[k]];
        const double length = sum.norm();
        view.normals[i] = length > 1e-8 ? Vec3(sum / length) : Vec3(Vec3::Zero());
    }
}

// The areas and normals of some faces.
void measure_faces(SurfaceView& view, std::size_t begin, std::size_t end) {
    for (std::size_t f = begin; f < end; ++f) {
        const Vec3 &p = view.positions[view.faces[f][0]], &q = view.positions[view.faces[f][1]],
                   &r = view.positions[view.faces[f][2]];
        const Vec3 cross = (q - p).cross(r - p);
        const double length = cross.norm();
        view.face_areas[f] = 0.5 * length;
        view.face_normals[f] = length > 0.0 ? Vec3(cross / length) : Vec3(Vec3::Zero());
    }
}

// Positions, areas and normals of a connected view, and the faces round each vertex, if they are
// not known.
void measure(const mesh::Complex& c, SurfaceView& view, bool faces_known, Workers* workers) {
    const std::size_t n = view.vertex_ids.size(), m = view.faces.size();
    view.positions.resize(n);
    for_blocks(workers, n, measure_block, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            view.positions[i] = c.position(view.vertex_ids[i]);
    });
    view.previous_positions = view.positions;
    view.arrived.assign(n, 1);
    view.age.assign(n, 0);
    view.face_normals.resize(m);
    view.face_areas.resize(m);
    // One thread lists the faces of the vertices, as block 0.
    for_blocks(
        workers, block_count(m, measure_block) + 1, 1, [&](std::size_t begin, std::size_t end) {
            for (std::size_t b = begin; b < end; ++b) {
                if (b > 0)
                    measure_faces(view, (b - 1) * measure_block, std::min(b * measure_block, m));
                else if (!faces_known)
                    list_faces_of_vertices(view);
            }
        });
    view.normals.resize(n);
    // The mean edge is a sum in the order of the faces, so one thread computes it, as block 0.
    for_blocks(workers, block_count(n, measure_block) + 1, 1,
               [&view, n](std::size_t begin, std::size_t end) {
                   for (std::size_t b = begin; b < end; ++b) {
                       if (b == 0)
                           view.mean_edge = mean_edge(view.positions, view.faces);
                       else
                           find_normals(view, (b - 1) * measure_block,
                                        std::min(b * measure_block, n));
                   }
               });
}

}  // namespace

void build_view(const mesh::Complex& c, SurfaceView& view, Workers* workers, ViewMemory* memory) {
    const bool only_moved = memory != nullptr && memory->only_moved(c, view);
    if (only_moved) {
        memory->keep(c);
    } else {
        connect(c, view, workers, memory);
    }
    measure(c, view, only_moved, workers);
}

}  // namespace dsc::surface
