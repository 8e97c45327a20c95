// Memory in large pages.
#include "dsc/base/large_vector.hpp"

#include <limits>

#include <sys/mman.h>

namespace dsc {

void* allocate_large_pages(std::size_t bytes) {
    if (bytes > std::numeric_limits<std::size_t>::max() - large_page)
        throw std::bad_array_new_length();
    // Only whole pages, so that nobody else's memory shares one.
    const std::size_t whole = (bytes + large_page - 1) / large_page * large_page;
    void* const memory = ::operator new (whole, std::align_val_t{large_page});
    // It is a hint: a system without large pages refuses it, and everything works all the same.
    static_cast<void>(madvise(memory, whole, MADV_HUGEPAGE));
    return memory;
}

void free_large_pages(void* memory) noexcept {
    ::operator delete (memory, std::align_val_t{large_page});
}

}  // namespace dsc
