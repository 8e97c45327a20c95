// Takes back what was lent.
#include "lent.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace dsc::python {

void Lent::take_back() {
    const std::map<std::string, py::object> arrays = std::exchange(arrays_, {});
    // Views of an array refer to it, so they are counted too.
    const auto kept = [](const auto& item) { return item.second.ref_count() > 1; };
    if (std::none_of(arrays.begin(), arrays.end(), kept)) return;
    py::module_::import("gc").attr("collect")();  // the variables of a finished call may form a
                                                  // cycle
    for (const auto& item : arrays) {
        if (!kept(item)) continue;
        const std::string& name = item.first;
        throw std::runtime_error("it keeps the array '" + name +
                                 "' or a part of it after the call; keep a copy: " + name +
                                 ".copy()");
    }
}

}  // namespace dsc::python
