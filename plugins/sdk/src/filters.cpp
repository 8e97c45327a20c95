#include "dsc/sdk/filters.hpp"

#include <dsc/host/host.hpp>

namespace dsc::sdk {

cloud::Filtered filtered(const std::string& library, const std::string& id,
                         const cloud::Cloud& cloud, const config::ConfigNode& params) {
    host::Host host;
    host.load(library);
    return host.create<hooks::CloudFilter>({id, params}, "input.cloud.filters.0")->apply(cloud, {});
}

cloud::Cloud square_grid(int side) {
    cloud::Cloud cloud;
    for (int j = 0; j < side; ++j) {
        for (int i = 0; i < side; ++i) {
            cloud.confidence.push_back(0.001 * static_cast<double>(cloud.points.size()));
            cloud.points.emplace_back(i, j, 0);
        }
    }
    return cloud;
}

}  // namespace dsc::sdk
