#pragma once
// The cloud as strategies see it: normalised points, a search in them and the way back to the input's units.

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include <dsc/cloud/normalize.hpp>
#include <dsc/cloud/search.hpp>

namespace dsc::cloud {

/// Immutable; copies share the points and the tree. All methods may be called from several threads at once.
class TargetCloud {
public:
    /// Builds the search tree. Colours that are not one a point are left out. Throws as NearestSearch. [setup]
    explicit TargetCloud(const Normalized& normalized);

    /// Normalised points, in the order of the cloud. [parallel]
    std::span<const Vec3> points() const noexcept { return search_->points(); }
    std::size_t size() const noexcept { return points().size(); }
    const Vec3& operator[](std::size_t index) const { return points()[index]; }
    /// Nearest points. [parallel]
    const NearestSearch& search() const noexcept { return *search_; }
    /// Distance from a point to its sixth neighbour (as many as a vertex of a triangulated surface has), points that
    /// coincide counting once: how far apart the points are there. 0 where fewer than two are distinct. The first call
    /// computes all. [parallel]
    double spacing(std::size_t index) const;
    /// From the input's units to normalised ones. [parallel]
    const Transform& transform() const noexcept { return transform_; }
    /// Of the points, in their order; empty where the input has none. [parallel]
    std::span<const Colour> colours() const noexcept { return *colours_; }
    /// Of the normalised points. [parallel]
    const Box3& box() const noexcept { return box_; }

private:
    struct Spacings;
    std::shared_ptr<const NearestSearch> search_;
    std::shared_ptr<Spacings> spacings_;
    Transform transform_;
    Box3 box_;
    std::shared_ptr<const std::vector<Colour>> colours_;
};

}  // namespace dsc::cloud
