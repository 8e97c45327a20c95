// The cloud as strategies see it; the distances to the sixth neighbours are computed on demand.
#include "dsc/cloud/target.hpp"

#include <mutex>
#include <vector>

namespace dsc::cloud {

struct TargetCloud::Distances {
    std::once_flag once;
    std::vector<double> values;
};

struct TargetCloud::Measured {
    std::once_flag once;
    Statistics statistics;
};

namespace {

template <class T>
std::vector<T> one_per_point(const std::vector<T>& values, const Normalized& normalized) {
    return values.size() == normalized.points.size() ? values : std::vector<T>();
}

constexpr std::size_t wanted = 6;
constexpr std::size_t searched = 16, searched_again = 128;  // more if many points coincide

// The neighbour distance: to the sixth neighbour (to the last one if there are fewer), and the
// number of neighbours. Coinciding points count once, and points that coincide with p do not count.
// Equal points have equal distances, so only those are compared.
std::pair<double, std::size_t> sixth_neighbour_distance(std::span<const Vec3> points,
                                                        std::span<const Neighbour> around) {
    double last = 0.0;
    std::size_t distinct = 0;
    for (std::size_t i = 0; i < around.size() && distinct < wanted; ++i) {
        if (!(around[i].distance > 0.0)) continue;
        bool again = false;
        for (std::size_t j = i; j > 0 && around[j - 1].distance == around[i].distance && !again;
             --j) {
            again = points[around[j - 1].index] == points[around[i].index];
        }
        if (again) continue;
        last = around[i].distance;
        ++distinct;
    }
    return {last, distinct};
}

}  // namespace

TargetCloud::TargetCloud(const Normalized& normalized)
    : search_(std::make_shared<const NearestSearch>(normalized.points)),
      distances_(std::make_shared<Distances>()),
      transform_(normalized.transform),
      box_(bounding_box(search_->points())),
      attributes_(attributes_of(normalized)),
      measured_(std::make_shared<Measured>()) {}

std::shared_ptr<const TargetCloud::Attributes> TargetCloud::attributes_of(
    const Normalized& normalized) {
    return std::make_shared<const Attributes>(Attributes{
        one_per_point(normalized.colours, normalized),
        one_per_point(normalized.normals, normalized), one_per_point(normalized.areas, normalized),
        one_per_point(normalized.confidence, normalized), normalized.orientation});
}

const Statistics& TargetCloud::statistics(Workers* workers) const {
    std::call_once(measured_->once,
                   [this, workers] { measured_->statistics = measure_cloud(points(), workers); });
    return measured_->statistics;
}

double TargetCloud::neighbour_distance(std::size_t index) const {
    std::call_once(distances_->once, [this] {
        std::vector<Neighbour> around;
        distances_->values.reserve(size());
        for (const Vec3& p : points()) {
            search_->k_nearest(p, searched, around);
            auto [distance, distinct] = sixth_neighbour_distance(points(), around);
            if (distinct < wanted) {
                search_->k_nearest(p, searched_again, around);
                distance = sixth_neighbour_distance(points(), around).first;
            }
            distances_->values.push_back(distance);
        }
    });
    return distances_->values[index];
}

}  // namespace dsc::cloud
