#pragma once
// Nearest-point search in a fixed set of points, exact in double precision.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <dsc/base/workers.hpp>
#include <dsc/geometry/vec.hpp>

namespace dsc::cloud {

struct Neighbour {
    std::uint32_t index = 0;
    double distance = 0.0;
};

/// A kd-tree. Distances are sqrt(dx*dx + dy*dy + dz*dz) in double. Points are ordered by the
/// squares; of equal ones the lowest index comes first. Queries must be finite. All const methods
/// may be called from several threads at once.
class NearestSearch {
public:
    /// Copies the points. Throws GeometryError "cloud.empty" without points, "cloud.non_finite".
    /// [setup]
    explicit NearestSearch(std::span<const Vec3> points);
    ~NearestSearch();
    NearestSearch(NearestSearch&&) noexcept;
    NearestSearch& operator=(NearestSearch&&) noexcept;

    std::span<const Vec3> points() const noexcept;

    /// The point nearest to p. [parallel]
    Neighbour nearest(const Vec3& p) const;

    /// The k nearest points (all, if there are fewer), by distance then index, into `out`.
    /// [parallel]
    void k_nearest(const Vec3& p, std::size_t k, std::vector<Neighbour>& out) const;

    /// All points at most `radius` away, by distance then index, into `out`. [parallel]
    void neighbours_within(const Vec3& p, double radius, std::vector<Neighbour>& out) const;

    /// Whether a point is at most `radius` away. [parallel]
    bool within(const Vec3& p, double radius) const;

private:
    struct Tree;
    std::unique_ptr<Tree> tree_;
};

/// Per point of the search: the distance to the nearest other point; 0 for a point that is the only
/// one. [setup]
std::vector<double> distances_to_nearest(const NearestSearch& search, Workers* workers);

}  // namespace dsc::cloud
