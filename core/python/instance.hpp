#pragma once
// An instance of a strategy written in Python, as the adapters of the hooks use it.

#include <exception>
#include <iosfwd>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <pybind11/pybind11.h>

#include <dsc/base/error.hpp>
#include <dsc/hooks/attributes.hpp>
#include <dsc/hooks/figures.hpp>
#include <dsc/plugin/method_error.hpp>
#include <dsc/repair/contract.hpp>

#include "errors.hpp"

namespace dsc::python {

namespace py = pybind11;

struct Nested;

/// Runs `body` with the GIL; exceptions of Python become exceptions of C++ that name their place.
/// [parallel]
template <class Body>
decltype(auto) with_python(Body&& body) {
    const py::gil_scoped_acquire held;
    try {
        return body();
    } catch (py::error_already_set& error) {
        rethrow_from_python(error);
    }
}

/// Calls a method of the strategy; messages about its faults name it. The GIL must be held.
template <class Body>
decltype(auto) as_method(const char* name, Body&& body) {
    try {
        return body();
    } catch (py::error_already_set& error) {
        try {
            rethrow_from_python(error);
        } catch (const CancelledError&) {
            throw;
        } catch (...) {
            std::throw_with_nested(plugin::MethodError(name));
        }
    } catch (...) {
        std::throw_with_nested(plugin::MethodError(name));
    }
}

/// The object and the strategies that it contains. It may be destroyed without the GIL.
class Instance {
public:
    /// The GIL must be held.
    Instance(py::object self, std::vector<std::shared_ptr<Nested>> nested)
        : self_(std::move(self)), nested_(std::move(nested)) {}
    ~Instance();
    Instance(Instance&& other) noexcept = default;
    Instance& operator=(Instance&&) = delete;

    const py::object& self() const { return self_; }
    /// Whether the class has this method. The GIL must be held.
    bool has(const char* method) const { return py::hasattr(self_, method); }
    /// The value of an attribute, or what a method of this name returns; `fallback` if there is
    /// none.
    template <class T>
    T value(const char* name, T fallback) const {
        return with_python([&]() -> T {
            if (!has(name)) return fallback;
            const py::object found = self_.attr(name);
            return (PyCallable_Check(found.ptr()) != 0 ? found() : found).template cast<T>();
        });
    }
    /// The rule in the attribute keep_creases: a dict with `dihedral` and `turn`, or None.
    std::optional<repair::CreaseRule> creases() const;
    /// What publish() returns: a dict of arrays.
    void publish(hooks::Attributes& out) const;

    /// What state() returns, and the states of the nested strategies; nothing if there are none.
    void save(std::ostream& out) const;
    void load(std::istream& in);

private:
    py::object self_;
    std::vector<std::shared_ptr<Nested>> nested_;
};

/// A dict of names and real numbers. The GIL must be held.
hooks::Figures figures_from(const py::handle& dict, const std::string& method);
/// A dict of names and arrays. The GIL must be held.
hooks::Attributes attributes_from(const py::handle& dict, const std::string& method);

}  // namespace dsc::python
