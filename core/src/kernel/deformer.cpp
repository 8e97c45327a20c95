// A Deformer as a table of contents: a step, a refinement, a relabelling, lengths and attributes,
// checkpoints. The parts of the first three are in step.cpp, refine.cpp and relabelling.cpp.
#include <algorithm>
#include <limits>
#include <numeric>

#include <dsc/base/state.hpp>
#include <dsc/mesh/unpinch.hpp>

#include "kernel/deformer_state.hpp"

namespace dsc::kernel {

Deformer::Deformer(mesh::Complex complex, const DeformerOptions& options, Workers* workers)
    : state_(std::make_unique<State>(std::move(complex), options, workers)) {}
Deformer::~Deformer() = default;
Deformer::Deformer(Deformer&&) noexcept = default;
Deformer& Deformer::operator=(Deformer&&) noexcept = default;

const mesh::Complex& Deformer::complex() const { return state_->complex; }
double Deformer::target_length() const { return state_->length; }
std::uint64_t Deformer::step_count() const { return state_->step; }

StepReport Deformer::step(std::span<const VertexId> vertices, std::span<const Vec3> displacements,
                          const RepairPolicy& policy) {
    State& s = *state_;
    StepReport report;
    s.begin_step(vertices, displacements, policy, report);
    s.move_and_repair(policy, report);
    s.change_topology(policy, report);
    s.sum_up(report);
    return report;
}

std::span<const std::uint32_t> Deformer::not_arrived() const {
    return state_->destinations.not_arrived();
}

RefineReport Deformer::refine(std::span<const std::array<VertexId, 3>> faces,
                              std::span<const std::array<VertexId, 2>> edges) {
    RefineRequests requests;
    requests.split_faces.assign(faces.begin(), faces.end());
    requests.split_edges.assign(edges.begin(), edges.end());
    return refine(requests);
}

RefineReport Deformer::refine(const RefineRequests& requests) {
    State& s = *state_;
    RefineReport report;
    s.apply_limits(s.bench.limits.flatness, requests.creases);
    const Limits before = s.bench.limits;
    s.bench.crease_exceptions = 0;
    s.split_all(requests, report);
    s.edit_all(requests, report);
    s.bench.limits = before;
    s.fields.settle();
    report.crease_exceptions = s.bench.crease_exceptions;
    report.length_changed = report.splits.committed > 0 && !requests.owns_sizing;
    if (report.length_changed) s.set_length(mesh::mean_interface_edge(s.complex));
    return report;
}

std::size_t Deformer::relabel(std::span<const TetId> tets, std::span<const mesh::Label> labels,
                              const RepairPolicy& policy, std::vector<Event>& events) {
    State& s = *state_;
    s.apply_limits(policy.flatness);
    const mesh::InterfaceCounts before = mesh::count_interface(s.complex);
    std::vector<VertexId> touched;
    const Event event = s.take_labels(tets, labels, touched);
    if (event.tets == 0) return 0;
    const std::size_t unpinched = mesh::unpinch(s.complex, "relabelling", touched);
    s.fields.settle();  // unpinching creates vertices
    append_changes(event, before, mesh::count_interface(s.complex), unpinched, events);
    return event.tets;
}

void Deformer::set_target_length(double length) { state_->set_length(length); }

void Deformer::set_target_lengths(std::span<const VertexId> vertices,
                                  std::span<const double> lengths) {
    if (lengths.empty()) return;
    State& s = *state_;
    s.length =
        std::accumulate(lengths.begin(), lengths.end(), 0.0) / static_cast<double>(lengths.size());
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

void Deformer::set_attribute(std::string_view name, std::span<const VertexId> vertices,
                             std::span<const double> values) {
    state_->fields.set(name, vertices, values, 0.0);
    state_->fields_changed();
    state_->fields.settle();
}

std::vector<std::string> Deformer::attributes() const {
    std::vector<std::string> names = state_->fields.names();
    names.erase(std::remove(names.begin(), names.end(), length_field), names.end());
    return names;
}

std::vector<double> Deformer::attribute(std::string_view name,
                                        std::span<const VertexId> vertices) const {
    const std::vector<double>* values = state_->fields.find(name);
    std::vector<double> out;
    if (values == nullptr) return out;
    out.reserve(vertices.size());
    for (const VertexId v : vertices) {
        out.push_back(state_->complex.on_interface(v) ? (*values)[v]
                                                      : std::numeric_limits<double>::quiet_NaN());
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
