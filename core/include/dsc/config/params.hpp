#pragma once
// ParamSchema<T>: declares the parameters of a strategy once, bound to the members of a plain
// struct. Validation, documentation, the editor's schema and the strategy's struct all come from
// this one declaration.

#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <dsc/config/field_builder.hpp>
#include <dsc/config/node.hpp>
#include <dsc/config/schema.hpp>

namespace dsc::config {

/// A nested strategy as a parameter: its id and its parameters. An empty type means none.
struct StrategyConfig {
    std::string type;
    ConfigNode params;  ///< a map without `type`; resolved if it comes from ParamSchema::read
    bool empty() const noexcept { return type.empty(); }
};

/// Converts a strategy to `{type: ID, parameters...}`, or null for none.
ConfigNode strategy_node(const StrategyConfig& strategy);
StrategyConfig strategy_from(const ConfigNode& node);

/// Throws PluginError "plugin.schema" with all of schema.problems() if there are any.
void require_sound(const Schema& schema);

/// Binds the members of `T` to named parameters.
///
/// ```
/// struct Params { double alpha = 0.2; std::optional<double> radius; config::StrategyConfig
/// curvature; }; static void declare(config::ParamSchema<Params>& s) {
///     s.real("alpha", &Params::alpha)
///         .range(0, 1, "dimensionless")
///         .open_low()
///         .doc("Fraction of the distance per step.");
///     s.real("radius", &Params::radius)
///         .greater(0, "length")
///         .doc("Radius; unset: nearest point.");
///     s.strategy("curvature", &Params::curvature, "curvature")
///         .optional()
///         .doc("None: no smoothing.");
///     s.check([](const Params& p) { return p.alpha < 1 || p.radius; }, "alpha 1 needs a radius");
/// }
/// ```
/// Defaults are the members of `defaults`, by default a value-initialised T. A member of type
/// std::optional may stay unset. The parameters of a strategy must not be called "type". [setup]
template <class T>
class ParamSchema {
public:
    ParamSchema() : bindings_(std::make_shared<Bindings>()) {}
    explicit ParamSchema(const T& defaults) : bindings_(std::make_shared<Bindings>(defaults)) {}
    ParamSchema(const ParamSchema&) = delete;
    ParamSchema& operator=(const ParamSchema&) = delete;

    FieldBuilder boolean(std::string name, bool T::*member) {
        return scalar(std::move(name), member, FieldType::boolean);
    }
    FieldBuilder boolean(std::string name, std::optional<bool> T::*member) {
        return scalar(std::move(name), member, FieldType::boolean);
    }

    /// A member of any integer type; values that the type cannot represent are refused.
    template <class Integer>
    FieldBuilder integer(std::string name, Integer T::*member) {
        return scalar(std::move(name), member, FieldType::integer);
    }

    FieldBuilder real(std::string name, double T::*member) {
        return scalar(std::move(name), member, FieldType::real);
    }
    FieldBuilder real(std::string name, std::optional<double> T::*member) {
        return scalar(std::move(name), member, FieldType::real);
    }

    FieldBuilder string(std::string name, std::string T::*member) {
        return scalar(std::move(name), member, FieldType::string);
    }
    FieldBuilder string(std::string name, std::optional<std::string> T::*member) {
        return scalar(std::move(name), member, FieldType::string);
    }

    /// A path, absolute once resolved.
    FieldBuilder file(std::string name, std::string T::*member) {
        return scalar(std::move(name), member, FieldType::file);
    }
    FieldBuilder file(std::string name, std::optional<std::string> T::*member) {
        return scalar(std::move(name), member, FieldType::file);
    }

    /// One of the named values of an enumeration (or of any type that compares with ==).
    template <class E>
    FieldBuilder choice(std::string name, E T::*member,
                        std::type_identity_t<std::vector<std::pair<std::string, E>>> values) {
        return choice_field<E>(std::move(name), std::move(values),
                               [member](T& t) -> E& { return t.*member; });
    }
    template <class E>
    FieldBuilder choice(std::string name, std::optional<E> T::*member,
                        std::type_identity_t<std::vector<std::pair<std::string, E>>> values) {
        return choice_field<E>(std::move(name), std::move(values),
                               [member](T& t) -> std::optional<E>& { return t.*member; });
    }

