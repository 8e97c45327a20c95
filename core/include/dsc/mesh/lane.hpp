#pragma once
// What one thread needs to change a complex while other threads change other parts of it.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <dsc/mesh/tet_index.hpp>
#include <dsc/mesh/tet_mesh.hpp>

namespace dsc::mesh {

/// Tables of link(), replace() and relabel(); nothing is allocated after they have grown.
struct EditTables {
    struct FaceSlot {
        std::array<std::uint32_t, 3> key;
        std::uint32_t code;
        std::uint32_t stamp;
        bool used;
    };
    struct CavityLabels {
        std::uint32_t vertex;
        std::array<std::uint64_t, 2> labels;  // before and after
    };
    TetIndex places;
    std::vector<std::uint32_t> star;
    std::vector<CavityLabels> cavity_labels;
    std::vector<std::uint32_t> relabelled;  // vertices
    std::vector<std::uint32_t> added;       // tets that the last replace() wrote
    std::vector<FaceSlot> faces;
    std::uint32_t face_stamp = 0;
};

/// How many tets and vertices a lane can make.
struct LaneRoom {
    std::size_t tets = 0;
    std::size_t vertices = 0;
};

/// The right to change a part of a complex: a change clock, slots for new tets and vertices, births
/// and lists of changes. A complex has one lane for serial work. Complex::open() makes further ones
/// for work side by side, and Complex::close() takes their results back, one after the other.
///
/// While lanes are open, only they may change the complex, and each vertex belongs to one lane. A
/// lane changes only tets whose four vertices belong to it, so a tet with vertices of two lanes
/// stays as it is. A lane reads positions of its vertices only, and Tet::n only for faces with such
/// a vertex. Slots of vertices that a lane deletes are used again only after it is closed.
class Lane {
public:
    /// The change clock of the lane. Dates of different lanes cannot be compared.
    std::uint32_t clock() const { return clock_; }
    /// Whether link() has refused an edit since the last call because the lane has no slots for it.
    bool take_shortage() { return std::exchange(short_of_slots_, false); }
    /// Slots for the vertices that the lane can still make.
    std::span<const std::uint32_t> free_vertices() const { return free_vertices_; }
    /// Vertices that the lane has made, in this order, also those that it has deleted again.
    std::span<const std::uint32_t> created() const { return created_; }

private:
    friend class Complex;

    bool open_ = false;  // beside other lanes: it makes no slots and defers what concerns them
    bool short_of_slots_ = false;
    std::uint32_t clock_ = 0;
    std::uint32_t next_birth_ = 0;
    std::vector<std::uint32_t> free_vertices_;
    std::vector<std::uint32_t> free_tets_;
    std::vector<std::uint32_t> changes_;
    // Of an open lane only.
    std::vector<std::uint32_t> created_;
    std::vector<std::uint32_t> deleted_;
    std::vector<std::uint32_t> relisted_;  // vertices that may enter or leave the interface's list
    EditTables tables_;
};

}  // namespace dsc::mesh
