// Parameters whose unit contains a length.
#include <cmath>

#include "parameters.hpp"

namespace dsc::conformance {
namespace {

using config::ConfigNode;
using config::Field;
using config::FieldType;

bool depends_on_another(const std::string& unit) {
    return unit.find(" or ") != std::string::npos || unit.find(", ") != std::string::npos;
}

/// "length^2/time": the power of the length.
int length_power(const std::string& unit, int curvature_power) {
    int power = 0;
    int sign = 1;
    for (std::size_t begin = 0; begin <= unit.size();) {
        const std::size_t end = std::min(unit.find('/', begin), unit.size());
        std::string word = unit.substr(begin, end - begin);
        int exponent = 1;
        if (const std::size_t caret = word.find('^'); caret != std::string::npos) {
            exponent = std::stoi(word.substr(caret + 1));
            word.erase(caret);
        }
        if (word == "length") power += sign * exponent;
        if (word == "curvature") power += sign * exponent * curvature_power;
        sign = -1;
        begin = end + 1;
    }
    return power;
}

ConfigNode multiplied(const ConfigNode& value, double factor) {
    if (value.is_number()) return ConfigNode(value.as_real() * factor);
    if (!value.is_list()) return value;
    std::vector<ConfigNode> items;
    for (const ConfigNode& item : value.items()) items.push_back(multiplied(item, factor));
    return ConfigNode::list(std::move(items));
}

bool is_real(const Field& field) {
    return field.type == FieldType::real || field.type == FieldType::real_list ||
           field.type == FieldType::vec3;
}

std::optional<ConfigNode> scaled_value(const Field& field, const ConfigNode& value, double factor,
                                       int curvature_power) {
    if (is_real(field)) {
        if (depends_on_another(field.unit)) return std::nullopt;
        const int power = length_power(field.unit, curvature_power);
        return power == 0 ? value : multiplied(value, std::pow(factor, power));
    }
    if (!field.object) return value;
    if (value.is_map()) return with_scaled_lengths(*field.object, value, factor, curvature_power);
    if (!value.is_list()) return value;
    std::vector<ConfigNode> items;
    for (const ConfigNode& item : value.items()) {
        auto scaled = with_scaled_lengths(*field.object, item, factor, curvature_power);
        if (!scaled) return std::nullopt;
        items.push_back(std::move(*scaled));
    }
    return ConfigNode::list(std::move(items));
}

}  // namespace

std::optional<ConfigNode> with_scaled_lengths(const config::Schema& schema, const ConfigNode& given,
                                              double factor, int curvature_power) {
    ConfigNode result = given;
    for (const Field& field : schema.fields()) {
        const ConfigNode* const value = given.find(field.name);
        if (value == nullptr) continue;
        auto scaled = scaled_value(field, *value, factor, curvature_power);
        if (!scaled) return std::nullopt;
        result = result.with(field.name, std::move(*scaled));
    }
    return result;
}

}  // namespace dsc::conformance
