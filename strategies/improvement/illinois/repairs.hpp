#pragma once
// The requests of a repair round of the Illinois DSC: tets, repairs and their order.

#include <string>
#include <vector>

#include <dsc/repair/contract.hpp>

#include "tet_shape.hpp"

namespace dsc::improvement {

/// The class under which a request is counted: the four classes, then the fall-backs.
enum class RepairClass : std::uint8_t {
    wedge,
    tee,
    cap,
    sliver,
    edge_removal,
    face_removal,
    smoothing,
    collapse,
    spoke
};
/// Names of RepairClass, in its order.
std::vector<std::string> repair_class_names();

/// The thresholds; the strategy's parameters of the same names. An altitude is the least distance
/// of a vertex of a tet from the plane of its other vertices, in min(longest edge, L).
struct RepairLimits : ShapeLimits {
    double flat = 0.05;         ///< altitude below which a tet is repaired by its class
    double flip_below = 0.1;    ///< altitude below which flips and smoothing are tried
    double smooth_below = 0.2;  ///< altitude below which free vertices move to the mean of their
                                ///< neighbours
    double degenerate_tet_quality = 0.05;  ///< a collapse leaves no tet below this quality, or
                                           ///< below the previous lowest quality
    double least_edge = 0.25;    ///< in L: no insertion makes a shorter edge or splits one shorter
                                 ///< than twice this
    double insertions = 0.2;     ///< new vertices per step, as a fraction of the interface vertices
    double longest_spoke = 0.0;  ///< in L, of edges from the interface into a phase; 0: no limit
    bool fallbacks = true;
};

/// Writes the requests of a round. Its memory does not outlive a step.
class Repairs {
public:
    explicit Repairs(const RepairLimits& limits) : limits_(limits) {}
    void write(const repair::RepairRound& round, std::vector<repair::Request>& out);

private:
    struct Entry {
        std::int64_t altitude;  // quantised
        mesh::TetId tet;
        std::uint32_t order;  // of discovery
        bool by_class;        // flat, or stops a vertex
        TetShape shape;
    };
    struct Spoke {
        std::int64_t length;      // quantised, negative
        std::uint32_t low, high;  // births of its ends
        std::array<mesh::VertexId, 3> ends;
    };
    /// Slots seen in this round.
    class Visits {
    public:
        void begin_round() { ++round_; }
        bool first(std::uint32_t slot);

    private:
        std::vector<std::uint32_t> seen_;
        std::uint32_t round_ = 0;
    };

    bool interface_edge(const mesh::Complex& c, mesh::TetId t, mesh::VertexId a, mesh::VertexId b);
    std::array<std::array<mesh::VertexId, 2>, 2> crossing_edges(const mesh::Complex& c,
                                                                const Entry& entry);
    bool inserts_on_interface(const mesh::Complex& c, const Entry& entry);
    void begin_step(const repair::RepairRound& round);
    void count_insertions(const repair::RepairRound& round);
    void collect(const repair::RepairRound& round);
    void note(const repair::RepairRound& round, mesh::TetId t, bool blocking);
    void note_blocking(const repair::RepairRound& round, mesh::VertexId v);

    void note_spokes(const repair::RepairRound& round, mesh::TetId t);

    void split_spokes(std::vector<repair::Request>& out);
    void smooth(const repair::RepairRound& round, std::vector<repair::Request>& out) const;
    void repair_by_class(const repair::RepairRound& round, const Entry& entry,
                         std::vector<repair::Request>& out);
    void flip_or_smooth(const repair::RepairRound& round, const Entry& entry,
                        std::vector<repair::Request>& out) const;
    void collapse(const repair::RepairRound& round, const Entry& entry,
                  std::vector<repair::Request>& out) const;

    RepairLimits limits_;
    std::vector<Entry> queue_;
    std::vector<mesh::VertexId> free_;  // vertices to smooth, and a tet of each
    std::vector<mesh::TetId> free_tets_;
    std::vector<Spoke> spokes_;
    std::vector<mesh::TetId> star_;
    mesh::EdgeRing ring_;
    Visits tets_seen_, vertices_seen_;
    std::vector<std::uint32_t> searched_;  // per vertex slot: change clock of the last search of
                                           // its star; 0: none in this step
    std::size_t insertions_left_ = 0;      // of the step
    std::size_t insertions_open_ = 0;      // the same minus the requests of the round
};

}  // namespace dsc::improvement
