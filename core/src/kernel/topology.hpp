#pragma once
// The topology stage: changes the topology of the interface by relabelling balls of tets
// (method.md, section 8).

#include <functional>
#include <span>
#include <vector>

#include <dsc/base/workers.hpp>
#include <dsc/kernel/step_report.hpp>
#include <dsc/repair/contract.hpp>

#include "kernel/region.hpp"

namespace dsc::kernel {

class TopologyStage {
public:
    explicit TopologyStage(Workbench& bench) : bench_(bench) {}

    using Select =
        std::function<void(std::span<const repair::TopologyCandidate>, std::span<std::uint8_t>)>;

    /// Finds candidates at the edges and faces of the changed tets, lets `select` choose, and
    /// commits the accepted ones one by one. `workers`, null for one thread, share the search.
    void run(std::uint64_t step, std::span<const TetId> changed,
             const repair::TopologyLimits& limits, const Select& select, std::vector<Event>& events,
             Workers* workers = nullptr);

    /// Components near the given vertices that are smaller than `min_component` regular tets take
    /// the label around them.
    void remove_small_components(std::uint64_t step, std::span<const VertexId> near,
                                 double min_component, std::vector<Event>& events);

    /// The target length at a region.
    double length_at(const Region& region) const;
    /// Relabels the region and returns the event; the kind must be (1,2), (2,1), (0,1) or (1,0)
    /// (method.md, section 8.3).
    Event commit(const Region& region, std::uint64_t step);

    /// Saves which vertices rest, and since which event. [step]
    void save(StateWriter& out) const;
    void load(StateReader& in);

private:
    // Start of a region: an edge inside a phase with its ends on the interface; or a face inside a
    // phase whose three edges all lie on the interface, the cross-section of a neck that is too
    // thin to have an edge inside.
    struct Seed {
        std::array<std::uint32_t, 3> births;  // ascending; the last is none for an edge
        std::array<VertexId, 3> v;
    };
    struct Found {
        Seed seed;
        repair::TopologyCandidate candidate;
    };
    // The seeds found in a block of the changed tets.
    struct SeedBlock {
        std::vector<Seed> seeds;
        mesh::EdgeRing ring;
    };
    void collect_seeds(std::uint64_t step, std::span<const TetId> changed, Workers* workers);
    void collect_seeds_of(TetId t, std::uint64_t step, SeedBlock& block) const;
    void add_seed(std::array<VertexId, 3> v, SeedBlock& block) const;
    bool interface_edge(TetId t, VertexId a, VertexId b, mesh::EdgeRing& ring) const;
    bool neck_face(TetId t, unsigned face, mesh::EdgeRing& ring) const;
    RegionFault start(const Seed& seed, Region& region);
    RegionFault region_of(const Seed& seed, Region& region);
    bool usable(const Seed& seed, mesh::Label from, std::uint64_t step) const;
    bool same_shell(std::span<const VertexId> from, std::span<const VertexId> to);
    void mark_event(const Region& region, std::uint64_t step);
    /// Whether an event at v gave tets the label `from` within the last steps, so that taking them
    /// again would undo it.
    bool recent(VertexId v, mesh::Label from, std::uint64_t step) const;
    bool flood_component(TetId seed, double volume_limit, Region& region);

    Workbench& bench_;
    std::vector<SeedBlock> seed_blocks_;
    std::vector<Seed> seeds_;
    std::vector<Found> found_;
    std::vector<std::uint64_t> event_step_;  // per vertex: 1 + step of the last event that touched
                                             // it
    std::vector<std::uint32_t> event_birth_;
    std::vector<mesh::Label> event_to_;  // the label that the event gave
    std::uint64_t last_event_ = 0;       // the largest of event_step_
    std::vector<std::uint32_t> seen_;
    std::uint32_t seen_epoch_ = 0;
    std::vector<VertexId> queue_;
    mesh::EdgeRing ring_;
    mesh::StarWalk walk_;
    std::vector<VertexId> touched_;
    std::vector<TetId> component_seeds_;
    std::vector<repair::TopologyCandidate> batch_;
    std::vector<std::uint8_t> accept_;
    std::vector<const Found*> order_;
    Region region_;
};

}  // namespace dsc::kernel
