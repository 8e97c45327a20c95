// The virtual tables of the hooks are all in this file, so that a type made by a plugin is the type
// that the host knows.
#include <algorithm>
#include <iterator>

#include <dsc/base/error.hpp>
#include <dsc/hooks/attributes.hpp>
#include <dsc/hooks/cloud_filter.hpp>
#include <dsc/hooks/context.hpp>
#include <dsc/hooks/curvature_estimator.hpp>
#include <dsc/hooks/improvement.hpp>
#include <dsc/hooks/initial_mesh.hpp>
#include <dsc/hooks/observer.hpp>
#include <dsc/hooks/refinement_policy.hpp>
#include <dsc/hooks/velocity_field.hpp>
#include <dsc/text/words.hpp>

namespace dsc::hooks {

bool may_name_attribute(std::string_view name) {
    return text::is_snake_case(name) &&
           std::find(std::begin(reserved_attributes), std::end(reserved_attributes), name) ==
               std::end(reserved_attributes);
}

Strategy::~Strategy() = default;
void Strategy::save(std::ostream&) const {}
void Strategy::load(std::istream&) {}

VelocityField::~VelocityField() = default;
void VelocityField::advance(const StepContext&) {}
void VelocityField::publish(Attributes&) const {}
void VelocityField::sample(std::span<const Vec3>, std::span<const Vec3>, std::span<Vec3>) const {
    throw StrategyError(
        "strategy.no_sampling", "velocity",
        "it has no values at points other than the vertices (can_sample() is false)",
        "use another velocity, or a refinement that does not read it there");
}

CurvatureEstimator::~CurvatureEstimator() = default;
RefinementPolicy::~RefinementPolicy() = default;
InitialMesh::~InitialMesh() = default;
MeshFiles::~MeshFiles() = default;

Improvement::~Improvement() = default;
void Improvement::select(const StepContext&, std::span<const repair::TopologyCandidate>,
                         std::span<std::uint8_t> accept) {
    std::fill(accept.begin(), accept.end(), std::uint8_t{1});
}

Observer::~Observer() = default;
CloudFilter::~CloudFilter() = default;

}  // namespace dsc::hooks
