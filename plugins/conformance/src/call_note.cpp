#include "call_note.hpp"

#include <algorithm>
#include <cstring>

#include <sys/mman.h>

namespace dsc::conformance {
namespace {

constexpr std::size_t room = 256;
char* note = nullptr;

void write_note(const std::string& text) {
    if (note == nullptr) return;
    const std::size_t size = std::min(text.size(), room - 1);
    std::memcpy(note, text.data(), size);
    note[size] = '\0';
}

}  // namespace

void share_call_note() {
    if (note == nullptr) {
        void* const memory =
            ::mmap(nullptr, room, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
        if (memory == MAP_FAILED) return;
        note = static_cast<char*>(memory);
    }
    write_note("");
}

std::string call_in_progress() { return note == nullptr ? std::string() : std::string(note); }

Calling::Calling(std::string_view hook, std::optional<std::uint64_t> step) {
    std::string text(hook);
    if (step) text += " at step " + std::to_string(*step);
    write_note(text);
}

Calling::~Calling() { write_note(""); }

}  // namespace dsc::conformance
