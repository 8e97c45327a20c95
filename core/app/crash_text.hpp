#pragma once
// The text about a crash, made without memory from the heap: the heap may be what is damaged.

#include <array>
#include <cstdint>
#include <string_view>

#include <signal.h>

namespace dsc::app {

/// A text of limited length; what does not fit is cut off. A signal handler may use it.
class CrashText {
public:
    CrashText& operator<<(std::string_view text) noexcept;
    CrashText& operator<<(int number) noexcept;
    /// As a hexadecimal number, "0x7f".
    CrashText& address(std::uintptr_t value) noexcept;
    /// Appends plugin::current_call(); false if the thread is outside a call.
    bool call() noexcept;

    std::string_view view() const noexcept { return {text_.data(), size_}; }

private:
    std::array<char, 4096> text_{};
    std::size_t size_ = 0;
};

/// The registers of the thread when the signal came; 0 on a machine for which they are not read.
struct CrashPlace {
    std::uintptr_t code = 0;   ///< address of the instruction
    std::uintptr_t stack = 0;  ///< end of the stack
};
CrashPlace place_of(const void* context) noexcept;

/// Appends "signal 11 (segmentation fault): it accessed the address 0x0".
void add_cause(CrashText& text, const siginfo_t& info, const CrashPlace& place) noexcept;

}  // namespace dsc::app
