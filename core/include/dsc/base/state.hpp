#pragma once
// The saved state of an object as bytes, for checkpoints. Valid for the same build on the same kind
// of machine.

#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace dsc {

/// Types that may be copied byte by byte: plain values, and Eigen vectors of fixed size (their copy
/// constructors only copy).
template <class T>
inline constexpr bool is_plain_state =
    std::is_standard_layout_v<T>&& std::is_trivially_destructible_v<T> && !std::is_pointer_v<T>;

/// Appends values one after the other. [step]
class StateWriter {
public:
    template <class T>
    requires is_plain_state<T>
    void value(const T& v) { append(&v, sizeof(T)); }

    template <class T, class Allocator>
    requires is_plain_state<T>
    void list(const std::vector<T, Allocator>& values) {
        value<std::uint64_t>(values.size());
        if (!values.empty()) append(values.data(), values.size() * sizeof(T));
    }

    void text(std::string_view bytes) {
        value<std::uint64_t>(bytes.size());
        append(bytes.data(), bytes.size());
    }

    std::string take() { return std::move(bytes_); }

private:
    void append(const void* data, std::size_t size) {
        bytes_.append(static_cast<const char*>(data), size);
    }
    std::string bytes_;
};

/// Reads the values back in the same order. Throws IoError "state.damaged" if the bytes end too
/// early. The text must outlive the reader. [step]
class StateReader {
public:
    explicit StateReader(std::string_view bytes) : bytes_(bytes) {}

    template <class T>
    requires is_plain_state<T> T value() {
        T v;
        std::memcpy(static_cast<void*>(&v), take(sizeof(T)).data(), sizeof(T));
        return v;
    }

    template <class T>
    requires is_plain_state<T>
    void value(T& v) { v = value<T>(); }

    template <class T, class Allocator>
    requires is_plain_state<T>
    void list(std::vector<T, Allocator>& values) {
        const auto count = value<std::uint64_t>();
        if (count > bytes_.size() / sizeof(T)) damaged();
        const std::string_view from = take(static_cast<std::size_t>(count) * sizeof(T));
        values.resize(static_cast<std::size_t>(count));
        if (!from.empty()) std::memcpy(static_cast<void*>(values.data()), from.data(), from.size());
    }

    std::string_view text() {
        const auto size = value<std::uint64_t>();
        if (size > bytes_.size()) damaged();
        return take(static_cast<std::size_t>(size));
    }

    bool at_end() const { return bytes_.empty(); }

private:
    [[noreturn]] static void damaged();
    std::string_view take(std::size_t size) {
        if (size > bytes_.size()) damaged();
        const std::string_view part = bytes_.substr(0, size);
        bytes_.remove_prefix(size);
        return part;
    }

    std::string_view bytes_;
};

}  // namespace dsc
