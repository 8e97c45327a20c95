// Settings of the heap of the GNU C library.
#include "dsc/base/heap.hpp"

#include <cstdlib>

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace dsc {

void give_back_large_blocks() {
#ifdef __GLIBC__
    constexpr int large = 4 << 20, kept = 16 << 20;  // bytes
    // Blocks from this size on have pages of their own. Otherwise the limit grows with the blocks
    // that are freed, up to 32 MB.
    mallopt(M_MMAP_THRESHOLD, large);
    // What the heap keeps at its end, so that it need not grow again for each block; usually twice
    // the limit above, but only as long as nobody sets that.
    mallopt(M_TRIM_THRESHOLD, kept);
#endif
}

}  // namespace dsc
