#pragma once
// The kernel's local operations, which are private to it. Of all benchmarks only kernel_access.cpp
// includes their headers, so a change inside the kernel ends there.

#include <memory>

#include <dsc/mesh/complex.hpp>
#include <dsc/repair/contract.hpp>

namespace dsc::bench {

/// A complex of its own with the kernel's work space, under the Deformer's default limits.
class Operations {
public:
    /// `length`: L.
    Operations(mesh::Complex complex, double length);
    ~Operations();
    Operations(Operations&&) noexcept;
    Operations& operator=(Operations&&) noexcept;

    mesh::Complex& complex();
    /// Towards a destination as far as the star stays valid; true if it arrived or moved.
    bool move(mesh::VertexId v, const Vec3& destination);
    bool apply(const repair::Request& request);
    /// One face, where a request tries all four of a tet.
    bool remove_face(mesh::TetId t, unsigned face, float accept_above);
    repair::Outcome last() const { return last_; }

private:
    struct State;
    std::unique_ptr<State> state_;
    repair::Outcome last_ = repair::Refusal::stale;
};

}  // namespace dsc::bench
