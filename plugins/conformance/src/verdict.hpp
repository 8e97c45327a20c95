#pragma once
// A test that does not pass throws one of these.

#include <stdexcept>
#include <string>

namespace dsc::conformance {

struct Failed : std::runtime_error {
    using std::runtime_error::runtime_error;
};
struct Skipped : std::runtime_error {
    using std::runtime_error::runtime_error;
};
struct Warned : std::runtime_error {
    using std::runtime_error::runtime_error;
};

inline void require(bool holds, const std::string& otherwise) {
    if (!holds) throw Failed(otherwise);
}

}  // namespace dsc::conformance
