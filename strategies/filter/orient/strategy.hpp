#pragma once
// Filter `orient`: gives every point a normal that points out of the solid, an area and a confidence.

#include <dsc/cloud/orientation.hpp>
#include <dsc/hooks/cloud_filter.hpp>
#include <dsc/plugin/plugin.hpp>

namespace dsc::strategies {

/// Source of the normals.
enum class NormalSource { automatic, file, estimate };

/// Whether a cloud that was recorded from one side is closed with a copy of it.
enum class OneSided { automatic, never };

/// cloud::orient_points and cloud::orient_by_normals as a filter of experiments.
class Orient final : public hooks::CloudFilter {
public:
    struct Params {
        NormalSource from = NormalSource::automatic;
        bool all_points = false;
        std::size_t iterations = 40;
        OneSided one_sided = OneSided::automatic;
    };
    static void declare(config::ParamSchema<Params>& schema);

    Orient(const Params& params, const plugin::Setup& setup);

    /// The cloud with normals, areas, confidence and orientation. Throws ConfigError "filter.normals" if the file's
    /// normals are requested and there are none.
    cloud::Filtered apply(const cloud::Cloud& cloud, const hooks::FilterContext& context) override;

private:
    cloud::OrientOptions options() const;
    cloud::Filtered automatic(const cloud::Cloud& cloud, const hooks::FilterContext& context) const;
    cloud::OrientedPoints estimated(const cloud::Cloud& cloud, const hooks::FilterContext& context) const;
    cloud::OrientedPoints from_file(const cloud::Cloud& cloud, const hooks::FilterContext& context) const;

    Params params_;
};

}  // namespace dsc::strategies
