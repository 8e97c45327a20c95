#pragma once
// Gives back the memory of arrays.

namespace dsc {

/// Empties a string or an array and gives back its memory. `array = {}` keeps the memory: the
/// braces are an empty list of elements there, not an empty array.
template <class Array>
void release(Array& array) noexcept {
    Array().swap(array);
}

}  // namespace dsc
