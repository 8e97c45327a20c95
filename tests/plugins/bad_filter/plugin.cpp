// Witness of cloud.attributes: colours that do not go with their points.
#include <vector>

#include <dsc/cloud/filter.hpp>
#include <dsc/hooks/cloud_filter.hpp>
#include <dsc/plugin/plugin.hpp>

namespace {

class MixesColours final : public dsc::hooks::CloudFilter {
public:
    struct Params {};
    static void declare(dsc::config::ParamSchema<Params>&) {}
    MixesColours(const Params&, const dsc::plugin::Setup&) {}
    dsc::cloud::Filtered apply(const dsc::cloud::Cloud& cloud,
                               const dsc::hooks::FilterContext&) override {
        std::vector<std::size_t> every_second;
        for (std::size_t i = 0; i < cloud.points.size(); i += 2) every_second.push_back(i);
        dsc::cloud::Filtered result{dsc::cloud::pick(cloud, every_second), {}};
        result.cloud.colours.assign(
            cloud.colours.begin(),
            cloud.colours.begin() + static_cast<std::ptrdiff_t>(every_second.size()));
        result.report.kept = every_second.size();
        result.report.removed = cloud.points.size() - every_second.size();
        return result;
    }
};

}  // namespace

DSC_PLUGIN("bad_filter", "1.0.0", "MIT", "Witness of cloud.attributes") {
    registrar.add<MixesColours>("cloud_attributes",
                                "keeps every second point and the colours of the first ones");
}
