// Replaces ${NAME} in strings.
#include "config/variables.hpp"

#include <optional>
#include <string>
#include <vector>

#include <dsc/text/utf8.hpp>
#include <dsc/text/words.hpp>

namespace dsc::config {

std::string expand_variables(std::string_view text, const SourcePosition& position,
                             const Environment& environment, Diagnostics& diagnostics) {
    std::string out;
    for (std::size_t at = 0; at < text.size();) {
        if (text.substr(at, 3) == "$${") {
            out += "${";
            at += 3;
            continue;
        }
        if (text.substr(at, 2) != "${") {
            out += text[at++];
            continue;
        }
        const std::size_t end = text.find('}', at);
        const std::string name(
            text.substr(at + 2, end == std::string_view::npos ? end : end - at - 2));
        if (end == std::string_view::npos || !text::is_identifier(name)) {
            diagnostics.error("config.variable", position,
                              "'${' does not start the name of a variable",
                              "write ${NAME}, or $${ for a literal '${'");
            return std::string(text);
        }
        const std::optional<std::string> value = environment(name);
        if (!value) {
            std::vector<std::string> notes;
            if (name == "DSC_DATA") {
                notes = {"DSC_DATA is the folder with the thesis' clouds bunny.obj, teapot.obj and "
                         "cow.obj",
                         "they are public models: the Stanford bunny "
                         "(graphics.stanford.edu/data/3Dscanrep), the teapot and the cow (the "
                         "common OBJ test models)"};
            }
            diagnostics.error("config.variable", position,
                              "the environment variable '" + name + "' is not set",
                              "set it: export " + name + "=...", std::move(notes));
        } else if (text::first_non_text(*value)) {
            diagnostics.error(
                "config.variable", position,
                "the environment variable '" + name + "' contains bytes that are not text");
        } else {
            out += *value;
        }
        at = end + 1;
    }
    return out;
}

bool holds_variable(const SourcePosition& position) {
    if (!position.known() || position.line < 1) return false;
    std::string_view rest = position.source->line(position.line);
    const auto bytes_of = [&](int characters) {
        std::size_t at = 0;
        for (; characters > 0 && at < rest.size(); --characters) {
            for (++at; at < rest.size() && (static_cast<unsigned char>(rest[at]) & 0xc0U) == 0x80U;)
                ++at;
        }
        return at;
    };
    rest.remove_prefix(bytes_of(position.column - 1));
    return rest.substr(0, bytes_of(position.length)).find("${") != std::string_view::npos;
}

}  // namespace dsc::config