    /// Three real numbers; V is std::array<double, 3>, Vec3 or anything with v[0], v[1], v[2].
    template <class V>
    FieldBuilder vec3(std::string name, V T::*member) {
        return scalar(std::move(name), member, FieldType::vec3);
    }

    FieldBuilder integers(std::string name, std::vector<int> T::*member) {
        return scalar(std::move(name), member, FieldType::integer_list);
    }
    FieldBuilder reals(std::string name, std::vector<double> T::*member) {
        return scalar(std::move(name), member, FieldType::real_list);
    }
    FieldBuilder strings(std::string name, std::vector<std::string> T::*member) {
        return scalar(std::move(name), member, FieldType::string_list);
    }

    /// A nested struct, declared by `declare(ParamSchema<U>&)`; its defaults are the values inside
    /// T.
    template <class U, class Declare>
    FieldBuilder object(std::string name, U T::*member, Declare declare) {
        auto inner = nested<U>(bindings_->defaults.*member, declare);
        return add(
            field(std::move(name), FieldType::object, inner->shared_schema()),
            [member, inner](T& t, const ConfigNode& node) { t.*member = inner->read(node); },
            [member, inner](const T& t) { return inner->write(t.*member); });
    }
    template <class U, class Declare>
    FieldBuilder object(std::string name, std::optional<U> T::*member, Declare declare) {
        const std::optional<U>& value = bindings_->defaults.*member;
        auto inner = nested<U>(value ? *value : U{}, declare);
        Field f = field(std::move(name), FieldType::object, inner->shared_schema());
        f.optional = true;
        return add(
            std::move(f),
            [member, inner](T& t, const ConfigNode& node) {
                if (node.is_null()) {
                    (t.*member).reset();
                } else {
                    t.*member = inner->read(node);
                }
            },
            [member, inner](const T& t) {
                return t.*member ? inner->write(*(t.*member)) : ConfigNode();
            });
    }

    /// A list of structs, each declared by `declare(ParamSchema<U>&)`.
    template <class U, class Declare>
    FieldBuilder list(std::string name, std::vector<U> T::*member, Declare declare) {
        auto inner = nested<U>(U{}, declare);
        return add(
            field(std::move(name), FieldType::object_list, inner->shared_schema()),
            [member, inner](T& t, const ConfigNode& node) {
                (t.*member).clear();
                for (const ConfigNode& item : node.items())
                    (t.*member).push_back(inner->read(item));
            },
            [member, inner](const T& t) {
                std::vector<ConfigNode> items;
                for (const U& item : t.*member) items.push_back(inner->write(item));
                return ConfigNode::list(std::move(items));
            });
    }

    /// A strategy of `kind`. Required if the struct's default is empty, unless optional() follows.
    FieldBuilder strategy(std::string name, StrategyConfig T::*member, std::string kind) {
        Field f = field(std::move(name), FieldType::strategy);
        f.kind = std::move(kind);
        f.required = (bindings_->defaults.*member).empty();
        return add(
            std::move(f),
            [member](T& t, const ConfigNode& node) { t.*member = strategy_from(node); },
            [member](const T& t) { return strategy_node(t.*member); });
    }
    /// A list of strategies of `kind`.
    FieldBuilder strategies(std::string name, std::vector<StrategyConfig> T::*member,
                            std::string kind) {
        Field f = field(std::move(name), FieldType::strategy_list);
        f.kind = std::move(kind);
        return add(
            std::move(f),
            [member](T& t, const ConfigNode& node) {
                (t.*member).clear();
                for (const ConfigNode& item : node.items())
                    (t.*member).push_back(strategy_from(item));
            },
            [member](const T& t) {
                std::vector<ConfigNode> items;
                for (const StrategyConfig& item : t.*member) items.push_back(strategy_node(item));
                return ConfigNode::list(std::move(items));
            });
    }

