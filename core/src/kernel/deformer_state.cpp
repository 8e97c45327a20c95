// A Deformer outside its steps: construction, lengths and attributes, checkpoints.
#include "kernel/deformer_state.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <dsc/base/state.hpp>
#include <dsc/geometry/quality.hpp>

namespace dsc::kernel {

Deformer::State::State(mesh::Complex start, const DeformerOptions& wanted, Workers* given)
    : complex(std::move(start)),
      options(wanted),
      bench(complex),
      queues(complex, wanted.audit, wanted.drop_wake_up),
      topology(bench),
      star_loop(complex),
      travels(complex, queues, star_loop),
      fields(complex, travels),
      // Wake-ups must be counted in the order of one thread.
      workers(wanted.drop_wake_up == 0 ? given : nullptr) {
    bench.listener = &fields;
    length = mean_interface_edge();
    apply_limits(0.995);
}

void Deformer::State::apply_limits(double flatness, const std::optional<repair::CreaseRule>& creases) {
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
    std::vector<VertexId> order(complex.interface_vertices().begin(), complex.interface_vertices().end());
    std::sort(order.begin(), order.end(), [this](VertexId a, VertexId b) { return complex.birth(a) < complex.birth(b); });
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
                    if (complex.birth(w) > complex.birth(v)) lengths.emplace_back(complex.birth(w), (complex.position(w) - complex.position(v)).norm());
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

Deformer::Deformer(mesh::Complex complex, const DeformerOptions& options, Workers* workers)
    : state_(std::make_unique<State>(std::move(complex), options, workers)) {}
Deformer::~Deformer() = default;
Deformer::Deformer(Deformer&&) noexcept = default;
Deformer& Deformer::operator=(Deformer&&) noexcept = default;

const mesh::Complex& Deformer::complex() const { return state_->complex; }
double Deformer::target_length() const { return state_->length; }
std::uint64_t Deformer::step_count() const { return state_->step; }

void Deformer::set_target_length(double length) { state_->set_length(length); }

void Deformer::set_target_lengths(std::span<const VertexId> vertices, std::span<const double> lengths) {
    if (lengths.empty()) return;
    State& s = *state_;
    s.length = std::accumulate(lengths.begin(), lengths.end(), 0.0) / static_cast<double>(lengths.size());
    s.fields.set(length_field, vertices, lengths, s.length);
    s.fields_changed();
    s.fields.settle();
    s.apply_limits(s.bench.limits.flatness);
}

std::vector<double> Deformer::target_lengths(std::span<const VertexId> vertices) const {
    std::vector<double> lengths;
    if (state_->bench.lengths == nullptr) return lengths;
    lengths.reserve(vertices.size());
    for (const VertexId v : vertices) lengths.push_back(state_->bench.length_at(v));
    return lengths;
}

void Deformer::set_attribute(std::string_view name, std::span<const VertexId> vertices, std::span<const double> values) {
    state_->fields.set(name, vertices, values, 0.0);
    state_->fields_changed();
    state_->fields.settle();
}

std::vector<std::string> Deformer::attributes() const {
    std::vector<std::string> names = state_->fields.names();
    names.erase(std::remove(names.begin(), names.end(), length_field), names.end());
    return names;
}

std::vector<double> Deformer::attribute(std::string_view name, std::span<const VertexId> vertices) const {
    const std::vector<double>* values = state_->fields.find(name);
    std::vector<double> out;
    if (values == nullptr) return out;
    out.reserve(vertices.size());
    for (const VertexId v : vertices) {
        out.push_back(state_->complex.on_interface(v) ? (*values)[v] : std::numeric_limits<double>::quiet_NaN());
    }
    return out;
}

void Deformer::save(StateWriter& out) const {
    state_->complex.save(out);
    out.value(state_->length);
    out.value(state_->step);
    out.value(state_->bench.limits);
    state_->queues.save(out);
    state_->topology.save(out);
    state_->fields.save(out);
}

Deformer Deformer::load(StateReader& in, const DeformerOptions& options, Workers* workers) {
    Deformer deformer(mesh::Complex::load(in), options, workers);
    State& s = *deformer.state_;
    in.value(s.length);
    in.value(s.step);
    in.value(s.bench.limits);
    s.queues.load(in);
    s.topology.load(in);
    s.fields.load(in);
    s.fields_changed();
    return deformer;
}

}  // namespace dsc::kernel
