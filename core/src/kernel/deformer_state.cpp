// The state of a Deformer: construction, limits and lengths (method.md, section 3).
#include "kernel/deformer_state.hpp"

#include <algorithm>
#include <cmath>

#include <dsc/geometry/quality.hpp>

namespace dsc::kernel {

Deformer::State::State(mesh::Complex start, const DeformerOptions& wanted, Workers* given)
    : complex(std::move(start)),
      options(wanted),
      bench(complex),
      queues(complex, wanted.audit, wanted.drop_wake_up),
      topology(bench),
      star_loop(complex),
      destinations(complex, queues, star_loop),
      fields(complex, destinations),
      // Wake-ups must be counted in the order of one thread.
      workers(wanted.drop_wake_up == 0 ? given : nullptr) {
    bench.listener = &fields;
    length = mean_interface_edge();
    apply_limits(0.995);
}

void Deformer::State::apply_limits(double flatness,
                                   const std::optional<repair::CreaseRule>& creases) {
    if (bench.limits.length != length) bench.forget_refusals();
    bench.limits = {length, options.quality_floor, options.max_edit_distance * length,
                    options.max_edit_volume * geometry::regular_tet_volume(length), flatness};
    bench.limits.set_floor(options.quality_floor);
    if (!creases) return;
    bench.limits.crease = std::cos(creases->dihedral);
    bench.limits.turn = std::cos(creases->turn);
}

double Deformer::State::mean_interface_edge() const {
    double sum = 0.0;
    std::size_t edges = 0;
    std::vector<VertexId> order(complex.interface_vertices().begin(),
                                complex.interface_vertices().end());
    std::sort(order.begin(), order.end(),
              [this](VertexId a, VertexId b) { return complex.birth(a) < complex.birth(b); });
    std::vector<TetId> star;
    std::vector<std::uint32_t> ends;
    std::vector<std::pair<std::uint32_t, double>> lengths;
    for (const VertexId v : order) {
        complex.star(v, star);
        lengths.clear();
        for (const TetId t : star) {
            for (unsigned f = 0; f < 4; ++f) {
                if (complex.tet(t).v[f] == v || !complex.interface_face(t, f)) continue;
                for (const auto k : mesh::face_vertices[f]) {
                    const VertexId w = complex.tet(t).v[k];
                    if (complex.birth(w) > complex.birth(v))
                        lengths.emplace_back(complex.birth(w),
                                             (complex.position(w) - complex.position(v)).norm());
                }
            }
        }
        std::sort(lengths.begin(), lengths.end());
        lengths.erase(std::unique(lengths.begin(), lengths.end()), lengths.end());
        for (const auto& edge : lengths) sum += edge.second;
        edges += lengths.size();
    }
    return edges > 0 ? sum / static_cast<double>(edges) : 0.0;
}

void Deformer::State::fields_changed() { bench.lengths = fields.find(length_field); }

void Deformer::State::set_length(double everywhere) {
    fields.remove(length_field);
    fields_changed();
    length = everywhere;
    apply_limits(bench.limits.flatness);
}

}  // namespace dsc::kernel
