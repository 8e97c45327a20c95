// The state and the answers of a strategy written in Python.
#include "instance.hpp"

#include <istream>
#include <iterator>
#include <ostream>
#include <sstream>

#include <fmt/core.h>

#include <dsc/base/error.hpp>
#include <dsc/base/state.hpp>

#include "arrays.hpp"
#include "nested.hpp"

namespace dsc::python {
namespace {

constexpr std::string_view state_head = "dsc-python-state-1";

/// The dict that a method returned; an empty one for None.
py::dict dict_from(const py::handle& value, const std::string& method) {
    if (value.is_none()) return {};
    if (py::isinstance<py::dict>(value)) return py::reinterpret_borrow<py::dict>(value);
    throw std::runtime_error(
        fmt::format("{}() returned {} instead of a dict", method,
                    py::str(py::type::of(value).attr("__name__")).cast<std::string>()));
}

/// What state() returned, as bytes with a letter for their form.
std::string bytes_of(const py::object& state) {
    if (py::isinstance<py::bytes>(state)) return "b" + state.cast<std::string>();
    try {
        return "j" + py::module_::import("json").attr("dumps")(state).cast<std::string>();
    } catch (py::error_already_set& error) {
        throw std::runtime_error("state() returned what JSON cannot store: " + text_of(error));
    }
}

/// A value of a dict of figures. Python's and NumPy's numbers have __float__; so has an array of
/// one number, which would be a number by mistake.
double figure_from(const py::handle& value, const std::string& method, const std::string& name) {
    const auto type = py::str(py::type::of(value).attr("__name__")).cast<std::string>();
    const bool number = PyNumber_Check(value.ptr()) != 0 && !py::isinstance<py::array>(value);
    try {
        if (number) return value.cast<double>();
    } catch (const py::cast_error&) {
        PyErr_Clear();
    }
    throw std::runtime_error(fmt::format("{}() returned {} for the figure '{}' instead of a number",
                                         method, type, name));
}

py::object state_of(std::string_view bytes) {
    if (bytes.empty())
        throw IoError("state.damaged", "saved state", "", "the state of the strategy is incomplete",
                      "start the run again");
    const std::string_view content = bytes.substr(1);
    if (bytes.front() == 'b') return py::bytes(content.data(), content.size());
    if (bytes.front() != 'j')
        throw IoError("state.damaged", "saved state", "", "the state of the strategy is damaged",
                      "start the run again");
    return py::module_::import("json").attr("loads")(py::bytes(content.data(), content.size()));
}

}  // namespace

Instance::~Instance() {
    if (!self_) return;
    const py::gil_scoped_acquire held;
    self_.release().dec_ref();
    nested_.clear();
}

std::optional<repair::CreaseRule> Instance::creases() const {
    return with_python([&]() -> std::optional<repair::CreaseRule> {
        if (!has("keep_creases")) return std::nullopt;
        py::object found = self_.attr("keep_creases");
        if (PyCallable_Check(found.ptr()) != 0) found = found();
        if (found.is_none()) return std::nullopt;
        const py::dict rule = dict_from(found, "keep_creases");
        return repair::CreaseRule{rule["dihedral"].cast<double>(), rule["turn"].cast<double>()};
    });
}

void Instance::publish(hooks::Attributes& out) const {
    with_python([&] {
        if (!has("publish")) return;
        for (hooks::Attribute& a : attributes_from(self_.attr("publish")(), "publish"))
            out.push_back(std::move(a));
    });
}

void Instance::save(std::ostream& out) const {
    with_python([&] {
        const bool own = has("state");
        if (!own && nested_.empty()) return;
        StateWriter state;
        state.text(state_head);
        state.text(own ? as_method("state", [&] { return bytes_of(self_.attr("state")()); })
                       : std::string());
        for (const auto& nested : nested_) {
            std::ostringstream text(std::ios::binary);
            {
                const py::gil_scoped_release released;
                nested->strategy->save(text);
            }
            state.text(text.str());
        }
        const std::string bytes = state.take();
        out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    });
}

void Instance::load(std::istream& in) {
    with_python([&] {
        const bool own = has("state");
        if (!own && nested_.empty()) return;
        const std::string bytes{std::istreambuf_iterator<char>(in), {}};
        StateReader state(bytes);
        if (state.text() != state_head)
            throw IoError("state.damaged", "saved state", "",
                          "the state of the strategy is damaged", "start the run again");
        const std::string_view text = state.text();
        if (own) self_.attr("load")(state_of(text));
        for (const auto& nested : nested_) {
            std::istringstream part(std::string(state.text()), std::ios::binary);
            const py::gil_scoped_release released;
            nested->strategy->load(part);
        }
    });
}

hooks::Figures figures_from(const py::handle& dict, const std::string& method) {
    hooks::Figures figures;
    for (const auto& [key, value] : dict_from(dict, method)) {
        const auto name = py::str(key).cast<std::string>();
        figures.emplace_back(name, figure_from(value, method, name));
    }
    return figures;
}

hooks::Attributes attributes_from(const py::handle& dict, const std::string& method) {
    hooks::Attributes attributes;
    for (const auto& [key, value] : dict_from(dict, method)) {
        const auto name = py::str(key).cast<std::string>();
        attributes.push_back({name, numbers_from(value, method + "()['" + name + "']")});
    }
    return attributes;
}

}  // namespace dsc::python
