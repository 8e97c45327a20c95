#pragma once
// Common parts of all filters: check the input, select the points that stay, count the others.

#include <string>
#include <vector>

#include <dsc/cloud/filter.hpp>

namespace dsc::cloud {

/// Box of the cloud; throws if no filter can process the cloud.
Box3 checked_box(const Cloud& cloud, const std::string& filter);

/// Throws GeometryError "cloud.option" with the cause unless `valid`.
void require_option(bool valid, const Cloud& cloud, const std::string& filter,
                    const std::string& cause, std::string_view remedy);

/// The points that stay, with their attributes: by flag in the order of the cloud, or by index in
/// the order of the indices. Throws GeometryError "cloud.filtered_out" if none stays.
Filtered take(const Cloud& cloud, const std::string& filter, const std::vector<bool>& keep);
Filtered take(const Cloud& cloud, const std::string& filter, const std::vector<std::size_t>& kept);

}  // namespace dsc::cloud
