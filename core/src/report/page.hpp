#pragma once
// The frame of a page: share/report/page.html with style and scripts.

#include <functional>
#include <string>

namespace dsc::report {

/// The two kinds of pages: a comparison is wider and has a script of its own.
enum class PageKind { run, comparison };

/// `title` is text; `subtitle` and `body` are HTML.
std::string report_page(PageKind kind, const std::string& title, const std::string& subtitle,
                        const std::string& body);

/// Runs `make`. Exceptions of the JSON library, which mean that a file has unexpected values,
/// become IoError "report.damaged".
std::string guarded_report(const std::function<std::string()>& make);

}  // namespace dsc::report
