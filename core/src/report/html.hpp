#pragma once
// Text for HTML and SVG. Everything from a run goes through text(), so that no name can become
// markup.

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace dsc::report::html {

/// Escaped for content and for attributes in quotes. Bytes that are not UTF-8, and control
/// characters, become U+FFFD.
std::string text(std::string_view raw);

/// JSON for a <script>: it cannot contain the start of markup.
std::string json_in_script(std::string_view json);

/// `<name>content</name>`; `content` is markup, `classes` plain words.
std::string tag(std::string_view name, std::string_view content, std::string_view classes = {});

/// A table of escaped cells; `numbers`: all columns except the first are aligned to the right.
using Row = std::vector<std::string>;
std::string table(const Row& header, const std::vector<Row>& rows, bool numbers = true);

/// A table of two columns, names and values, without a header.
std::string facts(const std::vector<std::pair<std::string, std::string>>& rows);

/// Numbers for people: "12,345"; other numbers with four digits; "-" for NaN.
std::string integer(double value);
std::string real(double value);
/// "4.8 s", or "-".
std::string seconds(double value);

/// Standard base64.
std::string base64(std::string_view bytes);

/// `page` with every @NAME@ of `values` replaced, in one pass: inserted text is not searched again.
/// Throws Error "report.template" for a name that only the page or only `values` has.
std::string fill(std::string_view page,
                 const std::vector<std::pair<std::string, std::string>>& values);

}  // namespace dsc::report::html
