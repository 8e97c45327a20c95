// Collects the faults of a configuration and formats them as text.
#include "dsc/config/diagnostics.hpp"

#include <algorithm>
#include <tuple>

#include <fmt/core.h>

#include <dsc/base/error.hpp>
#include <dsc/text/utf8.hpp>
#include <dsc/text/words.hpp>

namespace dsc::config {
namespace {

/// The part of a line around a column, for lines that are too long for a terminal.
struct Excerpt {
    std::string text;
    std::size_t column = 0;  ///< 0-based, in characters of `text`
};

/// Byte offset of the character with this index; the size of the text after its end.
std::size_t byte_offset(std::string_view text, std::size_t character) {
    std::size_t offset = 0;
    for (std::size_t seen = 0; offset < text.size(); ++offset) {
        const bool starts = (static_cast<unsigned char>(text[offset]) & 0xc0U) != 0x80U;
        if (starts && seen++ == character) break;
    }
    return offset;
}

Excerpt excerpt(std::string_view line, std::size_t column) {
    constexpr std::size_t widest = 120;
    constexpr std::size_t before = 60;
    const std::string shown = text::printable(line);
    if (text::character_count(shown) <= widest) return {shown, column};
    const std::size_t first = column > before ? column - before : 0;
    const std::size_t begin = byte_offset(shown, first);
    const std::size_t end = byte_offset(shown, first + widest);
    const std::string lead = first > 0 ? "..." : "";
    const std::string tail = end < shown.size() ? "..." : "";
    return {lead + shown.substr(begin, end - begin) + tail, column - first + lead.size()};
}

std::string gutter(const std::string& number) {
    constexpr std::size_t width = 5;
    return std::string(number.size() < width ? width - number.size() : 0, ' ') + number + " | ";
}

std::string caret_lines(const SourcePosition& position, const std::string& hint) {
    const std::string_view line = position.source->line(position.line);
    const std::size_t column =
        position.column > 0 ? static_cast<std::size_t>(position.column) - 1 : 0;
    const Excerpt part = excerpt(line, column);
    const std::size_t width = text::character_count(part.text);
    const std::size_t room = width > part.column ? width - part.column : 1;
    const std::size_t length =
        std::clamp<std::size_t>(static_cast<std::size_t>(std::max(position.length, 1)), 1, room);
    std::string out = gutter(std::to_string(position.line)) + part.text + "\n";
    out += gutter("") + std::string(part.column, ' ') + "^" + std::string(length - 1, '~');
    if (!hint.empty()) out += "  " + hint;
    return out + "\n";
}

/// Order: files by their first fault, then by line and column; faults of the command line keep
/// their order.
std::vector<std::size_t> sorted(const std::vector<Diagnostic>& all, Severity severity) {
    std::vector<const SourceText*> sources;
    const auto rank = [&](const Diagnostic& d) {
        const auto found = std::find(sources.begin(), sources.end(), d.position.source.get());
        return found - sources.begin();
    };
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < all.size(); ++i) {
        if (all[i].severity != severity) continue;
        order.push_back(i);
        if (rank(all[i]) == static_cast<std::ptrdiff_t>(sources.size())) {
            sources.push_back(all[i].position.source.get());
        }
    }
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        const auto key = [&](const Diagnostic& d) {
            return std::make_tuple(rank(d), d.position.line, d.position.column);
        };
        return key(all[a]) < key(all[b]);
    });
    return order;
}

}  // namespace

std::string format(const Diagnostic& diagnostic) {
    const char* severity = diagnostic.severity == Severity::error ? ": error: " : ": warning: ";
    std::string out = diagnostic.position.describe() + severity + diagnostic.message + "\n";
    const SourcePosition& position = diagnostic.position;
    const bool has_line = position.known() && !position.from_command_line() && position.line > 0;
    if (has_line) {
        out += caret_lines(position, diagnostic.hint);
    } else if (!diagnostic.hint.empty()) {
        out += "      note: " + diagnostic.hint + "\n";
    }
    for (const std::string& note : diagnostic.notes) out += "      note: " + note + "\n";
    return out;
}

void Diagnostics::error(std::string code, SourcePosition position, std::string message,
                        std::string hint, std::vector<std::string> notes) {
    ++errors_;
    all_.push_back({Severity::error, std::move(code), std::move(position), std::move(message),
                    std::move(hint), std::move(notes)});
}

void Diagnostics::warning(std::string code, SourcePosition position, std::string message,
                          std::string hint, std::vector<std::string> notes) {
    all_.push_back({Severity::warning, std::move(code), std::move(position), std::move(message),
                    std::move(hint), std::move(notes)});
}

std::string Diagnostics::text(Severity severity) const {
    constexpr std::size_t most_shown = 100;
    const std::vector<std::size_t> order = sorted(all_, severity);
    std::string out;
    for (std::size_t i = 0; i < order.size() && i < most_shown; ++i) out += format(all_[order[i]]);
    if (order.size() > most_shown)
        out += fmt::format("... and {} more\n", order.size() - most_shown);
    return out;
}

void Diagnostics::throw_if_errors() const {
    if (errors_ == 0) return;
    std::string code = "config.invalid";
    if (errors_ == 1) {
        const auto only = std::find_if(all_.begin(), all_.end(), [](const Diagnostic& d) {
            return d.severity == Severity::error;
        });
        code = only->code;
    }
    throw ConfigError(
        code, text(Severity::error) + text::counted(errors_, "error") + "; nothing was run");
}

void fail(std::string code, SourcePosition position, std::string message, std::string hint,
          std::vector<std::string> notes) {
    Diagnostics diagnostics;
    diagnostics.error(code, std::move(position), std::move(message), std::move(hint),
                      std::move(notes));
    diagnostics.throw_if_errors();
    throw ConfigError(code, message);  // not reached: one error was just added
}

}  // namespace dsc::config
