// Conversion between configurations and values of Python.
#include "nodes.hpp"

#include <fmt/core.h>

#include <dsc/base/error.hpp>

namespace dsc::python {
namespace {

using config::ConfigNode;
using config::NodeType;

ConfigNode map_from(const py::dict& dict, const std::string& path) {
    std::vector<config::ConfigEntry> entries;
    for (const auto& [key, value] : dict) {
        if (!py::isinstance<py::str>(key))
            throw UsageError("value.type", path.empty() ? "the dict" : path,
                             fmt::format("has the key {}, which is not a string",
                                         py::repr(key).cast<std::string>()),
                             "use strings as keys");
        const auto name = key.cast<std::string>();
        entries.emplace_back(name, node_from(value, config::join_path(path, name)));
    }
    return ConfigNode::map(std::move(entries)).with_path(path);
}

ConfigNode list_from(const py::handle& list, const std::string& path) {
    std::vector<ConfigNode> items;
    for (const py::handle item : list)
        items.push_back(node_from(item, config::join_path(path, std::to_string(items.size()))));
    return ConfigNode::list(std::move(items)).with_path(path);
}

ConfigNode integer_from(const py::handle& value, const std::string& path) {
    int overflow = 0;
    const long long integer = PyLong_AsLongLongAndOverflow(value.ptr(), &overflow);
    if (overflow != 0)
        throw UsageError("value.type", path, "is an integer of more than 64 bits",
                         "give a smaller number");
    return ConfigNode(static_cast<std::int64_t>(integer));
}

}  // namespace

py::object object_from(const ConfigNode& node) {
    switch (node.type()) {
        case NodeType::null: return py::none();
        case NodeType::boolean: return py::bool_(node.as_boolean());
        case NodeType::integer: return py::int_(node.as_integer());
        case NodeType::real: return py::float_(node.as_real());
        case NodeType::string: return py::str(node.as_string());
        case NodeType::list: {
            py::list list;
            for (const ConfigNode& item : node.items()) list.append(object_from(item));
            return list;
        }
        case NodeType::map: {
            py::dict dict;
            for (const config::ConfigEntry& entry : node.entries())
                dict[py::str(entry.key)] = object_from(entry.value);
            return dict;
        }
    }
    return py::none();
}

ConfigNode node_from(const py::handle& value, const std::string& path) {
    if (value.is_none()) return {};
    if (py::isinstance<py::bool_>(value)) return value.cast<bool>();
    if (py::isinstance<py::int_>(value)) return integer_from(value, path);
    if (py::isinstance<py::float_>(value)) return value.cast<double>();
    if (py::isinstance<py::str>(value)) return value.cast<std::string>();
    if (py::isinstance<py::dict>(value))
        return map_from(py::reinterpret_borrow<py::dict>(value), path);
    if (py::isinstance<py::list>(value) || py::isinstance<py::tuple>(value))
        return list_from(value, path);
    if (py::hasattr(value, "tolist"))  // a number or an array of NumPy
        return node_from(value.attr("tolist")(), path);
    if (py::hasattr(value, "__fspath__"))
        return py::module_::import("os").attr("fspath")(value).cast<std::string>();
    throw UsageError("value.type", path.empty() ? "the value" : path,
                     fmt::format("is {}, which an experiment cannot contain",
                                 py::str(py::type::of(value).attr("__name__")).cast<std::string>()),
                     "use None, booleans, numbers, strings, lists and dicts");
}

}  // namespace dsc::python
