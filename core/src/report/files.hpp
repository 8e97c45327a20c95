#pragma once
// The files of share/report and of three.js, compiled into the library.

#include <span>

#include <dsc/base/embedded_file.hpp>

namespace dsc::report {

/// All of these files. The build generates the source.
std::span<const EmbeddedFile> report_files();

}  // namespace dsc::report
