// Texts and places of configuration values.
#include "dsc/config/source.hpp"

#include <fmt/core.h>

#include <dsc/text/utf8.hpp>
#include <dsc/text/words.hpp>

namespace dsc::config {

std::string_view SourceText::line(int number) const {
    std::string_view rest = text;
    for (int i = 1; i < number; ++i) {
        const std::size_t end = rest.find('\n');
        if (end == std::string_view::npos) return {};
        rest.remove_prefix(end + 1);
    }
    std::string_view line = rest.substr(0, rest.find('\n'));
    if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    return line;
}

bool SourcePosition::from_command_line() const noexcept {
    return known() && source->kind == SourceText::Kind::command_line;
}

std::string SourcePosition::describe() const {
    if (!known()) return "built in";
    if (from_command_line()) return "command line: " + text::in_quotes(source->text);
    std::string place = text::printable(source->name);
    if (line > 0) place += fmt::format(":{}:{}", line, column);
    return place;
}

}  // namespace dsc::config
