#pragma once
// Registrar: a plugin's enroll function registers the strategies of the library with it.

#include <functional>
#include <memory>
#include <string>
#include <utility>

#include <dsc/config/params.hpp>
#include <dsc/hooks/traits.hpp>
#include <dsc/plugin/kind.hpp>

namespace dsc::plugin {

class Setup;

/// Makes a strategy from its resolved parameters. A function object, so that it can contain a class
/// of another language.
using Factory = std::function<std::unique_ptr<hooks::Strategy>(const config::ConfigNode& resolved,
                                                               const Setup& setup)>;

/// One strategy as its plugin declares it.
struct StrategyRecord {
    Kind kind{};
    std::string id;       ///< [a-z][a-z0-9_]*, unique within its kind
    std::string summary;  ///< one line
    std::shared_ptr<const config::Schema> schema;
    Factory make{};
    hooks::Traits traits{};
};

/// The host owns it; strategies are registered in no other way.
class Registrar {
public:
    virtual ~Registrar();

    /// Registers `T`: a class derived from one hook, with a struct `T::Params`, a function `static
    /// void T::declare(config::ParamSchema<Params>&)` and a constructor `T(const Params&, const
    /// Setup&)`. It may have a member `static constexpr hooks::Traits traits`. Throws PluginError
    /// for a malformed or repeated id and for a faulty declaration. [setup]
    template <class T>
    void add(std::string id, std::string summary) {
        config::ParamSchema<typename T::Params> params;
        T::declare(params);
        enroll({kind_of<T>(), std::move(id), std::move(summary), params.shared_schema(), &make<T>,
                traits_of<T>()});
    }

    /// Registers a strategy that has no C++ class. Throws PluginError as above. [setup]
    void add(StrategyRecord record) { enroll(std::move(record)); }

protected:
    Registrar() = default;
    virtual void enroll(StrategyRecord record) = 0;

private:
    template <class T>
    static constexpr hooks::Traits traits_of() {
        if constexpr (requires { T::traits; }) {
            return T::traits;
        } else {
            return {};
        }
    }

    template <class T>
    static std::unique_ptr<hooks::Strategy> make(const config::ConfigNode& resolved,
                                                 const Setup& setup) {
        config::ParamSchema<typename T::Params> params;
        T::declare(params);
        return std::make_unique<T>(params.read(resolved), setup);
    }
};

}  // namespace dsc::plugin
