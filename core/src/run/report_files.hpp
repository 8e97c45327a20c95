#pragma once
// The files of share/report and of three.js, part of the library: an installation may be moved anywhere.

#include <span>
#include <string_view>

namespace dsc::run {

struct ReportFile {
    std::string_view path;  ///< "viewer.js"
    std::string_view text;
};

/// All of them. The build writes its source.
std::span<const ReportFile> report_files();

}  // namespace dsc::run
