// The table of the backend libdsc_pcl.so.
#include "pcl_backend.hpp"

#include <dsc/base/backend.hpp>

#include "pcl_files.hpp"
#include "pcl_filters.hpp"

extern "C" DSC_BACKEND_EXPORT const void* dsc_backend_pcl() {
    using namespace dsc::cloud;
    static constexpr PclBackend table{read_pcd, read_ply, statistical_inliers, radius_inliers};
    return &table;
}
