#pragma once
// Tests whether a vertex may move to a place. The test computes the qualities of its tets there,
// and it ends at the first tet that the caller refuses (method.md, sections 4.2 and 5.2).

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

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
        Two least = Two::Constant(std::numeric_limits<double>::infinity());
        for (std::size_t i = 0; i < count_; i += 2) {
            const Two q = quality(pairs_[i / 2], least);
            if (!accept(i, q[0]) || (i + 1 < count_ && !accept(i + 1, q[1]))) return false;
        }
        least_square_ = least.minCoeff();
        return true;
    }
    /// The least mean squared edge of the tets, after qualities() has returned true.
    double least_mean_square() const { return least_square_; }

private:
    using Two = Eigen::Array2d;
    using TwoVectors = std::array<Two, 3>;
    struct Pair {
        std::array<TwoVectors, 4> corners;
        std::array<std::uint32_t, 2> own;  // which corner is the vertex
    };

    static TwoVectors difference(const TwoVectors& to, const TwoVectors& from) {
        return {to[0] - from[0], to[1] - from[1], to[2] - from[2]};
    }
    // The sum has the order of Eigen's sums over a vector of three.
    static Two dot(const TwoVectors& x, const TwoVectors& y) {
        return (x[0] * y[0] + x[1] * y[1]) + x[2] * y[2];
    }
    static TwoVectors cross(const TwoVectors& x, const TwoVectors& y) {
        return {x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]};
    }
    // geometry::tet_quality() of both tets.
    static Two quality(const Pair& pair, Two& least_square) {
        const auto& [a, b, c, d] = pair.corners;
        const TwoVectors ab = difference(b, a), ac = difference(c, a), ad = difference(d, a);
        const TwoVectors bc = difference(c, b), bd = difference(d, b), cd = difference(d, c);
        const Two mean_square =
            (dot(ab, ab) + dot(ac, ac) + dot(ad, ad) + dot(bc, bc) + dot(bd, bd) + dot(cd, cd)) /
            6.0;
        least_square = least_square.min(mean_square);
        const Two value =
            1.4142135623730951 * dot(cross(ab, ac), ad) / (mean_square * mean_square.sqrt());
        return (mean_square > 0.0).select(value, Two::Zero());
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
        // A copy does not pay for a single place.
        if (++places_ == 1) return qualities(place, keep);
        if (places_ == 2) copy_.gather(complex_, star_, v_);
        copy_.move(place);
        if (!copy_.qualities(keep)) return false;
        least_square_ = copy_.least_mean_square();
        return true;
    }

    /// Whether all tets are exactly positive at the place that was accepted last. `qualities` are
    /// those of the tets. As with exactly_positive(), the quality nearly always decides.
    bool positive(const Vec3& place, std::span<const float> qualities) const {
        if (least_square_ > no_underflow && std::all_of(qualities.begin(), qualities.end(),
                                                        [](float q) { return q > clear_quality; }))
            return true;
        return std::all_of(star_.begin(), star_.end(), [&](TetId t) {
            return exactly_positive(corners_at(complex_, t, v_, place));
        });
    }

private:
    geometry::TetShape shape(std::size_t i, const Vec3& place) const {
        const auto p = corners_at(complex_, star_[i], v_, place);
        return geometry::tet_shape(*p[0], *p[1], *p[2], *p[3]);
    }
    float quality_of_tet(std::size_t i, const Vec3& place) const {
        return static_cast<float>(shape(i, place).quality);
    }
    template <class Accept>
    bool qualities(const Vec3& place, const Accept& accept) {
        double least = std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i < star_.size(); ++i) {
            const geometry::TetShape tet = shape(i, place);
            if (!accept(i, tet.quality)) return false;
            least = std::min(least, tet.mean_square);
        }
        least_square_ = least;
        return true;
    }

    const Complex& complex_;
    std::span<const TetId> star_;
    VertexId v_;
    StarCopy& copy_;
    unsigned places_ = 0;        // that passed the first test
    double least_square_ = 0.0;  // of the mean squared edges at the last accepted place
};

}  // namespace dsc::mesh
