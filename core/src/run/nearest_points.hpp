#pragma once
// The nearest cloud point of each vertex of a view. Vertices that have not moved since the last
// view keep their points.

#include <cstdint>
#include <span>
#include <vector>

#include <dsc/base/workers.hpp>
#include <dsc/cloud/search.hpp>
#include <dsc/surface/surface_view.hpp>

namespace dsc::run {

/// Belongs to one cloud and one complex, whose vertices keep their birth ids.
class NearestPoints {
public:
    /// Finds the points nearest to the vertices of this view. [step]
    void refresh(const surface::SurfaceView& view, const cloud::NearestSearch& search,
                 Workers* workers);
    /// One per vertex of the last view; empty before.
    std::span<const cloud::Neighbour> all() const { return found_; }

private:
    // Belongs to the last view.
    std::vector<std::uint32_t> births_;
    std::vector<Vec3> positions_;
    std::vector<cloud::Neighbour> found_;

    std::vector<cloud::Neighbour> before_;
    std::vector<std::uint32_t> moved_;  // view vertices to search for
};

}  // namespace dsc::run
