#pragma once
// The name of the method that failed, for strategies in another language: a hook of the library may
// call more than one method there.

#include <exception>
#include <stdexcept>
#include <string>

namespace dsc::plugin {

/// Thrown with std::throw_with_nested() round the fault itself. Messages then name this method
/// instead of the hook that called it.
class MethodError : public std::runtime_error {
public:
    explicit MethodError(const std::string& method) : std::runtime_error(method) {}
    std::string method() const { return what(); }
};

}  // namespace dsc::plugin