    /// A condition on the whole struct. If it is false, the user reads `message`.
    void check(std::function<bool(const T&)> holds, std::string message) {
        schema_->check({[bindings = bindings_, holds = std::move(holds)](const ConfigNode& node) {
                            return holds(bindings->read(node));
                        },
                        std::move(message)});
    }
    /// `old_name` is still accepted for `new_name`, with a warning.
    void deprecated(std::string old_name, std::string new_name) {
        schema_->deprecate(std::move(old_name), std::move(new_name));
    }

    /// The type-erased declaration. Throws PluginError "plugin.schema" if it is faulty.
    const Schema& schema() const {
        require_sound(*schema_);
        return *schema_;
    }
    /// The same as a shared pointer; outlives this binder.
    std::shared_ptr<const Schema> shared_schema() const {
        require_sound(*schema_);
        return schema_;
    }

    /// The struct of a resolved map; members that the map lacks keep their defaults. Keys that are
    /// not parameters are ignored.
    T read(const ConfigNode& resolved) const { return bindings_->read(resolved); }
    /// The map of a struct with all members written out.
    ConfigNode write(const T& value) const { return bindings_->write(value); }

private:
    struct Binding {
        std::string name;
        std::function<void(T&, const ConfigNode&)> read;
        std::function<ConfigNode(const T&)> write;
    };
    /// Shared with the cross checks, which may outlive this object inside a schema.
    struct Bindings {
        Bindings() = default;
        explicit Bindings(const T& value) : defaults(value) {}
        T read(const ConfigNode& node) const {
            T value = defaults;
            for (const Binding& binding : all) {
                if (const ConfigNode* found = node.find(binding.name)) binding.read(value, *found);
            }
            return value;
        }
        ConfigNode write(const T& value) const {
            std::vector<ConfigEntry> entries;
            for (const Binding& binding : all)
                entries.emplace_back(binding.name, binding.write(value));
            return ConfigNode::map(std::move(entries));
        }
        T defaults{};
        std::vector<Binding> all;
    };

    template <class V>
    struct Unwrapped {
        using type = V;
        static constexpr bool optional = false;
    };
    template <class V>
    struct Unwrapped<std::optional<V>> {
        using type = V;
        static constexpr bool optional = true;
    };

    template <class V>
    static V from_node(const ConfigNode& node, [[maybe_unused]] FieldType type) {
        if constexpr (std::is_same_v<V, bool>) {
            return node.as_boolean();
        } else if constexpr (std::is_integral_v<V>) {
            return static_cast<V>(node.as_integer());
        } else if constexpr (std::is_same_v<V, double>) {
            return node.as_real();
        } else if constexpr (std::is_same_v<V, std::string>) {
            return node.as_string();
        } else if constexpr (is_list<V>::value) {
            V list;
            for (const ConfigNode& item : node.items()) {
                list.push_back(from_node<typename V::value_type>(item, type));
            }
            return list;
        } else {
            V vector{};
            for (std::size_t i = 0; i < 3; ++i)
                vector[static_cast<IndexOf<V>>(i)] = node.at(i).as_real();
            return vector;
        }
    }

    template <class V>
    static ConfigNode to_node(const V& value) {
        if constexpr (is_list<V>::value) {
            std::vector<ConfigNode> items;
            for (const auto& item : value) items.push_back(ConfigNode(item));
            return ConfigNode::list(std::move(items));
        } else if constexpr (std::is_constructible_v<ConfigNode, const V&>) {
            return ConfigNode(value);
        } else {
            return ConfigNode::list({ConfigNode(double(value[0])), ConfigNode(double(value[1])),
                                     ConfigNode(double(value[2]))});
        }
    }

    template <class V>
    struct is_list : std::false_type {};
    template <class V>
    struct is_list<std::vector<V>> : std::true_type {};
    /// Eigen uses a signed index type, std::array an unsigned one.
    template <class V, class = void>
    struct Index {
        using type = std::size_t;
    };
    template <class V>
    struct Index<V, std::void_t<typename V::Index>> {
        using type = typename V::Index;
    };
    template <class V>
    using IndexOf = typename Index<V>::type;

    template <class U, class Declare>
    static std::shared_ptr<const ParamSchema<U>> nested(const U& defaults, Declare declare) {
        auto inner = std::make_shared<ParamSchema<U>>(defaults);
        declare(*inner);
        return inner;
    }

