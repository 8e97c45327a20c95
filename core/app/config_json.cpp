#include "config_json.hpp"

#include <cmath>
#include <cstdint>

namespace dsc::app {

using config::NodeType;
using nlohmann::ordered_json;

ordered_json to_json(const config::ConfigNode& node) {
    switch (node.type()) {
        case NodeType::null: return nullptr;
        case NodeType::boolean: return node.as_boolean();
        case NodeType::integer: return node.as_integer();
        case NodeType::real: return node.as_real();
        case NodeType::string: return node.as_string();
        case NodeType::list: {
            ordered_json list = ordered_json::array();
            for (const config::ConfigNode& item : node.items()) list.push_back(to_json(item));
            return list;
        }
        case NodeType::map: {
            ordered_json map = ordered_json::object();
            for (const config::ConfigEntry& entry : node.entries())
                map[entry.key] = to_json(entry.value);
            return map;
        }
    }
    return nullptr;
}

ordered_json number_json(double value) {
    constexpr double exact_to = 9007199254740992.0;  // 2^53
    if (std::abs(value) <= exact_to && std::trunc(value) == value)
        return static_cast<std::int64_t>(value);
    return value;
}

}  // namespace dsc::app
