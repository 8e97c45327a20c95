#pragma once
// A static object that ends the process as soon as any code of its library runs: whoever includes
// this must be refused from the outside.

#include <cstdlib>

namespace {
struct Tripwire {
    Tripwire() { std::abort(); }
};
[[maybe_unused]] const Tripwire tripwire;
}  // namespace
