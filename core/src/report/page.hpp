#pragma once
// The frame of a page: share/report/page.html with style and scripts.

#include <functional>
#include <string>

namespace dsc::report {

/// `title` is text; `subtitle` and `body` are HTML.
std::string report_page(const std::string& title, const std::string& subtitle,
                        const std::string& body);

/// Runs `make`. Exceptions of the JSON library, which mean that a file has unexpected values,
/// become IoError "report.damaged".
std::string guarded_report(const std::function<std::string()>& make);

}  // namespace dsc::report
