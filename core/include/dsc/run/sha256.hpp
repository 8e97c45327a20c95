#pragma once
// SHA-256, in the form that sha256sum prints.

#include <string>
#include <string_view>

namespace dsc::run {

/// 64 lower-case hex digits. [parallel]
std::string sha256(std::string_view bytes);

}  // namespace dsc::run
