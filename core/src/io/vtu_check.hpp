#pragma once
// Checks a VTU or VTP file before VTK reads it: VTK trusts the block headers and divides by their
// values.

#include <string>
#include <string_view>

namespace dsc::io {

/// Throws IoError "io.count" if the file announces more than it can contain, "io.syntax" if its
/// version, the format of an array or the header of a compressed array is not supported.
void check_vtu(std::string_view content, std::string_view file);

/// The file with an empty PointData element in each piece that has none. Without it, VTK 9.1 reads
/// through a null pointer when it reports a cell array that it cannot read.
std::string with_point_data(std::string_view content);

}  // namespace dsc::io
