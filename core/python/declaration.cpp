// The declarations of classes of Python as records of a plugin.
#include "declaration.hpp"

#include <map>
#include <memory>

#include <fmt/core.h>

#include <dsc/base/error.hpp>
#include <dsc/config/params.hpp>

#include "adapters.hpp"
#include "nested.hpp"
#include "nodes.hpp"

namespace dsc::python {
namespace {

using config::ConfigNode;
using config::Field;
using config::FieldType;

/// A class of Python that C++ code may copy and destroy without the GIL.
class SharedClass {
public:
    explicit SharedClass(py::object type)
        : type_(new py::object(std::move(type)), [](py::object* object) {
              const py::gil_scoped_acquire held;
              delete object;
          }) {}
    const py::object& type() const { return *type_; }

private:
    std::shared_ptr<py::object> type_;
};

FieldType type_of(const std::string& name) {
    static const std::map<std::string, FieldType> types = {
        {"boolean", FieldType::boolean},  {"integer", FieldType::integer},
        {"real", FieldType::real},        {"string", FieldType::string},
        {"choice", FieldType::choice},    {"file", FieldType::file},
        {"vec3", FieldType::vec3},        {"integers", FieldType::integer_list},
        {"reals", FieldType::real_list},  {"strings", FieldType::string_list},
        {"strategy", FieldType::strategy}};
    return types.at(name);
}

std::optional<config::Bound> bound_from(const py::handle& closed, const py::handle& open) {
    if (!open.is_none()) return config::Bound{open.cast<double>(), true};
    if (!closed.is_none()) return config::Bound{closed.cast<double>(), false};
    return std::nullopt;
}

std::vector<std::string> strings_from(const py::handle& list) {
    std::vector<std::string> strings;
    for (const py::handle item : list) strings.push_back(item.cast<std::string>());
    return strings;
}

Field field_from(const std::string& name, const py::handle& parameter) {
    Field field;
    field.name = name;
    field.type = type_of(parameter.attr("type").cast<std::string>());
    field.doc = parameter.attr("doc").cast<std::string>();
    field.unit = parameter.attr("unit").cast<std::string>();
    field.minimum = bound_from(parameter.attr("minimum"), parameter.attr("above"));
    field.maximum = bound_from(parameter.attr("maximum"), parameter.attr("below"));
    field.choices = strings_from(parameter.attr("choices"));
    field.extensions = strings_from(parameter.attr("extensions"));
    field.tags = strings_from(parameter.attr("tags"));
    field.kind = parameter.attr("kind").cast<std::string>();
    field.required = parameter.attr("required").cast<bool>();
    field.optional = parameter.attr("optional").cast<bool>();
    if (!field.required) field.default_value = node_from(parameter.attr("default"), name);
    return field;
}

std::shared_ptr<const config::Schema> schema_from(const py::handle& parameters) {
    const auto schema = std::make_shared<config::Schema>();
    for (const auto& [name, parameter] : py::reinterpret_borrow<py::dict>(parameters))
        schema->add(field_from(name.cast<std::string>(), parameter));
    return schema;
}

/// The strategies in the parameters of kind `strategy`, by the name of the parameter. They are
/// created without the GIL, because their plugins may be written in Python too.
std::map<std::string, std::shared_ptr<Nested>> nested_of(const config::Schema& schema,
                                                         const ConfigNode& resolved,
                                                         const plugin::Setup& setup) {
    std::map<std::string, std::shared_ptr<Nested>> all;
    for (const Field& field : schema.fields()) {
        const ConfigNode* value = resolved.find(field.name);
        if (field.type != FieldType::strategy || value == nullptr || value->is_null()) continue;
        const config::StrategyConfig config = config::strategy_from(*value);
        if (config.empty()) continue;
        auto nested = std::make_shared<Nested>();
        nested->kind = plugin::find_kind(field.kind).value();
        if (nested->kind == plugin::Kind::velocity) {
            nested->strategy = setup.create<hooks::VelocityField>(field.name, config);
        } else {
            nested->strategy = setup.create<hooks::CurvatureEstimator>(field.name, config);
        }
        all[field.name] = std::move(nested);
    }
    return all;
}

std::unique_ptr<hooks::Strategy> adapt(plugin::Kind kind, Instance instance) {
    switch (kind) {
        case plugin::Kind::velocity: return adapt_velocity(std::move(instance));
        case plugin::Kind::curvature: return adapt_curvature(std::move(instance));
        case plugin::Kind::refinement: return adapt_refinement(std::move(instance));
        case plugin::Kind::initial_mesh: return adapt_initial_mesh(std::move(instance));
        case plugin::Kind::observer: return adapt_observer(std::move(instance));
        case plugin::Kind::improvement:
        case plugin::Kind::filter: break;
    }
    throw Error(ExitCode::internal, "python.kind", "a Python strategy of an unknown kind");
}

/// The parameters with the defaults of those that are missing.
ConfigNode with_defaults(const config::Schema& schema, ConfigNode parameters) {
    for (const Field& field : schema.fields()) {
        if (!field.required && parameters.find(field.name) == nullptr)
            parameters = parameters.with(field.name, field.default_value);
    }
    return parameters;
}

plugin::Factory factory_of(plugin::Kind kind, const py::object& type,
                           std::shared_ptr<const config::Schema> schema) {
    return [kind, shared = SharedClass(type), schema = std::move(schema)](
               const ConfigNode& given, const plugin::Setup& setup) {
        const ConfigNode resolved = with_defaults(*schema, given);
        const auto nested = nested_of(*schema, resolved, setup);
        return with_python([&] {
            py::dict values = object_from(resolved);
            std::vector<std::shared_ptr<Nested>> strategies;
            for (const auto& [name, strategy] : nested) {
                values[py::str(name)] = strategy;
                strategies.push_back(strategy);
            }
            py::object self =
                py::module_::import("dsc._strategies").attr("make_instance")(shared.type(), values);
            return adapt(kind, Instance(std::move(self), std::move(strategies)));
        });
    };
}

plugin::StrategyRecord record_of(const py::handle& type) {
    const py::object declared = type.attr("__dsc__");
    plugin::StrategyRecord record;
    record.kind = plugin::find_kind(declared.attr("kind").cast<std::string>()).value();
    record.id = declared.attr("id").cast<std::string>();
    record.summary = declared.attr("summary").cast<std::string>();
    record.schema = schema_from(declared.attr("parameters"));
    config::require_sound(*record.schema);
    record.traits.stochastic = declared.attr("stochastic").cast<bool>();
    record.traits.rigid = declared.attr("rigid").cast<bool>();
    record.make = factory_of(record.kind, py::reinterpret_borrow<py::object>(type), record.schema);
    return record;
}

}  // namespace

plugin::PluginInfo info_of(const py::handle& about) {
    const auto text = [&about](const char* name) { return about.attr(name).cast<std::string>(); };
    return {text("name"),    text("version"),     text("license"), text("summary"),
            text("authors"), text("fingerprint"), text("file")};
}

std::vector<plugin::StrategyRecord> records_of(const py::handle& classes) {
    std::vector<plugin::StrategyRecord> records;
    for (const py::handle type : classes) records.push_back(record_of(type));
    return records;
}

}  // namespace dsc::python
