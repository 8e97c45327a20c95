#pragma once
// Reading with PCL; see pcl_backend.hpp.

#include <string>
#include <vector>

#include <dsc/cloud/read.hpp>

namespace dsc::cloud {

Cloud read_pcd(const std::string& file, std::string bytes, ReadReport& report,
               std::vector<std::string>& names);
Cloud read_ply(const std::string& file, std::string bytes, ReadReport& report,
               std::vector<std::string>& names);

}  // namespace dsc::cloud
