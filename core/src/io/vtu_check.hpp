#pragma once
// A look at a VTU or VTP file before VTK gets it: VTK trusts its block headers and divides by what they say.

#include <string>
#include <string_view>

namespace dsc::io {

/// Throws IoError "io.count" where the file announces more than it can hold, "io.syntax" where its version, the
/// format of an array or the header of a compressed array does not fit.
void check_vtu(std::string_view content, std::string_view file);

/// The file with an empty PointData element where a piece has none: VTK 9.1 reads through a null pointer when it
/// reports a cell array that it cannot read and there is no such element.
std::string with_point_data(std::string_view content);

}  // namespace dsc::io
