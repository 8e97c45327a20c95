#pragma once
// Tests whether a vertex may move to a place. The test computes the qualities of its tets there,
// and it ends at the first tet that the caller refuses (method.md, sections 4.2 and 5.2).

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include <dsc/geometry/tet_pair.hpp>
#include <dsc/mesh/complex.hpp>
#include <dsc/mesh/star_quality.hpp>

namespace dsc::mesh {

/// The tets round a vertex with copies of their corners. Two tets lie side by side, so that the
/// processor computes two qualities at a time. Reuse one object: it keeps its memory.
class StarCopy {
public:
    /// Copies the corners of the tets but v, which has no place before move(). [parallel]
    void gather(const Complex& complex, std::span<const TetId> star, VertexId v);
    /// Places the vertex.
    void move(const Vec3& place);
    /// Calls accept(i, quality) for the i-th tet of the star, in their order, until it returns
    /// false; returns whether all were accepted. The qualities have the bits of quality_of().
    template <class Accept>
    bool qualities(const Accept& accept) {
        return each_quality(count_, accept, [this](std::size_t i) -> const Corners& {
            return pairs_[i / 2].corners;
        });
    }
    /// The same without a copy, for a single place.
    template <class Accept>
    bool qualities_at(const Complex& complex, std::span<const TetId> star, VertexId v,
                      const Vec3& place, const Accept& accept) {
        return each_quality(star.size(), accept, [&](std::size_t i) {
            const auto p = corners_at(complex, star[i], v, place);
            const auto q = corners_at(complex, star[std::min(i + 1, star.size() - 1)], v, place);
            using geometry::side_by_side;
            return Corners{side_by_side(*p[0], *q[0]), side_by_side(*p[1], *q[1]),
                           side_by_side(*p[2], *q[2]), side_by_side(*p[3], *q[3])};
        });
    }
    /// The least mean squared edge of the tets, after qualities() has returned true.
    double least_mean_square() const { return least_square_; }

private:
    using Corners = std::array<geometry::TwoVec3, 4>;
    struct Pair {
        Corners corners;
        std::array<std::uint32_t, 2> own;  // which corner is the vertex
    };

    // `corners(i)` are those of tets i and i + 1.
    template <class Accept, class CornersOf>
    bool each_quality(std::size_t count, const Accept& accept, const CornersOf& corners) {
        geometry::Two least = geometry::Two::Constant(std::numeric_limits<double>::infinity());
        for (std::size_t i = 0; i < count; i += 2) {
            const auto [q, mean_square] = geometry::tet_shapes(corners(i));
            least = least.min(mean_square);
            if (!accept(i, q[0]) || (i + 1 < count && !accept(i + 1, q[1]))) return false;
        }
        least_square_ = least.minCoeff();
        return true;
    }

    std::vector<Pair> pairs_;
    std::size_t count_ = 0;  // of the tets
    double least_square_ = 0.0;
};

/// Places for one vertex, while its star does not change.
class StarTrial {
public:
    /// `copy` belongs to the trial as long as it lasts.
    StarTrial(const Complex& complex, std::span<const TetId> star, VertexId v, StarCopy& copy)
        : complex_(complex), star_(star), v_(v), copy_(copy) {}

    /// Gives the number of a tet that is likely to refuse, to be asked early at the first place.
    void suspect_too(std::size_t i) { suspect_ = i; }

    /// Whether accept(i, quality) is true for all tets with the vertex at `place`; i is the tet's
    /// number in the star. The tet that refused this vertex last time is asked first; often it
    /// refuses again. accept() is called for all tets in the order of the star if all are accepted.
    /// [parallel] if no two threads try the same vertex.
    template <class Accept>
    bool accepts(const Vec3& place, const Accept& accept) {
        const std::size_t suspect = complex_.suspect(v_);
        if (suspect < star_.size() && !accept(suspect, quality_of_tet(suspect, place)))
            return false;
        const auto keep = [&](std::size_t i, double q) {
            if (accept(i, static_cast<float>(q))) return true;
            complex_.keep_suspect(v_, i);
            return false;
        };
        if (++places_ == 1) {
            if (suspect_ < star_.size() && suspect_ != suspect &&
                !keep(suspect_, quality_of_tet(suspect_, place)))
                return false;
            // A copy does not pay for a single place.
            return copy_.qualities_at(complex_, star_, v_, place, keep);
        }
        if (places_ == 2) copy_.gather(complex_, star_, v_);
        copy_.move(place);
        return copy_.qualities(keep);
    }

    /// Whether all tets are exactly positive at the place that was accepted last. `qualities` are
    /// those of the tets. As with exactly_positive(), the quality nearly always decides.
    bool positive(const Vec3& place, std::span<const float> qualities) const {
        if (copy_.least_mean_square() > no_underflow &&
            std::all_of(qualities.begin(), qualities.end(),
                        [](float q) { return q > clear_quality; }))
            return true;
        return std::all_of(star_.begin(), star_.end(), [&](TetId t) {
            return exactly_positive(corners_at(complex_, t, v_, place));
        });
    }

private:
    float quality_of_tet(std::size_t i, const Vec3& place) const {
        return static_cast<float>(quality_of(corners_at(complex_, star_[i], v_, place)));
    }

    const Complex& complex_;
    std::span<const TetId> star_;
    VertexId v_;
    StarCopy& copy_;
    std::size_t suspect_ = none;
    unsigned places_ = 0;  // that passed the first test
};

}  // namespace dsc::mesh
