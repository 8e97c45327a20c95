#pragma once
// Selects the repairs of a round: the quality-driven pipeline of the deformable simplicial complex
// [Misztal2012].

#include <cstdint>
#include <vector>

#include <dsc/base/large_vector.hpp>
#include <dsc/base/workers.hpp>
#include <dsc/repair/contract.hpp>

#include "shapes.hpp"

namespace dsc::improvement {

/// Thresholds of the pipeline; the strategy's parameters of the same names. Lengths are in target
/// lengths L, volumes in regular tets of edge L, qualities are volume-length measures.
struct Thresholds : ShapeLimits {
    double min_tet_quality = 0.2;
    double degenerate_tet_quality = 0.03;
    double smooth_below = 0.5;
    double min_edge_length = 0.5;
    double max_edge_length = 2.0;
    double min_tet_volume = 0.2;
    double max_free_edge = 0.0;  ///< of edges from the interface into a phase; 0: no limit
};

/// Writes the requests of a round. It keeps only scratch memory: the result depends on the round
/// alone.
class Proposals {
public:
    explicit Proposals(const Thresholds& thresholds) : limits_(thresholds), shapes_(thresholds) {}
    /// `workers` (null for one thread) examine the dirty tets together.
    void write(const repair::RepairRound& round, Workers* workers,
               std::vector<repair::Request>& out);

private:
    struct Entry {
        std::int64_t key;
        mesh::TetId tet;
        std::uint32_t order;  // of discovery
    };
    struct EdgeEntry {
        std::uint32_t low, high;  // births
        mesh::VertexId a, b;
        mesh::TetId tet;
        std::int64_t key;
        std::uint32_t order;  // of discovery
    };
    // The findings of look(); to_smooth << k means vertex k of the tet.
    static constexpr std::uint8_t small_volume = 1, interface_edges = 2, free_edges = 4,
                                  low_quality = 8, to_smooth = 16;
    static constexpr std::size_t look_block = 2048;    // tets
    static constexpr std::size_t looked_blocks = 128;  // before their findings are joined

    // A free vertex and the first dirty tet that asks for its smoothing.
    struct FreeEntry {
        mesh::VertexId vertex;
        mesh::TetId tet;
        std::uint32_t place;  // of the tet in the list of dirty tets
    };
    // What is found in some of the dirty tets, in their order.
    struct Findings {
        std::vector<Entry> low, small;
        std::vector<EdgeEntry> short_edges, long_edges, free_edges;
        LargeVector<FreeEntry> free;
        std::size_t free_before = 0;  // number of free entries of all earlier blocks
        void clear();
    };

    void find(const repair::RepairRound& round, Workers* workers);
    void find_in(const repair::RepairRound& round, std::uint32_t place, Findings& out);
    void find_in_block(const repair::RepairRound& round, std::size_t begin, std::size_t end,
                       Findings& found);
    void join(std::size_t blocks, Workers* workers);
    void sort_out(const repair::RepairRound& round, Workers* workers);
    void make_room(std::vector<repair::Request>& out) const;
    double small_volume_of(const repair::RepairRound& round, mesh::TetId t) const;
    static bool may_thin_out(const repair::RepairRound& round, mesh::TetId t);
    static double free_length(const repair::RepairRound& round, mesh::VertexId a, mesh::VertexId b);
    std::uint8_t look(const repair::RepairRound& round, mesh::TetId t) const;
    void note_edges(const repair::RepairRound& round, mesh::TetId t, Findings& out) const;
    void note_free_edges(const repair::RepairRound& round, mesh::TetId t, Findings& out) const;
    bool come_first(mesh::VertexId v, std::uint32_t place);

    Thresholds limits_;
    ShapeProposals shapes_;
    std::vector<Findings> blocks_;
    Findings all_;
    mesh::EdgeRing ring_;
    // Per vertex: the place of the first dirty tet that asks for its smoothing; none between
    // rounds.
    std::vector<std::uint32_t> first_;
};

}  // namespace dsc::improvement
