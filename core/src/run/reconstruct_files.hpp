#pragma once
// The experiments of configs/reconstruct, compiled into the library.

#include <span>

#include <dsc/base/embedded_file.hpp>

namespace dsc::run {

/// All of these files. The build generates the source.
std::span<const EmbeddedFile> reconstruct_files();

}  // namespace dsc::run
