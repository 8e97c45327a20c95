// The state of a Deformer: construction, limits and lengths (method.md, section 3).
#include "kernel/deformer_state.hpp"

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
      foresights(bench),
      // Wake-ups must be counted in the order of one thread.
      workers(wanted.drop_wake_up == 0 ? given : nullptr) {
    bench.listener = &fields;
    length = mesh::mean_interface_edge(complex);
    apply_limits(repair::default_flatness);
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

void Deformer::State::fields_changed() { bench.lengths = fields.find(length_field); }

void Deformer::State::set_length(double everywhere) {
    fields.remove(length_field);
    fields_changed();
    length = everywhere;
    apply_limits(bench.limits.flatness);
}

}  // namespace dsc::kernel
