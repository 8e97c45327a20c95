#pragma once
// The seven kinds of strategies and their names in an experiment.

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <type_traits>

#include <dsc/hooks/cloud_filter.hpp>
#include <dsc/hooks/curvature_estimator.hpp>
#include <dsc/hooks/improvement.hpp>
#include <dsc/hooks/initial_mesh.hpp>
#include <dsc/hooks/observer.hpp>
#include <dsc/hooks/refinement_policy.hpp>
#include <dsc/hooks/velocity_field.hpp>

namespace dsc::plugin {

enum class Kind : std::uint8_t {
    velocity,
    curvature,
    refinement,
    initial_mesh,
    improvement,
    observer,
    filter
};

inline constexpr std::array<Kind, 7> all_kinds = {
    Kind::velocity,    Kind::curvature, Kind::refinement, Kind::initial_mesh,
    Kind::improvement, Kind::observer,  Kind::filter};

/// "velocity", ... [parallel]
std::string_view kind_name(Kind kind) noexcept;
/// Empty for any other word. [parallel]
std::optional<Kind> find_kind(std::string_view name) noexcept;

/// The kind of a hook or of a class derived from one.
template <class T>
constexpr Kind kind_of() {
    constexpr int hooks_of_t =
        std::is_base_of_v<hooks::VelocityField, T> +
        std::is_base_of_v<hooks::CurvatureEstimator, T> +
        std::is_base_of_v<hooks::RefinementPolicy, T> + std::is_base_of_v<hooks::InitialMesh, T> +
        std::is_base_of_v<hooks::Improvement, T> + std::is_base_of_v<hooks::Observer, T> +
        std::is_base_of_v<hooks::CloudFilter, T>;
    static_assert(hooks_of_t == 1,
                  "a strategy derives publicly from exactly one hook of dsc/hooks");
    if (std::is_base_of_v<hooks::VelocityField, T>) return Kind::velocity;
    if (std::is_base_of_v<hooks::CurvatureEstimator, T>) return Kind::curvature;
    if (std::is_base_of_v<hooks::RefinementPolicy, T>) return Kind::refinement;
    if (std::is_base_of_v<hooks::InitialMesh, T>) return Kind::initial_mesh;
    if (std::is_base_of_v<hooks::Improvement, T>) return Kind::improvement;
    if (std::is_base_of_v<hooks::Observer, T>) return Kind::observer;
    return Kind::filter;
}

}  // namespace dsc::plugin
