#pragma once
// An array of numbers that belongs to a mesh; readers return it and writers accept it.

#include <string>
#include <vector>

namespace dsc::io {

/// An additional array: one number per tet or face (cells) or per point (points).
struct DataArray {
    std::string name;
    std::vector<double> values;
};

}  // namespace dsc::io
