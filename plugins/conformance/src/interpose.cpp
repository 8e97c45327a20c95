#include "interpose.hpp"

#include <cstdint>
#include <cstring>

#include <sys/mman.h>
#include <unistd.h>

#include <link.h>

namespace dsc::conformance {
namespace {

/// The tables of a loaded library that say which of its memory contains the address of a function.
struct Tables {
    const char* names = nullptr;
    const ElfW(Sym) * symbols = nullptr;
    const ElfW(Rela) * entries[2] = {nullptr, nullptr};
    std::size_t sizes[2] = {0, 0};  // in bytes
};

Tables tables_of(const dl_phdr_info& library) {
    Tables tables;
    for (int i = 0; i < library.dlpi_phnum; ++i) {
        if (library.dlpi_phdr[i].p_type != PT_DYNAMIC) continue;
        const auto* entry =
            reinterpret_cast<const ElfW(Dyn)*>(library.dlpi_addr + library.dlpi_phdr[i].p_vaddr);
        for (; entry->d_tag != DT_NULL; ++entry) {
            // The loader has made these addresses absolute, except in libraries of the kernel.
            const ElfW(Addr) value = entry->d_un.d_ptr;
            const ElfW(Addr) at = value < library.dlpi_addr ? library.dlpi_addr + value : value;
            switch (entry->d_tag) {
                case DT_STRTAB: tables.names = reinterpret_cast<const char*>(at); break;
                case DT_SYMTAB: tables.symbols = reinterpret_cast<const ElfW(Sym)*>(at); break;
                case DT_JMPREL: tables.entries[0] = reinterpret_cast<const ElfW(Rela)*>(at); break;
                case DT_PLTRELSZ: tables.sizes[0] = entry->d_un.d_val; break;
                case DT_RELA: tables.entries[1] = reinterpret_cast<const ElfW(Rela)*>(at); break;
                case DT_RELASZ: tables.sizes[1] = entry->d_un.d_val; break;
                default: break;
            }
        }
    }
    return tables;
}

/// The memory may be read-only, because the loader protects it.
void write_address(std::uintptr_t place, void* function) {
    const auto page = static_cast<std::uintptr_t>(::sysconf(_SC_PAGESIZE));
    const std::uintptr_t begin = place / page * page;
    if (::mprotect(reinterpret_cast<void*>(begin), page, PROT_READ | PROT_WRITE) != 0) return;
    std::memcpy(reinterpret_cast<void*>(place), &function, sizeof function);
}

int replace_in(dl_phdr_info* library, std::size_t, void* data) {
    const auto& replacements = *static_cast<const std::span<const Replacement>*>(data);
    const Tables tables = tables_of(*library);
    if (tables.names == nullptr || tables.symbols == nullptr) return 0;
    for (int list = 0; list < 2; ++list) {
        const std::size_t count = tables.sizes[list] / sizeof(ElfW(Rela));
        for (std::size_t i = 0; tables.entries[list] != nullptr && i < count; ++i) {
            const ElfW(Rela)& entry = tables.entries[list][i];
            const std::size_t symbol = ELF64_R_SYM(entry.r_info);
            if (symbol == 0) continue;
            const char* const name = tables.names + tables.symbols[symbol].st_name;
            for (const Replacement& r : replacements) {
                if (std::strcmp(name, r.symbol) == 0)
                    write_address(library->dlpi_addr + entry.r_offset, r.function);
            }
        }
    }
    return 0;
}

}  // namespace

void interpose(std::span<const Replacement> replacements) {
    ::dl_iterate_phdr(replace_in, &replacements);
}

}  // namespace dsc::conformance
