// The topology stage: finds seeds, evaluates candidates, commits the selected ones (method.md,
// sections 8.1 to 8.5).
#include "kernel/topology.hpp"

#include <cmath>
#include <limits>

#include <dsc/base/state.hpp>
#include <dsc/geometry/quality.hpp>
#include <dsc/mesh/tet_visit.hpp>

namespace dsc::kernel {
namespace {

constexpr std::uint64_t rest_steps = 5;  // steps in which the vertices of an event take part in no
                                         // change that undoes it
constexpr double longest_edge = 1.0;     // of a seed, in L
constexpr double thickest_neck = 0.5;    // area of a neck's cross-section, in L^2
constexpr double events_per_vertex = 0.02;   // per step
constexpr std::size_t seed_block = 2048;     // changed tets per block of the parallel search
constexpr std::size_t small_component = 64;  // largest number of tets that a flood visits

// The label at an interface vertex that is not `own`; `own` if there is not exactly one such label.
mesh::Label other_label(const mesh::Complex& c, std::span<const TetId> star, mesh::Label own) {
    mesh::Label other = own;
    for (const TetId t : star) {
        if (c.label(t) == own) continue;
        if (other != own && other != c.label(t)) return own;
        other = c.label(t);
    }
    return other;
}

using Kind = repair::TopologyCandidate::Kind;

Kind kind_of(const Region& region) {
    if (region.patches_from == 2) return Kind::cut;
    if (region.patches_to == 1) return Kind::shift;
    return region.from > 0 ? Kind::open : Kind::merge;
}

bool wanted(Kind kind, const repair::TopologyLimits& limits) {
    switch (kind) {
        case Kind::open:
        case Kind::shift: return limits.open;
        case Kind::merge: return limits.merge;
        case Kind::cut: return limits.cut;
    }
    return false;
}

}  // namespace

bool TopologyStage::recent(VertexId v, mesh::Label from, std::uint64_t step) const {
    if (v >= event_step_.size() || event_step_[v] == 0 ||
        event_birth_[v] != bench_.complex.birth(v))
        return false;
    if (event_to_[v] != from) return false;
    return event_step_[v] - 1 + rest_steps >= step;
}

void TopologyStage::mark_event(const Region& region, std::uint64_t step) {
    const mesh::Complex& c = bench_.complex;
    event_step_.resize(std::max(event_step_.size(), c.vertex_slots()), 0);
    event_birth_.resize(event_step_.size(), 0);
    event_to_.resize(event_step_.size(), 0);
    last_event_ = std::max(last_event_, step + 1);
    for (const TetId t : region.tets) {
        for (const VertexId v : c.tet(t).v) {
            event_step_[v] = step + 1;
            event_birth_[v] = c.birth(v);
            event_to_[v] = region.to;
        }
    }
}

void TopologyStage::add_seed(std::array<VertexId, 3> v, SeedBlock& block) const {
    const mesh::Complex& c = bench_.complex;
    const auto birth = [&c](VertexId x) { return x == mesh::none ? mesh::none : c.birth(x); };
    std::sort(v.begin(), v.end(), [&](VertexId x, VertexId y) { return birth(x) < birth(y); });
    block.seeds.push_back({{birth(v[0]), birth(v[1]), birth(v[2])}, v});
}

bool TopologyStage::interface_edge(TetId t, VertexId a, VertexId b, mesh::EdgeRing& ring) const {
    constexpr std::size_t any_number = std::numeric_limits<std::size_t>::max();
    return !bench_.complex.inner_ring(t, a, b, any_number, ring);
}

bool TopologyStage::neck_face(TetId t, unsigned face, mesh::EdgeRing& ring) const {
    const mesh::Complex& c = bench_.complex;
    const std::uint32_t code = c.across(t, face);
    if (code == mesh::none || mesh::neighbour_tet(code) < t ||
        c.label(mesh::neighbour_tet(code)) != c.label(t))
        return false;
    const auto& f = mesh::face_vertices[face];
    const auto& v = c.tet(t).v;
    const double area =
        geometry::triangle_area(c.position(v[f[0]]), c.position(v[f[1]]), c.position(v[f[2]]));
    const double length = bench_.length_at(v);
    if (area > thickest_neck * length * length) return false;
    for (unsigned k = 0; k < 3; ++k) {
        if (!interface_edge(t, v[f[k]], v[f[(k + 1) % 3]], ring)) return false;
    }
    return true;
}

void TopologyStage::collect_seeds_of(TetId t, std::uint64_t step, SeedBlock& block) const {
    const mesh::Complex& c = bench_.complex;
    const auto& v = c.tet(t).v;
    std::array<bool, 4> ready{};
    for (unsigned i = 0; i < 4; ++i) ready[i] = c.movable(v[i]);
    // Most tets are not at the interface.
    if (ready[0] + ready[1] + ready[2] + ready[3] < 2) return;
    if (last_event_ != 0 && last_event_ - 1 + rest_steps >= step) {
        for (unsigned i = 0; i < 4; ++i) ready[i] = ready[i] && !recent(v[i], c.label(t), step);
    }
    const int count = ready[0] + ready[1] + ready[2] + ready[3];
    if (count < 2) return;
    const double length = bench_.length_at(v);
    const double limit2 = longest_edge * longest_edge * length * length;
    std::array<bool, 6> wanted{};
    for (unsigned k = 0; k < 6; ++k) {
        const auto& e = mesh::edge_vertices[k];
        wanted[k] = (ready[e[0]] & ready[e[1]]) != 0 &&
                    (c.position(v[e[0]]) - c.position(v[e[1]])).squaredNorm() <= limit2;
    }
    if (std::find(wanted.begin(), wanted.end(), true) != wanted.end()) {
        std::array<bool, 4> interface {};
        for (unsigned f = 0; f < 4; ++f) interface[f] = c.interface_face(t, f);
        for (unsigned k = 0; k < 6; ++k) {
            if (!wanted[k]) continue;
            // A quick test for most interface edges: one of the two faces at the edge, opposite the
            // other vertices, is on the interface.
            const auto& e = mesh::edge_vertices[k];
            const auto& other = mesh::edge_vertices[5 - k];
            if (interface[other[0]] || interface[other[1]]) continue;
            if (!interface_edge(t, v[e[0]], v[e[1]], block.ring))
                add_seed({v[e[0]], v[e[1]], mesh::none}, block);
        }
    }
    for (unsigned f = 0; f < 4 && count > 2; ++f) {
        const auto& k = mesh::face_vertices[f];
        if (ready[k[0]] && ready[k[1]] && ready[k[2]] && neck_face(t, f, block.ring))
            add_seed({v[k[0]], v[k[1]], v[k[2]]}, block);
    }
}

void TopologyStage::collect_seeds(std::uint64_t step, std::span<const TetId> changed,
                                  Workers* workers) {
    struct Job {
        TopologyStage& stage;
        std::span<const TetId> changed;
        std::uint64_t step;
    } const job{*this, changed, step};
    const std::size_t count = block_count(changed.size(), seed_block);
    seed_blocks_.resize(std::max(seed_blocks_.size(), count));
    const std::span<SeedBlock> blocks(seed_blocks_.data(), count);
    for (SeedBlock& block : blocks) block.seeds.clear();
    const auto body = [&job](std::size_t begin, std::size_t end) {
        SeedBlock& block = job.stage.seed_blocks_[begin / seed_block];
        const mesh::Complex& c = job.stage.bench_.complex;
        const auto may_have_edge = [&c](TetId t) {
            const auto& v = c.tet(t).v;
            return c.movable(v[0]) + c.movable(v[1]) + c.movable(v[2]) + c.movable(v[3]) >= 2;
        };
        const std::span<const TetId> tets = job.changed.subspan(begin, end - begin);
        mesh::visit_tets(c, tets, may_have_edge, [&](std::size_t i) {
            if (c.tet_alive(tets[i])) job.stage.collect_seeds_of(tets[i], job.step, block);
        });
    };
    for_blocks(workers, changed.size(), seed_block, body);
    seeds_.clear();
    for (const SeedBlock& block : blocks)
        seeds_.insert(seeds_.end(), block.seeds.begin(), block.seeds.end());
    std::sort(seeds_.begin(), seeds_.end(),
              [](const Seed& x, const Seed& y) { return x.births < y.births; });
    seeds_.erase(std::unique(seeds_.begin(), seeds_.end(),
                             [](const Seed& x, const Seed& y) { return x.births == y.births; }),
                 seeds_.end());
}

bool TopologyStage::usable(const Seed& seed, mesh::Label from, std::uint64_t step) const {
    const mesh::Complex& c = bench_.complex;
    return std::all_of(seed.v.begin(), seed.v.end(), [&](VertexId v) {
        return v == mesh::none || (c.movable(v) && !recent(v, from, step));
    });
}

RegionFault TopologyStage::start(const Seed& seed, Region& region) {
    const mesh::Complex& c = bench_.complex;
    const TetId t = c.find_edge(seed.v[0], seed.v[1]);
    if (t == mesh::none) return RegionFault::kind;
    c.ring(t, seed.v[0], seed.v[1], ring_);
    if (!ring_.closed) return RegionFault::box;
    region.tets.clear();
    for (const TetId r : ring_.tets) {
        if (seed.v[2] == mesh::none || mesh::has_vertex(c.tet(r), seed.v[2]))
            region.tets.push_back(r);
    }
    if (region.tets.empty()) return RegionFault::kind;
    region.from = c.label(region.tets.front());
    for (const TetId r : region.tets) {
        if (c.label(r) != region.from) return RegionFault::kind;
    }
    region.to = region.from;
    for (const VertexId v : seed.v) {
        if (v == mesh::none) continue;
        const mesh::Label other = other_label(c, c.cached_star(v, walk_).tets, region.from);
        if (other == region.from || (region.to != region.from && region.to != other))
            return RegionFault::labels;
        region.to = other;
    }
    return RegionFault::none;
}

RegionFault TopologyStage::region_of(const Seed& seed, Region& region) {
    if (const RegionFault fault = start(seed, region); fault != RegionFault::none) return fault;
    if (const RegionFault fault = grow(bench_, region); fault != RegionFault::none) return fault;
    if (const RegionFault fault = measure(bench_, region); fault != RegionFault::none) return fault;
    const unsigned s = region.patches_from, o = region.patches_to;
    const bool known =
        (s == 1 && o == 2) || (s == 2 && o == 1) || (s == 1 && o == 1 && region.from > 0);
    return known ? RegionFault::none : RegionFault::kind;
}

bool TopologyStage::same_shell(std::span<const VertexId> from, std::span<const VertexId> to) {
    const mesh::Complex& c = bench_.complex;
    seen_.resize(std::max(seen_.size(), c.vertex_slots()), 0);
    ++seen_epoch_;
    queue_.clear();
    for (const VertexId v : from) {
        if (!c.on_interface(v) || seen_[v] == seen_epoch_) continue;
        seen_[v] = seen_epoch_;
        queue_.push_back(v);
    }
    for (std::size_t i = 0; i < queue_.size(); ++i) {
        const VertexId v = queue_[i];
        for (const TetId t : c.cached_star(v, walk_).tets) {
            const mesh::Tet& tet = c.tet(t);
            for (unsigned f = 0; f < 4; ++f) {
                if (tet.v[f] == v || !c.interface_face(t, f)) continue;
                for (const auto k : mesh::face_vertices[f]) {
                    if (seen_[tet.v[k]] == seen_epoch_) continue;
                    seen_[tet.v[k]] = seen_epoch_;
                    queue_.push_back(tet.v[k]);
                }
            }
        }
    }
    return std::any_of(to.begin(), to.end(),
                       [this](VertexId v) { return seen_[v] == seen_epoch_; });
}

// The target length at a region: at its first tet, from which it grew.
double TopologyStage::length_at(const Region& region) const {
    return bench_.length_at(bench_.complex.tet(region.tets.front()).v);
}

Event TopologyStage::commit(const Region& region, std::uint64_t step) {
    Event event;
    event.step = step;
    event.place = region.centroid;
    event.label = region.from;
    event.tets = region.tets.size();
    event.volume = region.volume;
    event.thickness = thickness(region) / length_at(region);
    const bool bridged = region.patches_to == 2 && same_shell(region.patch_a, region.patch_b);
    bench_.commit(relabelling(region));
    if (region.patches_to == 2) {
        event.kind = bridged ? Event::Kind::handle_opened : Event::Kind::merge;
    } else if (region.patches_from == 2) {
        event.kind = same_shell(region.patch_a, region.patch_b) ? Event::Kind::handle_closed
                                                                : Event::Kind::split;
    } else {
        event.kind = region.patches_from == 0 ? Event::Kind::vanished : Event::Kind::born;
        event.thickness = 0.0;
    }
    mark_event(region, step);
    return event;
}

void TopologyStage::run(std::uint64_t step, std::span<const TetId> changed,
                        const repair::TopologyLimits& limits, const Select& select,
                        std::vector<Event>& events, Workers* workers) {
    if (!(limits.thickness > 0.0)) return;
    const mesh::Complex& c = bench_.complex;
    collect_seeds(step, changed, workers);
    found_.clear();
    Region& region = region_;
    for (const Seed& seed : seeds_) {
        if (region_of(seed, region) != RegionFault::none) continue;
        repair::TopologyCandidate candidate;
        candidate.kind = kind_of(region);
        if (!wanted(candidate.kind, limits)) continue;
        candidate.label = region.from;
        candidate.centroid = region.centroid;
        candidate.thickness = thickness(region) / length_at(region);
        candidate.volume = region.volume / geometry::regular_tet_volume(length_at(region));
        if (candidate.thickness <= limits.thickness) found_.push_back({seed, candidate});
    }
    if (found_.empty()) return;
    batch_.clear();
    for (const Found& f : found_) batch_.push_back(f.candidate);
    accept_.assign(batch_.size(), select ? 0 : 1);
    if (select) select(batch_, accept_);
    order_.clear();
    for (std::size_t i = 0; i < found_.size(); ++i) {
        if (accept_[i] != 0) order_.push_back(&found_[i]);
    }
    const auto key = [](const Found& f) { return std::llround(f.candidate.thickness * 1e6); };
    std::sort(order_.begin(), order_.end(), [&](const Found* x, const Found* y) {
        const auto kx = key(*x), ky = key(*y);
        if (kx != ky) return kx < ky;
        return x->seed.births < y->seed.births;
    });
    const auto most = static_cast<std::size_t>(
        std::max(1.0, events_per_vertex * static_cast<double>(c.interface_vertices().size())));
    std::size_t committed = 0, shifted = 0;
    touched_.clear();
    for (const Found* f : order_) {
        const bool shift = f->candidate.kind == repair::TopologyCandidate::Kind::shift;
        if ((shift ? shifted : committed) == most) continue;
        if (!usable(f->seed, f->candidate.label, step) ||
            region_of(f->seed, region) != RegionFault::none)
            continue;
        if (kind_of(region) != f->candidate.kind ||
            thickness(region) / length_at(region) > limits.thickness)
            continue;
        if (shift) {
            const InterfaceChange change{0.0, region.volume};
            if (change.exceeds(bench_.bounds_at(c.tet(region.tets.front()).v))) continue;
            bench_.commit(relabelling(region), change);
            ++shifted;
        } else {
            events.push_back(commit(region, step));
            ++committed;
        }
        for (const TetId t : region.tets)
            touched_.insert(touched_.end(), c.tet(t).v.begin(), c.tet(t).v.end());
    }
    if (!touched_.empty()) remove_small_components(step, touched_, limits.min_component, events);
}

// The component of the seed if it is small, has one label around it and is bounded by one surface.
bool TopologyStage::flood_component(TetId seed, double volume_limit, Region& region) {
    const mesh::Complex& c = bench_.complex;
    region.tets.assign(1, seed);
    region.from = region.to = c.label(seed);
    double volume = 0.0;
    for (std::size_t i = 0; i < region.tets.size(); ++i) {
        const TetId t = region.tets[i];
        volume += c.volume(t);
        if (volume >= volume_limit || region.tets.size() > small_component || touches_box(c, t))
            return false;
        for (unsigned f = 0; f < 4; ++f) {
            const TetId next = mesh::neighbour_tet(c.across(t, f));
            if (c.label(next) != region.from) {
                if (region.to != region.from && region.to != c.label(next)) return false;
                region.to = c.label(next);
            } else if (std::find(region.tets.begin(), region.tets.end(), next) ==
                       region.tets.end()) {
                region.tets.push_back(next);
            }
        }
    }
    return region.to != region.from;
}

void TopologyStage::remove_small_components(std::uint64_t step, std::span<const VertexId> near,
                                            double min_component, std::vector<Event>& events) {
    if (!(min_component > 0.0)) return;
    const mesh::Complex& c = bench_.complex;
    Region& region = region_;
    std::vector<TetId>& seeds = component_seeds_;
    for (const VertexId v : near) {
        if (v >= c.vertex_slots() || !c.vertex_alive(v) || !c.on_interface(v)) continue;
        const double limit = min_component * geometry::regular_tet_volume(bench_.length_at(v));
        // One seed per label: the star of a regular vertex has one group per label.
        seeds.clear();
        for (const TetId t : c.cached_star(v, walk_).tets) {
            const bool known = std::any_of(seeds.begin(), seeds.end(),
                                           [&](TetId s) { return c.label(s) == c.label(t); });
            if (!known) seeds.push_back(t);
        }
        for (const TetId seed : seeds) {
            if (!flood_component(seed, limit, region)) continue;
            // A ball vanishes as one event; a component with handles or cavities stays until it has
            // become a ball.
            if (measure(bench_, region) != RegionFault::none || region.patches_from != 0 ||
                region.patches_to != 1)
                continue;
            events.push_back(commit(region, step));
            break;
        }
    }
}

void TopologyStage::save(StateWriter& out) const {
    out.list(event_step_);
    out.list(event_birth_);
    out.list(event_to_);
}

void TopologyStage::load(StateReader& in) {
    in.list(event_step_);
    in.list(event_birth_);
    in.list(event_to_);
    last_event_ = 0;
    for (const std::uint64_t event : event_step_) last_event_ = std::max(last_event_, event);
}

}  // namespace dsc::kernel