    static Field field(std::string name, FieldType type,
                       std::shared_ptr<const Schema> object = nullptr) {
        Field f;
        f.name = std::move(name);
        f.type = type;
        f.object = std::move(object);
        return f;
    }

    template <class Member>
    FieldBuilder scalar(std::string name, Member T::*member, FieldType type) {
        using Value = typename Unwrapped<Member>::type;
        Field f = field(std::move(name), type);
        if constexpr (std::is_integral_v<Value> && !std::is_same_v<Value, bool>) {
            using Limits = std::numeric_limits<Value>;
            if constexpr (std::is_unsigned_v<Value>) {
                f.storage_min = 0;
                if constexpr (sizeof(Value) < sizeof(std::int64_t)) f.storage_max = Limits::max();
            } else {
                f.storage_min = Limits::min();
                f.storage_max = Limits::max();
            }
        } else if constexpr (std::is_same_v<Value, std::vector<int>>) {
            f.storage_min = std::numeric_limits<int>::min();
            f.storage_max = std::numeric_limits<int>::max();
        }
        if constexpr (Unwrapped<Member>::optional) {
            f.optional = true;
            return add(
                std::move(f),
                [member, type](T& t, const ConfigNode& node) {
                    if (node.is_null()) {
                        (t.*member).reset();
                    } else {
                        t.*member = from_node<Value>(node, type);
                    }
                },
                [member](const T& t) {
                    return t.*member ? to_node<Value>(*(t.*member)) : ConfigNode();
                });
        } else {
            return add(
                std::move(f),
                [member, type](T& t, const ConfigNode& node) {
                    t.*member = from_node<Value>(node, type);
                },
                [member](const T& t) { return to_node<Value>(t.*member); });
        }
    }

    template <class E, class Access>
    FieldBuilder choice_field(std::string name, std::vector<std::pair<std::string, E>> values,
                              Access access) {
        using Member = std::remove_reference_t<decltype(access(std::declval<T&>()))>;
        Field f = field(std::move(name), FieldType::choice);
        f.optional = Unwrapped<Member>::optional;
        for (const auto& value : values) f.choices.push_back(value.first);
        return add(
            std::move(f),
            [values, access](T& t, const ConfigNode& node) {
                if constexpr (Unwrapped<Member>::optional) {
                    if (node.is_null()) {
                        access(t).reset();
                        return;
                    }
                }
                for (const auto& value : values) {
                    if (value.first == node.as_string()) access(t) = value.second;
                }
            },
            [values, access](const T& t) {
                const Member& member = access(const_cast<T&>(t));  // access only names the member
                if constexpr (Unwrapped<Member>::optional) {
                    if (!member) return ConfigNode();
                    for (const auto& value : values) {
                        if (value.second == *member) return ConfigNode(value.first);
                    }
                } else {
                    for (const auto& value : values) {
                        if (value.second == member) return ConfigNode(value.first);
                    }
                }
                return ConfigNode();
            });
    }

    FieldBuilder add(Field f, std::function<void(T&, const ConfigNode&)> read,
                     std::function<ConfigNode(const T&)> write) {
        if (!f.required) f.default_value = write(bindings_->defaults);
        bindings_->all.push_back(Binding{f.name, std::move(read), std::move(write)});
        return FieldBuilder(*schema_, schema_->add(std::move(f)));
    }

    std::shared_ptr<Schema> schema_ = std::make_shared<Schema>();
    std::shared_ptr<Bindings> bindings_;

    template <class U>
    friend class ParamSchema;
};

/// Validates `given` against the struct's declaration and reads it. Throws ConfigError with all
/// faults. For tests and for programs that use a strategy without an experiment. [setup]
template <class T>
T read_params(const ConfigNode& given, const StrategyLookup& lookup = NoStrategies(),
              const std::string& owner = "the parameters") {
    ParamSchema<T> schema;
    T::declare(schema);
    Diagnostics diagnostics;
    const ConfigNode resolved = validate(given, schema.schema(), lookup, diagnostics, owner);
    diagnostics.throw_if_errors();
    return schema.read(resolved);
}

}  // namespace dsc::config
