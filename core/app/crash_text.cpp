#include "crash_text.hpp"

#include <algorithm>
#include <charconv>
#include <span>

#include <ucontext.h>

#include <dsc/plugin/guarded.hpp>

namespace dsc::app {
namespace {

// strsignal() may need memory and a locale.
std::string_view signal_name(int number) noexcept {
    switch (number) {
        case SIGSEGV: return "segmentation fault";
        case SIGBUS: return "bus error";
        case SIGFPE: return "arithmetic error";
        case SIGILL: return "illegal instruction";
        case SIGABRT: return "abort";
        default: return "unknown";
    }
}

/// Whether the address is just beyond the end of the stack, as when a recursion never ends.
bool is_overflow(std::uintptr_t address, std::uintptr_t stack) noexcept {
    constexpr std::uintptr_t reach = std::uintptr_t{1} << 16U;
    return stack != 0 && address + reach > stack && address < stack + reach;
}

void add_access(CrashText& text, const siginfo_t& info, const CrashPlace& place) noexcept {
    const auto address = reinterpret_cast<std::uintptr_t>(info.si_addr);
    if (is_overflow(address, place.stack)) {
        text << "its stack overflowed";
    } else if (info.si_code == SI_KERNEL) {
        text << "it used an address that cannot exist";
    } else {
        (text << "it used the address ").address(address);
        text << ", which is not its memory";
    }
}

}  // namespace

CrashText& CrashText::operator<<(std::string_view text) noexcept {
    const std::size_t fits = std::min(text.size(), text_.size() - size_);
    std::copy_n(text.begin(), fits, text_.begin() + static_cast<std::ptrdiff_t>(size_));
    size_ += fits;
    return *this;
}

CrashText& CrashText::operator<<(int number) noexcept {
    const auto end = std::to_chars(text_.data() + size_, text_.data() + text_.size(), number);
    if (end.ec == std::errc()) size_ = static_cast<std::size_t>(end.ptr - text_.data());
    return *this;
}

CrashText& CrashText::address(std::uintptr_t value) noexcept {
    *this << "0x";
    const auto end = std::to_chars(text_.data() + size_, text_.data() + text_.size(), value, 16);
    if (end.ec == std::errc()) size_ = static_cast<std::size_t>(end.ptr - text_.data());
    return *this;
}

bool CrashText::call() noexcept {
    const std::size_t added = plugin::current_call(std::span(text_).subspan(size_));
    size_ += added;
    return added > 0;
}

CrashPlace place_of(const void* context) noexcept {
    [[maybe_unused]] const auto& machine = static_cast<const ucontext_t*>(context)->uc_mcontext;
#if defined(__x86_64__)
    return {static_cast<std::uintptr_t>(machine.gregs[REG_RIP]),
            static_cast<std::uintptr_t>(machine.gregs[REG_RSP])};
#elif defined(__aarch64__)
    return {machine.pc, machine.sp};
#else
    return {};
#endif
}

void add_cause(CrashText& text, const siginfo_t& info, const CrashPlace& place) noexcept {
    text << "signal " << info.si_signo << " (" << signal_name(info.si_signo) << "): ";
    const bool sent = info.si_code <= 0;
    if (info.si_signo == SIGABRT) {
        text << "it called abort(), as assert() and an exception that nobody catches do";
    } else if (sent) {
        text << "it sent this signal to its own process";
    } else if (info.si_signo == SIGFPE && info.si_code == FPE_INTDIV) {
        text << "it divided an integer by zero, or the smallest one by -1";
    } else if (info.si_signo == SIGFPE) {
        text << "its arithmetic has no result";
    } else if (info.si_signo == SIGILL) {
        text << "it executed an instruction that does not exist, such as the trap of a sanitizer";
    } else if (info.si_signo == SIGBUS) {
        text << "it used memory beyond the end of a file, or at an unaligned address";
    } else {
        add_access(text, info, place);
    }
}

}  // namespace dsc::app
