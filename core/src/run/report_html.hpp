#pragma once
// Text for HTML and SVG: everything that comes from a run goes through text(), so that no name can become markup.

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace dsc::run::html {

/// Escaped for content and for attributes in quotes. Bytes that are no UTF-8 become U+FFFD, control characters too.
std::string text(std::string_view raw);

/// JSON for a <script>: no markup can begin in it.
std::string json_in_script(std::string_view json);

/// `<name>content</name>`; `content` is markup, `classes` plain words.
std::string tag(std::string_view name, std::string_view content, std::string_view classes = {});

/// A table of escaped cells; `numbers`: all columns but the first are aligned to the right.
using Row = std::vector<std::string>;
std::string table(const Row& header, const std::vector<Row>& rows, bool numbers = true);

/// Two columns, names and values, no header.
std::string facts(const std::vector<std::pair<std::string, std::string>>& rows);

/// For people: "12,345", and a number in four digits; "-" for NaN.
std::string integer(double value);
std::string real(double value);

/// Standard base64.
std::string base64(std::string_view bytes);

/// `page` with every @NAME@ of `values` replaced, in one pass: what is put in is never looked at again. Throws Error
/// "report.template" for a name that the page does not have or values do not.
std::string fill(std::string_view page, const std::vector<std::pair<std::string, std::string>>& values);

}  // namespace dsc::run::html
