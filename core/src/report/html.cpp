// Text for HTML.
#include "html.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/format.h>
#include <openssl/evp.h>

#include <dsc/base/error.hpp>
#include <dsc/text/numbers.hpp>
#include <dsc/text/utf8.hpp>

namespace dsc::report::html {
namespace {

constexpr std::string_view unreadable = "\xEF\xBF\xBD";

void append_escaped(std::string& out, std::string_view character) {
    const char c = character.front();
    if (c == '&') {
        out += "&amp;";
    } else if (c == '<') {
        out += "&lt;";
    } else if (c == '>') {
        out += "&gt;";
    } else if (c == '"') {
        out += "&quot;";
    } else if (c == '\'') {
        out += "&#39;";
    } else if ((static_cast<unsigned char>(c) < 0x20 && c != '\n' && c != '\t') || c == 0x7F) {
        out += unreadable;
    } else {
        out += character;
    }
}

}  // namespace

std::string text(std::string_view raw) {
    std::string out;
    out.reserve(raw.size());
    while (!raw.empty()) {
        const std::size_t length = dsc::text::character_length(raw);
        if (length == 0) {
            out += unreadable;
        } else {
            append_escaped(out, raw.substr(0, length));
        }
        raw.remove_prefix(std::max<std::size_t>(1, length));
    }
    return out;
}

std::string json_in_script(std::string_view json) {
    std::string out;
    out.reserve(json.size());
    for (const char c : json) {
        if (c == '<') {
            out += "\\u003c";  // in JSON this character occurs only in strings
        } else {
            out += c;
        }
    }
    return out;
}

std::string tag(std::string_view name, std::string_view content, std::string_view classes) {
    std::string out = "<" + std::string(name);
    if (!classes.empty()) out += " class=\"" + std::string(classes) + "\"";
    return out + ">" + std::string(content) + "</" + std::string(name) + ">";
}

std::string table(const Row& header, const std::vector<Row>& rows, bool numbers) {
    const auto row = [](const Row& cells, std::string_view cell) {
        std::string out;
        for (const std::string& content : cells) out += tag(cell, text(content));
        return tag("tr", out) + "\n";
    };
    std::string body;
    for (const Row& cells : rows) body += row(cells, "td");
    return tag("div",
               tag("table", tag("thead", row(header, "th")) + tag("tbody", body),
                   numbers ? "numbers" : ""),
               "wide") +
           "\n";
}

std::string facts(const std::vector<std::pair<std::string, std::string>>& rows) {
    std::string body;
    for (const auto& [name, value] : rows)
        body += tag("tr", tag("th", text(name)) + tag("td", text(value))) + "\n";
    return tag("div", tag("table", tag("tbody", body), "facts"), "wide") + "\n";
}

std::string integer(double value) {
    if (!std::isfinite(value)) return "-";
    std::string digits = std::to_string(static_cast<long long>(std::llround(value)));
    const std::size_t first = digits.front() == '-' ? 1 : 0;
    for (std::size_t at = digits.size(); at > first + 3;) digits.insert(at -= 3, ",");
    return digits;
}

std::string real(double value) { return std::isfinite(value) ? dsc::text::rounded(value, 4) : "-"; }

std::string seconds(double value) { return std::isfinite(value) ? real(value) + " s" : "-"; }

std::string base64(std::string_view bytes) {
    constexpr std::size_t block = 3U << 20U;                // OpenSSL counts in int
    std::string out((bytes.size() + 2) / 3 * 4 + 1, '\0');  // and ends its text with a zero
    auto* to = reinterpret_cast<unsigned char*>(out.data());
    for (; !bytes.empty(); bytes.remove_prefix(std::min(block, bytes.size()))) {
        const auto* const from = reinterpret_cast<const unsigned char*>(bytes.data());
        to += EVP_EncodeBlock(to, from, static_cast<int>(std::min(block, bytes.size())));
    }
    out.pop_back();
    return out;
}

std::string fill(std::string_view page,
                 const std::vector<std::pair<std::string, std::string>>& values) {
    std::string out;
    std::set<std::string> used;
    while (true) {
        // The first mark that is one of our names; any other @ is ordinary text.
        std::size_t at = std::string_view::npos;
        const std::pair<std::string, std::string>* next = nullptr;
        for (const auto& value : values) {
            const std::size_t found = page.find("@" + value.first + "@");
            if (found < at) {
                at = found;
                next = &value;
            }
        }
        if (next == nullptr) break;
        out.append(page.substr(0, at)).append(next->second);
        page.remove_prefix(at + next->first.size() + 2);
        used.insert(next->first);
    }
    for (const auto& value : values) {
        if (used.count(value.first) == 0)
            throw Error(ExitCode::internal, "report.template", "page of the report",
                        fmt::format("it does not contain @{}@", value.first),
                        "please report it with the command");
    }
    return out.append(page);
}

}  // namespace dsc::report::html
