#include "figures_output.hpp"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "standard_streams.hpp"

namespace dsc::app {
namespace {

using nlohmann::ordered_json;
using Lines = std::vector<std::pair<std::string, std::string>>;

void flatten(const ordered_json& value, const std::string& name, Lines& lines) {
    if (!value.is_object()) {
        lines.emplace_back(name, value.is_string()    ? value.get<std::string>()
                                 : value.is_boolean() ? (value.get<bool>() ? "yes" : "no")
                                 : value.is_null()    ? "-"
                                                      : value.dump());
        return;
    }
    for (const auto& [key, item] : value.items())
        flatten(item, name.empty() ? key : name + "." + key, lines);
}

}  // namespace

void print_figures(const ordered_json& figures, bool as_json) {
    if (as_json) {
        data_out() << figures.dump(2, ' ', false, ordered_json::error_handler_t::replace) << "\n";
        return;
    }
    Lines lines;
    flatten(figures, "", lines);
    std::size_t width = 0;
    for (const auto& [name, text] : lines) width = std::max(width, name.size());
    for (const auto& [name, text] : lines)
        data_out() << name << std::string(width + 2 - name.size(), ' ') << text << "\n";
}

ordered_json box_figures(const Box3& box) {
    if (box.empty()) return nullptr;
    return {{"low", {box.low.x(), box.low.y(), box.low.z()}},
            {"high", {box.high.x(), box.high.y(), box.high.z()}},
            {"diagonal", box.diagonal()}};
}

}  // namespace dsc::app
