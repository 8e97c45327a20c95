#pragma once
// The experiments under configs/reconstruct, part of the library.

#include <dsc/base/embedded_file.hpp>
#include <span>

namespace dsc::run {

/// All of them. The build writes its source.
std::span<const EmbeddedFile> reconstruct_files();

}  // namespace dsc::run
