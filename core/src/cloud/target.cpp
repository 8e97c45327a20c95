#include <dsc/cloud/target.hpp>

namespace dsc::cloud {

TargetCloud::TargetCloud(const Normalized& normalized)
    : search_(std::make_shared<const NearestSearch>(normalized.points)),
      transform_(normalized.transform),
      box_(bounding_box(search_->points())) {}

}  // namespace dsc::cloud
