// Saves and loads the sums and the progress of a run.
#include "saved_run.hpp"

#include <algorithm>
#include <sstream>

namespace dsc::run {
namespace {

void save(StateWriter& out, const hooks::Figures& figures) {
    out.value<std::uint64_t>(figures.size());
    for (const auto& [name, value] : figures) {
        out.text(name);
        out.value(value);
    }
}

void load(StateReader& in, hooks::Figures& figures) {
    figures.clear();
    for (auto count = in.value<std::uint64_t>(); count > 0; --count) {
        const std::string name(in.text());
        figures.emplace_back(name, in.value<double>());
    }
}

/// Visits the plain members in one order, for saving and loading.
template <class Totals, class Visit>
void each_plain(Totals& t, Visit&& visit) {
    visit(t.steps);
    visit(t.status);
    visit(t.volume_initial);
    visit(t.rounds);
    visit(t.requested);
    visit(t.arrived);
    visit(t.clamped);
    visit(t.dropped_motion);
    visit(t.edit_distance);
    visit(t.edit_volume);
    visit(t.relabelled_volume);
    visit(t.crease_exceptions);
    visit(t.refinements);
    visit(t.refine_requested);
    visit(t.refine_committed);
    visit(t.refine_edits);
    visit(t.operations);
    visit(t.repair_classes);
    visit(t.events);
    visit(t.adopted);
    visit(t.seconds);
}

template <class Owner, class Visit>
void each_strategy(Owner& all, Visit&& visit) {
    visit(*all.initial_mesh);
    visit(*all.velocity);
    visit(*all.improvement);
    for (auto& refinement : all.refinements) {
        if (refinement) visit(*refinement);
    }
    for (auto& observer : all.observers) visit(*observer);
}

}  // namespace

void save(StateWriter& out, const RunTotals& totals) {
    each_plain(totals, [&](const auto& value) { out.value(value); });
    save(out, totals.initial_mesh);
    save(out, totals.initial_mesh_seconds);
    out.value(static_cast<std::uint64_t>(totals.warnings.size()));
    for (const hooks::Warning& warning : totals.warnings) {
        out.text(warning.code);
        out.text(warning.text);
    }
}

void load(StateReader& in, RunTotals& totals) {
    each_plain(totals, [&](auto& value) { in.value(value); });
    load(in, totals.initial_mesh);
    load(in, totals.initial_mesh_seconds);
    std::uint64_t warnings = 0;
    in.value(warnings);
    totals.warnings.clear();
    for (std::uint64_t i = 0; i < warnings; ++i) {
        std::string code(in.text());
        totals.warnings.push_back({std::move(code), std::string(in.text())});
    }
}

StrategyState state_of(const hooks::Strategy& strategy) {
    StrategyState state{&strategy};
    try {
        std::ostringstream bytes(std::ios::binary);
        strategy.save(bytes);
        state.bytes = bytes.str();
    } catch (...) {
        state.fault = std::current_exception();
    }
    return state;
}

void save(StateWriter& out, const Strategies& strategies, std::span<const StrategyState> earlier) {
    each_strategy(strategies, [&](const hooks::Strategy& strategy) {
        const auto found = std::find_if(
            earlier.begin(), earlier.end(),
            [&strategy](const StrategyState& state) { return state.strategy == &strategy; });
        const StrategyState state = found != earlier.end() ? *found : state_of(strategy);
        if (state.fault) std::rethrow_exception(state.fault);
        out.text(state.bytes);
    });
}

void load(StateReader& in, Strategies& strategies) {
    each_strategy(strategies, [&](hooks::Strategy& strategy) {
        std::istringstream state(std::string(in.text()), std::ios::binary);
        strategy.load(state);
    });
}

}  // namespace dsc::run
