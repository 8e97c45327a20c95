#include "guarded_input.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <cstdlib>
#include <mutex>
#include <new>

#include <signal.h>
#include <sys/mman.h>
#include <unistd.h>

#include <dsc/plugin/fingerprint.hpp>

#include "call_note.hpp"
#include "interpose.hpp"

namespace dsc::conformance {
namespace {

constexpr std::size_t region_size = std::size_t{16} << 30U;  // addresses, not memory
constexpr std::size_t page = 4096;

struct Block {
    std::uintptr_t begin = 0;  ///< of the data
    std::uintptr_t end = 0;    ///< of the data; the guard begins here
    std::uintptr_t last = 0;   ///< end of the guard
    const char* name = nullptr;
    bool freed = false;
};

/// All blocks in the order of their addresses.
struct Region {
    std::mutex mutex;
    std::uintptr_t begin = 0;
    std::uintptr_t next = 0;
    std::array<Block, 65536> blocks;
    std::size_t count = 0;
};

Region region;
std::atomic<bool> ready{false};
void (*report_fault)(const std::string&) = nullptr;
thread_local int depth = 0;  // of GuardedMemory objects

bool contains(std::uintptr_t address) {
    return ready && address >= region.begin && address < region.begin + region_size;
}

/// Null if there is no more room.
void* allocate(std::size_t size) {
    const std::lock_guard lock(region.mutex);
    const std::size_t pages = (std::max<std::size_t>(size, 1) + page - 1) / page * page;
    const bool full = region.next + pages + page > region.begin + region_size;
    if (full || region.count == region.blocks.size()) return nullptr;
    void* const begin = reinterpret_cast<void*>(region.next);
    if (::mprotect(begin, pages, PROT_READ | PROT_WRITE) != 0) return nullptr;
    const std::uintptr_t end = region.next + pages;
    region.next = end + page;
    // Elements of 8 bytes stay aligned for their type, though not for everything.
    region.blocks[region.count++] = {end - size, end, end + page, nullptr, false};
    return reinterpret_cast<void*>(end - size);
}

Block* find(std::uintptr_t address) {
    auto* const end = region.blocks.begin() + region.count;
    auto* const found = std::upper_bound(
        region.blocks.begin(), end, address,
        [](std::uintptr_t place, const Block& block) { return place < block.last; });
    return found == end ? nullptr : found;
}

void release(std::uintptr_t address) {
    const std::lock_guard lock(region.mutex);
    Block* const block = find(address);
    if (block == nullptr) return;
    block->freed = true;
    void* const begin = reinterpret_cast<void*>(block->begin / page * page);
    const std::size_t size = block->end - block->begin / page * page;
    ::madvise(begin, size, MADV_DONTNEED);
    ::mprotect(begin, size, PROT_NONE);
}

void* replaced_new(std::size_t size) {
    if (depth > 0) {
        if (void* const memory = allocate(size)) return memory;
    }
    if (void* const memory = std::malloc(std::max<std::size_t>(size, 1))) return memory;
    throw std::bad_alloc();
}

void replaced_delete(void* memory) noexcept {
    if (contains(reinterpret_cast<std::uintptr_t>(memory)))
        return release(reinterpret_cast<std::uintptr_t>(memory));
    std::free(memory);
}

void replaced_sized_delete(void* memory, std::size_t) noexcept { replaced_delete(memory); }

/// The strategy has stopped at a read, in its own code, so this may use memory like any code; if it
/// was inside malloc() nevertheless, the time limit of the test ends the wait.
void on_signal(int number, siginfo_t* info, void*) {
    const auto address = reinterpret_cast<std::uintptr_t>(info->si_addr);
    const Block* const block = contains(address) ? find(address) : nullptr;
    ::signal(number, SIG_DFL);
    if (block == nullptr) return;  // the instruction runs again and ends the process
    std::string what = block->freed ? "it uses memory that is no longer valid, of "
                                    : "it uses memory beyond the end of ";
    what += block->name == nullptr ? "its input" : block->name;
    const std::string call = call_in_progress();
    report_fault(call.empty() ? what : what + ", in " + call);
}

}  // namespace

void guard_input(void (*on_fault)(const std::string& what)) {
    if (plugin::core_fingerprint().find("san=none") == std::string_view::npos) return;
    void* const memory =
        ::mmap(nullptr, region_size, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    if (memory == MAP_FAILED) return;
    region.begin = region.next = reinterpret_cast<std::uintptr_t>(memory);
    report_fault = on_fault;
    const std::array<Replacement, 3> functions = {
        Replacement{"_Znwm", reinterpret_cast<void*>(replaced_new)},
        {"_ZdlPv", reinterpret_cast<void*>(replaced_delete)},
        {"_ZdlPvm", reinterpret_cast<void*>(replaced_sized_delete)}};
    interpose(functions);
    struct sigaction action {};
    action.sa_sigaction = on_signal;
    action.sa_flags = SA_SIGINFO;
    ::sigaction(SIGSEGV, &action, nullptr);
    ready = true;
}

bool input_is_guarded() { return ready; }

GuardedMemory::GuardedMemory() { depth += ready ? 1 : 0; }
GuardedMemory::~GuardedMemory() { depth -= ready ? 1 : 0; }

void name_memory(const void* data, const char* name) {
    const auto address = reinterpret_cast<std::uintptr_t>(data);
    if (!contains(address)) return;
    const std::lock_guard lock(region.mutex);
    if (Block* const block = find(address)) block->name = name;
}

}  // namespace dsc::conformance
