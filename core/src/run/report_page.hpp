#pragma once
// The frame of a page: share/report/page.html with style and scripts in it.

#include <functional>
#include <string>

namespace dsc::run {

/// `title` is text; `subtitle` and `body` are HTML.
std::string report_page(const std::string& title, const std::string& subtitle, const std::string& body);

/// Runs it; what the JSON library throws at a file whose values are not what a run writes becomes IoError "report.damaged".
std::string guarded_report(const std::function<std::string()>& make);

}  // namespace dsc::run
