#pragma once
// The cloud as strategies see it: normalised points, a search in them, and the transform from the
// input's units.

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include <dsc/cloud/normalize.hpp>
#include <dsc/cloud/search.hpp>
#include <dsc/cloud/statistics.hpp>

namespace dsc::cloud {

/// The points and the values measured from them, in normalised units. A target cloud does not
/// change during a run, so pointers to it remain valid. Copies share the points and the tree.
/// Several threads may call all methods at once.
class TargetCloud {
public:
    /// Builds the search tree. Attributes that do not have one entry per point are left out. Throws
    /// as NearestSearch. [setup]
    explicit TargetCloud(const Normalized& normalized);

    /// The points, in the order of the cloud. [P x 3; n] [parallel]
    std::span<const Vec3> points() const noexcept { return search_->points(); }
    /// Number of points, P. [1; -] [parallel]
    std::size_t size() const noexcept { return points().size(); }
    /// One point. [3; n] [parallel]
    const Vec3& operator[](std::size_t index) const { return points()[index]; }
    /// Search for the nearest points of any place (dsc/cloud/search.hpp). [-; -] [parallel]
    const NearestSearch& search() const noexcept { return *search_; }
    /// The neighbour distance: the distance from a point to its sixth neighbour (a vertex of a
    /// triangulated surface has about six). Coinciding points count once. 0 if fewer than two
    /// points are distinct. The first call computes all values. [1; n] [parallel]
    double neighbour_distance(std::size_t index) const;
    /// From the input's units to normalised units. [-; -] [parallel]
    const Transform& transform() const noexcept { return transform_; }
    /// Colours of the points. Empty if the input has none. [P; -] [parallel]
    std::span<const Colour> colours() const noexcept { return attributes_->colours; }
    /// Unit normals out of the solid. Empty if no filter added them. [P x 3; -] [parallel]
    std::span<const Vec3> normals() const noexcept { return attributes_->normals; }
    /// Area vectors: normals, each as long as the area that its point represents. Empty if no
    /// filter added them. [P x 3; n^2] [parallel]
    std::span<const Vec3> areas() const noexcept { return attributes_->areas; }
    /// Confidence of the normals, 0 to 1. Empty if no filter added them. [P; -] [parallel]
    std::span<const double> confidence() const noexcept { return attributes_->confidence; }
    /// Oriented samples that say what is inside. Empty without the filter `orient`. [-; -]
    /// [parallel]
    const Orientation& orientation() const noexcept { return attributes_->orientation; }

    /// Statistics of the points (dsc/cloud/statistics.hpp). The first call computes all of them,
    /// with the given workers; a call from inside a parallel block must not pass workers. The
    /// result does not depend on them. [-; -] [parallel]
    const Statistics& statistics(Workers* workers = nullptr) const;
    /// The spacing: square root of the area per point at a point, from its 12th neighbour.
    /// [1; n] [parallel]
    double point_width(std::size_t index) const { return statistics().point_width[index]; }
    /// The same from the 8th neighbour; see Statistics. [1; n] [parallel]
    double label_width(std::size_t index) const { return statistics().label_width[index]; }
    /// Standard deviation of the points across the surface. [1; n] [parallel]
    double noise() const { return statistics().noise; }

    /// Box of the points. [-; n] [parallel]
    const Box3& box() const noexcept { return box_; }

private:
    struct Distances;
    struct Measured;
    struct Attributes {
        std::vector<Colour> colours;
        std::vector<Vec3> normals;
        std::vector<Vec3> areas;
        std::vector<double> confidence;
        Orientation orientation;
    };
    static std::shared_ptr<const Attributes> attributes_of(const Normalized& normalized);
    std::shared_ptr<const NearestSearch> search_;
    std::shared_ptr<Distances> distances_;
    Transform transform_;
    Box3 box_;
    std::shared_ptr<const Attributes> attributes_;
    std::shared_ptr<Measured> measured_;
};

}  // namespace dsc::cloud
