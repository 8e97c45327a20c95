#pragma once
// A look at a VTU file before VTK gets it: VTK trusts its block headers and divides by what they say.

#include <string_view>

namespace dsc::io {

/// Throws IoError "io.count" where the file announces more than it can hold, "io.syntax" where the header of
/// a compressed array is not consistent.
void check_vtu(std::string_view content, std::string_view file);

}  // namespace dsc::io
