#pragma once
// The files of share/report and of three.js, compiled into the library.

#include <dsc/base/embedded_file.hpp>
#include <span>

namespace dsc::report {

/// All of these files. The build generates the source.
std::span<const EmbeddedFile> report_files();

}  // namespace dsc::report
