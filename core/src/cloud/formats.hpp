#pragma once
// The readers behind read_cloud, one a format. Each throws IoError.

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

#include <dsc/cloud/read.hpp>

namespace dsc::cloud {

/// Where the check of a header ended.
struct FileCheck {
    std::size_t points = 0;  ///< as the header promises and the file's size allows
};

Cloud read_obj(const std::string& file, std::string_view text);
Cloud read_xyz(const std::string& file, std::string_view text);

/// Prove that a file holds all that its header promises, so that PCL may be trusted with it: PCL allocates
/// what a header asks for and its readers do not all notice a missing end.
FileCheck check_pcd(const std::string& file, std::string_view bytes);
FileCheck check_ply(const std::string& file, std::string_view bytes);

/// Read a checked file with PCL. Points with NaN or infinity are left out and counted.
Cloud read_pcd(const std::filesystem::path& path, const FileCheck& check, ReadReport& report);
Cloud read_ply(const std::filesystem::path& path, const FileCheck& check, ReadReport& report);

/// Refuses a file without points.
[[noreturn]] void no_points(const std::string& file, std::string_view remedy);

}  // namespace dsc::cloud
