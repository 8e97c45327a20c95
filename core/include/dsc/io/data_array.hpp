#pragma once
// An array of numbers beside a mesh, as readers give it and writers take it.

#include <string>
#include <vector>

namespace dsc::io {

/// A further array: one number per tet or face (cells) or per point (points).
struct DataArray {
    std::string name;
    std::vector<double> values;
};

}  // namespace dsc::io
