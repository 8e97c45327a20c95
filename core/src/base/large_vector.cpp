// Memory in large pages.
#include "dsc/base/large_vector.hpp"

#include <cstdint>
#include <limits>

#include <sys/mman.h>

namespace dsc {
namespace {

std::size_t whole_pages(std::size_t bytes) {
    return (bytes + large_page - 1) / large_page * large_page;
}

// Bytes from an address up to the next whole page.
std::size_t bytes_to_page(const void* address) {
    return (large_page - reinterpret_cast<std::uintptr_t>(address) % large_page) % large_page;
}

}  // namespace

// The memory comes from the system and not from the heap. Aligned blocks would leave gaps in the
// heap, and a freed block goes back to the system at once.
void* allocate_large_pages(std::size_t bytes) {
    if (bytes > std::numeric_limits<std::size_t>::max() - 2 * large_page)
        throw std::bad_array_new_length();
    const std::size_t whole = whole_pages(bytes), more = whole + large_page;
    void* const mapped =
        mmap(nullptr, more, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (mapped == MAP_FAILED) throw std::bad_alloc();
    auto* const start = static_cast<std::byte*>(mapped);
    const std::size_t before = bytes_to_page(mapped);
    if (before > 0) munmap(start, before);
    if (before < large_page) munmap(start + before + whole, large_page - before);
    // It is a hint: a system without large pages refuses it, and everything works all the same.
    static_cast<void>(madvise(start + before, whole, MADV_HUGEPAGE));
    return start + before;
}

void prefer_large_pages(void* memory, std::size_t bytes) noexcept {
    const std::size_t before = bytes_to_page(memory);
    if (bytes < before + large_page) return;
    const std::size_t whole = (bytes - before) / large_page * large_page;
    static_cast<void>(madvise(static_cast<std::byte*>(memory) + before, whole, MADV_HUGEPAGE));
}

void free_large_pages(void* memory, std::size_t bytes) noexcept {
    munmap(memory, whole_pages(bytes));
}

}  // namespace dsc
