// The tests that every edit must pass, and its commit (method.md, sections 3 and 4.1).
#include "kernel/workbench.hpp"

#include <cmath>

#include <dsc/geometry/quality.hpp>
#include <dsc/mesh/star_quality.hpp>

namespace dsc::kernel {

double Workbench::quality(VertexId a, VertexId b, VertexId c, VertexId d) const {
    return geometry::tet_quality(at(a), at(b), at(c), at(d));
}

double Workbench::length_at(std::span<const VertexId> at_vertices) const {
    if (lengths == nullptr) return limits.length;
    double sum = 0.0;
    unsigned count = 0;
    for (const VertexId v : at_vertices) {
        if (v >= lengths->size() || !((*lengths)[v] > 0.0)) continue;
        sum += (*lengths)[v];
        ++count;
    }
    return count > 0 ? sum / count : limits.length;
}

EditBounds Workbench::bounds_at(std::span<const VertexId> at_vertices) const {
    if (lengths == nullptr) return {limits.edit_distance, limits.edit_volume};
    const double scale = length_at(at_vertices) / limits.length;
    return {limits.edit_distance * scale, limits.edit_volume * scale * scale * scale};
}

float Workbench::old_quality() const {
    float least = 1.0F;
    for (const TetId t : edit.removed) least = std::min(least, complex.quality(t));
    return least;
}

Outcome Workbench::check_shape(float must_exceed, float old) {
    const float floor = std::min(static_cast<float>(limits.quality_floor), old);
    edit.qualities.clear();
    for (const mesh::NewTet& t : edit.added) {
        const auto q = static_cast<float>(quality(t.v[0], t.v[1], t.v[2], t.v[3]));
        if (!(q > must_exceed) || !(q >= floor)) return Refusal::quality;
        edit.qualities.push_back(q);
    }
    // The exact test comes last: candidates that fail are usually far from flat.
    for (std::size_t i = 0; i < edit.added.size(); ++i) {
        const auto& v = edit.added[i].v;
        if (!mesh::exactly_positive({&at(v[0]), &at(v[1]), &at(v[2]), &at(v[3])},
                                    edit.qualities[i]))
            return Refusal::quality;
    }
    return success;
}

Outcome Workbench::check_topology(std::span<const VertexId> touched) {
    int before = 0;
    int after = 0;
    for (const VertexId v : touched) {
        if (v != mesh::created_vertex) {
            star_.build(v);
            before += star_.euler_share();
        }
        if (v == edit.deleted) continue;
        star_.build(v, edit);
        if (!star_.regular()) return Refusal::irregular;
        after += star_.euler_share();
    }
    return before == after ? success : Outcome(Refusal::irregular);
}

double Workbench::phase_change() const {
    struct Sum {
        mesh::Label label;
        double volume;
    };
    std::array<Sum, 8> sums_of{};
    std::size_t count = 0;
    const auto add = [&](mesh::Label label, double volume) {
        for (std::size_t i = 0; i < count; ++i) {
            if (sums_of[i].label == label) {
                sums_of[i].volume += volume;
                return;
            }
        }
        if (count < sums_of.size()) sums_of[count++] = {label, volume};
    };
    for (const TetId t : edit.removed) add(complex.label(t), -complex.volume(t));
    for (const mesh::NewTet& t : edit.added) {
        add(t.label, geometry::tet_volume(at(t.v[0]), at(t.v[1]), at(t.v[2]), at(t.v[3])));
    }
    double total = 0.0;
    for (std::size_t i = 0; i < count; ++i) total += std::abs(sums_of[i].volume);
    return 0.5 * total;
}

VertexId Workbench::commit(const InterfaceChange& change) {
    sums.distance += change.distance;
    sums.volume += change.volume;
    return complex.replace(edit);
}

void Workbench::commit(const Relabelling& relabelling, const InterfaceChange& change) {
    sums.distance += change.distance;
    sums.volume += change.volume;
    sums.relabelled += relabelling.volume;
    complex.relabel(relabelling.tets, relabelling.label);
}

void Workbench::interface_fan(VertexId v, std::span<const TetId> star,
                              std::vector<std::array<VertexId, 3>>& out) const {
    out.clear();
    for (const TetId t : star) {
        const mesh::Tet& tet = complex.tet(t);
        for (unsigned f = 0; f < 4; ++f) {
            if (tet.v[f] == v || complex.label(t) <= complex.label_across(t, f)) continue;
            std::array<VertexId, 3> corners{};
            for (unsigned k = 0; k < 3; ++k) corners[k] = tet.v[mesh::face_vertices[f][k]];
            while (corners[0] != v)
                std::rotate(corners.begin(), corners.begin() + 1, corners.end());
            out.push_back(corners);
        }
    }
}

std::uint32_t Workbench::new_vertex_epoch() {
    if (vertex_marks_.size() < complex.vertex_slots())
        vertex_marks_.resize(complex.vertex_slots(), 0);
    return ++vertex_epoch_;
}

void Workbench::shared_interface_vertices(std::span<const TetId> star_a,
                                          std::span<const TetId> star_b,
                                          std::vector<VertexId>& out) {
    out.clear();
    const std::uint32_t first_star = new_vertex_epoch(), listed = new_vertex_epoch();
    for (const TetId t : star_a) {
        for (const VertexId w : complex.tet(t).v) vertex_marks_[w] = first_star;
    }
    for (const TetId t : star_b) {
        for (const VertexId w : complex.tet(t).v) {
            if (vertex_marks_[w] != first_star || !complex.on_interface(w)) continue;
            vertex_marks_[w] = listed;
            out.push_back(w);
        }
    }
    std::sort(out.begin(), out.end());
}

void Workbench::cavity_interface_vertices(std::vector<VertexId>& out) const {
    out.clear();
    for (const TetId t : edit.removed) {
        for (const VertexId v : complex.tet(t).v) {
            if (complex.on_interface(v)) out.push_back(v);
        }
    }
    std::sort(out.begin(), out.end());
    out.erase(std::unique(out.begin(), out.end()), out.end());
    out.push_back(mesh::created_vertex);
}

std::optional<Refusal> Workbench::known_refusal(VertexId v, Smoother smoother,
                                                float accept_above) const {
    if (v >= memory_.size()) return std::nullopt;
    const auto i = static_cast<std::size_t>(smoother);
    const Memory& m = memory_[v];
    if (complex.vertex_date(v) > m.date[i] || !m.last[i].refused()) return std::nullopt;
    if (smoother == Smoother::laplacian && m.accept_above != accept_above) return std::nullopt;
    return m.last[i].reason();
}

Refusal Workbench::remember(VertexId v, Smoother smoother, float accept_above, Refusal refusal,
                            std::uint32_t date) {
    provide_memory();
    const auto i = static_cast<std::size_t>(smoother);
    Memory& m = memory_[v];
    m.date[i] = date;
    m.last[i] = refusal;
    if (smoother == Smoother::laplacian) m.accept_above = accept_above;
    return refusal;
}

bool Workbench::flat(VertexId v) {
    if (limits.flatness != flat_limit_ || flat_memory_.empty())
        flat_memory_.assign(flat_answers, Flatness{});
    flat_limit_ = limits.flatness;
    Flatness& memory = flat_memory_[v % flat_answers];
    const std::uint32_t date = complex.vertex_date(v);
    if (memory.vertex != v || memory.date != date) memory = {v, date, find_flat(v)};
    return memory.flat;
}

bool Workbench::find_flat(VertexId v) {
    interface_fan(v, complex.cached_star(v, flat_walk_).tets, fan_);
    normals_.clear();
    for (const auto& face : fan_) {
        normals_.push_back(geometry::triangle_normal(
            complex.position(face[0]), complex.position(face[1]), complex.position(face[2])));
    }
    for (std::size_t i = 0; i < normals_.size(); ++i) {
        for (std::size_t j = i + 1; j < normals_.size(); ++j) {
            if (normals_[i].dot(normals_[j]) < limits.flatness) return false;
        }
    }
    return true;
}

}  // namespace dsc::kernel
