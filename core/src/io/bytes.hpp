#pragma once
// Numbers of binary files in a given byte order.

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <string>

namespace dsc::io {

/// The number at the start of `bytes`, which must be long enough.
template <class T>
T load_number(const char* bytes, std::endian order) {
    std::array<char, sizeof(T)> raw;
    std::memcpy(raw.data(), bytes, sizeof(T));
    if (order != std::endian::native) std::reverse(raw.begin(), raw.end());
    return std::bit_cast<T>(raw);
}

/// Appends the number in little-endian order.
template <class T>
void append_bytes(std::string& out, T value) {
    auto raw = std::bit_cast<std::array<char, sizeof(T)>>(value);
    if (std::endian::native != std::endian::little) std::reverse(raw.begin(), raw.end());
    out.append(raw.data(), raw.size());
}

}  // namespace dsc::io
