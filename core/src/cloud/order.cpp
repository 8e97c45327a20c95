// An order of points by coordinates and attributes.
#include "order.hpp"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <numeric>

namespace dsc::cloud {

namespace {

// -1, 0 or 1; -0 equals 0.
int by_value(double a, double b) { return a < b ? -1 : (b < a ? 1 : 0); }

// An integer that grows with the number: a total order of all doubles, with -0 before 0.
std::uint64_t rank(double value) {
    constexpr std::uint64_t sign = std::uint64_t{1} << 63U;
    std::uint64_t bits = 0;
    std::memcpy(&bits, &value, sizeof bits);
    return (bits & sign) != 0 ? ~bits : bits | sign;
}

int by_bits(double a, double b) { return rank(a) < rank(b) ? -1 : (rank(b) < rank(a) ? 1 : 0); }

template <class Compare>
int by_coordinates(const Vec3& a, const Vec3& b, Compare compare) {
    for (Eigen::Index k = 0; k < 3; ++k)
        if (const int order = compare(a[k], b[k]); order != 0) return order;
    return 0;
}

class Order {
public:
    explicit Order(const Cloud& cloud) : cloud_(cloud) {}

    bool operator()(std::size_t i, std::size_t j) const {
        if (const int order = by_coordinates(cloud_.points[i], cloud_.points[j], by_value);
            order != 0)
            return order < 0;
        return attributes(i, j) < 0;
    }

private:
    // Compares points with equal coordinates.
    int attributes(std::size_t i, std::size_t j) const {
        if (whole(cloud_.colours) && cloud_.colours[i] != cloud_.colours[j])
            return cloud_.colours[i] < cloud_.colours[j] ? -1 : 1;
        if (const int order = vectors(cloud_.normals, i, j); order != 0) return order;
        if (const int order = vectors(cloud_.areas, i, j); order != 0) return order;
        if (whole(cloud_.confidence)) {
            if (const int order = by_bits(cloud_.confidence[i], cloud_.confidence[j]); order != 0)
                return order;
        }
        return by_coordinates(cloud_.points[i], cloud_.points[j], by_bits);
    }

    int vectors(const std::vector<Vec3>& values, std::size_t i, std::size_t j) const {
        return whole(values) ? by_coordinates(values[i], values[j], by_bits) : 0;
    }

    template <class T>
    bool whole(const std::vector<T>& values) const {
        return values.size() == cloud_.points.size();
    }

    const Cloud& cloud_;
};

}  // namespace

std::vector<std::size_t> lexicographic_order(const Cloud& cloud) {
    std::vector<std::size_t> order(cloud.points.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(), Order(cloud));
    return order;
}

}  // namespace dsc::cloud
