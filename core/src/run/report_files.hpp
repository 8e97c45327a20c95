#pragma once
// The files of share/report and of three.js, part of the library.

#include <dsc/base/embedded_file.hpp>
#include <span>

namespace dsc::run {

/// All of them. The build writes its source.
std::span<const EmbeddedFile> report_files();

}  // namespace dsc::run
