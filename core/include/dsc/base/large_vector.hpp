#pragma once
// A vector for large arrays that are read in no order of memory.

#include <cstddef>
#include <limits>
#include <new>
#include <type_traits>
#include <vector>

#include <dsc/base/release.hpp>

namespace dsc {

/// Memory from this number of bytes on is asked for in pages of this size, where the system has
/// such pages. The processor remembers the addresses of only a few thousand pages, and with small
/// pages it must look up nearly each access to an array of some megabytes.
inline constexpr std::size_t large_page = std::size_t{1} << 21U;

/// Memory at a multiple of large_page, in pages of this size if the system offers them. Free it by
/// free_large_pages() with the same number. Throws std::bad_alloc. [parallel]
void* allocate_large_pages(std::size_t bytes);
void free_large_pages(void* memory, std::size_t bytes) noexcept;
/// A hint for memory that comes from elsewhere and has not been written to yet. [parallel]
void prefer_large_pages(void* memory, std::size_t bytes) noexcept;

/// An allocator for arrays that may become large.
template <class T>
class LargePages {
public:
    using value_type = T;

    LargePages() = default;
    template <class U>
    LargePages(const LargePages<U>&) noexcept {}

    T* allocate(std::size_t count) {
        if (count > std::numeric_limits<std::size_t>::max() / sizeof(T))
            throw std::bad_array_new_length();
        const std::size_t bytes = count * sizeof(T);
        return static_cast<T*>(bytes < large_page ? ::operator new(bytes)
                                                  : allocate_large_pages(bytes));
    }
    void deallocate(T* memory, std::size_t count) noexcept {
        if (count * sizeof(T) < large_page) {
            ::operator delete(memory);
        } else {
            free_large_pages(memory, count * sizeof(T));
        }
    }

    /// Makes an element for which no value is given, as resize() does. If its type has no initial
    /// values, nothing is written, so that a list can be made longer without writing to it twice.
    template <class U>
    void construct(U* place) noexcept(std::is_nothrow_default_constructible_v<U>) {
        ::new (static_cast<void*>(place)) U;
    }

    template <class U>
    bool operator==(const LargePages<U>&) const noexcept {
        return true;
    }
};

/// An element that resize() adds has a defined value only if its type has initial values.
template <class T>
using LargeVector = std::vector<T, LargePages<T>>;

/// Gives back the memory of an array that has room for three times the `wanted` elements or more,
/// for example after a first step that looked at the whole mesh. The array is empty then, and has
/// room for `wanted` elements.
template <class T>
void give_back_room(LargeVector<T>& list, std::size_t wanted) {
    if (list.capacity() * sizeof(T) < large_page || list.capacity() / 3 < wanted) return;
    release(list);
    list.reserve(wanted);
}

}  // namespace dsc
