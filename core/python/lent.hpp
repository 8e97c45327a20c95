#pragma once
// Arrays lent to Python for the duration of one call into a strategy.

#include <map>
#include <string>

#include <pybind11/pybind11.h>

namespace dsc::python {

namespace py = pybind11;

/// Makes each array once per call and takes all of them back at its end. The memory belongs to the
/// run and changes afterwards, so a strategy that keeps an array is refused. The GIL must be held.
class Lent {
public:
    /// The array `name`, made by `make()` at its first use.
    template <class Make>
    py::object get(const std::string& name, Make&& make) {
        const auto known = arrays_.find(name);
        if (known != arrays_.end()) return known->second;
        return arrays_.emplace(name, make()).first->second;
    }

    /// Throws std::runtime_error that names an array that is still in use.
    void take_back();
    /// The same without the check, after an error.
    void forget() { arrays_.clear(); }

private:
    std::map<std::string, py::object> arrays_;
};

}  // namespace dsc::python
