#pragma once
// How the heap treats large blocks.

namespace dsc {

/// From now on, blocks of some megabytes go back to the system as soon as they are freed. Usually
/// the heap keeps them for later blocks, and those often do not fit into the gaps. For programs: it
/// changes the whole process. It does nothing where the system's heap has no such setting. [setup]
void give_back_large_blocks();

}  // namespace dsc
