#include "entry_file.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <optional>
#include <string_view>
#include <type_traits>
#include <vector>

#include <elf.h>

#include <fmt/format.h>

#include <dsc/base/error.hpp>

namespace dsc::host {
namespace {

static_assert(sizeof(void*) == 8, "the reader supports 64-bit ELF files only");

// The bytes of a file; every read is checked, because the file may contain anything.
class Bytes {
public:
    explicit Bytes(std::vector<char> data) : data_(std::move(data)) {}

    template <class T>
    std::optional<T> read(std::uint64_t offset) const {
        static_assert(std::is_trivially_copyable_v<T>);
        if (offset > data_.size() || data_.size() - offset < sizeof(T)) return std::nullopt;
        T value;
        std::memcpy(&value, data_.data() + offset, sizeof(T));
        return value;
    }

    // Reads up to `size` bytes into `to`; returns the number read.
    std::size_t copy(std::uint64_t offset, std::size_t size, void* to) const {
        if (offset >= data_.size()) return 0;
        const std::size_t count =
            std::min<std::size_t>(size, data_.size() - static_cast<std::size_t>(offset));
        std::memcpy(to, data_.data() + offset, count);
        return count;
    }

    bool holds(std::uint64_t offset, std::uint64_t size) const {
        return offset <= data_.size() && size <= data_.size() - offset;
    }

    // Whether this zero-terminated text is at the offset.
    bool text_equals(std::uint64_t offset, std::string_view text) const {
        if (offset > data_.size() || data_.size() - offset < text.size() + 1) return false;
        return std::memcmp(data_.data() + offset, text.data(), text.size()) == 0 &&
               data_[offset + text.size()] == '\0';
    }

private:
    std::vector<char> data_;
};

Bytes load_bytes(const std::filesystem::path& file) {
    std::error_code error;
    if (std::filesystem::is_directory(file, error)) {
        refuse(file, "plugin.open", "is a folder, not a library",
               "give the file libdsc_NAME.so in it");
    }
    std::ifstream in(file, std::ios::binary);
    if (!in) {
        refuse(file, "plugin.open", fmt::format("cannot be read ({})", std::strerror(errno)),
               "check its name and permissions");
    }
    std::vector<char> data;
    constexpr std::size_t chunk = std::size_t{1} << 18U;
    while (in) {
        const std::size_t size = data.size();
        data.resize(size + chunk);
        in.read(data.data() + size, static_cast<std::streamsize>(chunk));
        data.resize(size + static_cast<std::size_t>(in.gcount()));
    }
    if (in.bad()) refuse(file, "plugin.open", "cannot be read completely", "check its disk");
    return Bytes(std::move(data));
}

[[noreturn]] void damaged(const std::filesystem::path& file) {
    refuse(file, "plugin.not_elf", "is a damaged or truncated shared library",
           "build or copy it again");
}

Elf64_Ehdr require_library(const Bytes& bytes, const std::filesystem::path& file) {
    const auto header = bytes.read<Elf64_Ehdr>(0);
    if (!header || std::memcmp(header->e_ident, ELFMAG, SELFMAG) != 0) {
        refuse(file, "plugin.not_elf", "is not a shared library",
               "give the file of a plugin, libdsc_NAME.so");
    }
    if (header->e_ident[EI_CLASS] != ELFCLASS64 || header->e_ident[EI_DATA] != ELFDATA2LSB ||
        header->e_type != ET_DYN) {
        refuse(file, "plugin.not_elf", "is not a shared library for this machine",
               "build it on this machine");
    }
    // The dynamic linker maps the segments without checking that the file is long enough, and would
    // crash.
    bool whole = header->e_shentsize == sizeof(Elf64_Shdr) &&
                 header->e_phentsize == sizeof(Elf64_Phdr) &&
                 bytes.holds(header->e_shoff, std::uint64_t{header->e_shnum} * sizeof(Elf64_Shdr));
    for (std::uint64_t i = 0; whole && i < header->e_phnum; ++i) {
        const auto segment = bytes.read<Elf64_Phdr>(header->e_phoff + i * sizeof(Elf64_Phdr));
        whole = segment &&
                (segment->p_type != PT_LOAD || bytes.holds(segment->p_offset, segment->p_filesz));
    }
    if (!whole) damaged(file);
    return *header;
}

// The offset in the file of a virtual address.
std::optional<std::uint64_t> file_offset(const Bytes& bytes, const Elf64_Ehdr& header,
                                         std::uint64_t address) {
    for (std::uint64_t i = 0; i < header.e_phnum; ++i) {
        const auto segment = bytes.read<Elf64_Phdr>(header.e_phoff + i * sizeof(Elf64_Phdr));
        if (!segment) return std::nullopt;
        if (segment->p_type != PT_LOAD || address < segment->p_vaddr) continue;
        if (address - segment->p_vaddr < segment->p_filesz)
            return segment->p_offset + (address - segment->p_vaddr);
    }
    return std::nullopt;
}

// Finds the symbol in the table of dynamic symbols; empty if there is none. Fails if the table
// extends beyond the file.
std::optional<Elf64_Sym> find_symbol(const Bytes& bytes, const Elf64_Ehdr& header,
                                     std::string_view name, const std::filesystem::path& file) {
    for (std::uint64_t i = 0; i < header.e_shnum; ++i) {
        const auto section = bytes.read<Elf64_Shdr>(header.e_shoff + i * sizeof(Elf64_Shdr));
        if (!section) damaged(file);
        if (section->sh_type != SHT_DYNSYM) continue;
        const auto names =
            bytes.read<Elf64_Shdr>(header.e_shoff + section->sh_link * sizeof(Elf64_Shdr));
        if (!names) damaged(file);
        for (std::uint64_t k = 0; k < section->sh_size / sizeof(Elf64_Sym); ++k) {
            const auto symbol = bytes.read<Elf64_Sym>(section->sh_offset + k * sizeof(Elf64_Sym));
            if (!symbol) damaged(file);
            if (symbol->st_shndx != SHN_UNDEF &&
                bytes.text_equals(names->sh_offset + symbol->st_name, name))
                return symbol;
        }
    }
    return std::nullopt;
}

std::string version_text(unsigned major, unsigned minor) {
    return fmt::format("{}.{}", major, minor);
}

void require_same_build(const plugin::PluginEntry& entry, const std::filesystem::path& file) {
    const std::string theirs = text_of(entry.fingerprint);
    const std::string ours(plugin::core_fingerprint());
    std::string cause;
    for (const auto& difference : plugin::compare_fingerprints(theirs, ours)) {
        if (!difference.hard) continue;
        cause += cause.empty() ? "was built differently from this dsc: " : ", ";
        cause += fmt::format("{} is '{}' in the plugin and '{}' in dsc", difference.key,
                             difference.plugin, difference.host);
    }
    if (cause.empty()) return;
    refuse(file, "plugin.fingerprint", cause,
           fmt::format("build it with dsc_add_plugin and the compiler options of this dsc (-march "
                       "and -mavx change align)\n  plugin: {}\n  dsc:    {}",
                       theirs, ours));
}

}  // namespace

void refuse(const std::filesystem::path& file, std::string code, const std::string& cause,
            const std::string& remedy) {
    throw PluginError(std::move(code), file.string(), cause, remedy);
}

EntryBytes read_entry(const std::filesystem::path& file) {
    const Bytes bytes = load_bytes(file);
    const Elf64_Ehdr header = require_library(bytes, file);
    const auto symbol = find_symbol(bytes, header, plugin::entry_symbol, file);
    if (!symbol) {
        refuse(file, "plugin.no_entry",
               fmt::format("is a library without the symbol {}", plugin::entry_symbol),
               "write one DSC_PLUGIN(...) { ... } in one source file of the plugin");
    }
    const auto offset = file_offset(bytes, header, symbol->st_value);
    if (!offset) damaged(file);
    EntryBytes result;
    const std::size_t wanted = std::min<std::size_t>(sizeof(plugin::PluginEntry), symbol->st_size);
    result.available = bytes.copy(*offset, wanted, &result.entry);
    if (result.available < wanted) damaged(file);
    return result;
}

void require_fitting(const EntryBytes& bytes, const std::filesystem::path& file) {
    const plugin::PluginEntry& entry = bytes.entry;
    if (bytes.available < offsetof(plugin::PluginEntry, fingerprint) ||
        entry.magic != plugin::entry_magic) {
        refuse(
            file, "plugin.magic",
            fmt::format("has a symbol {} that is not a valid plugin entry", plugin::entry_symbol),
            "write the entry with DSC_PLUGIN(...) { ... }, never by hand");
    }
    const std::string rebuild = "rebuild it with the headers of this dsc";
    if (entry.abi_major != DSC_ABI_MAJOR) {
        refuse(file, "plugin.abi",
               fmt::format("was built for ABI {}, this dsc has ABI {}",
                           version_text(entry.abi_major, entry.abi_minor),
                           version_text(DSC_ABI_MAJOR, DSC_ABI_MINOR)),
               rebuild);
    }
    if (entry.struct_size != sizeof(plugin::PluginEntry) ||
        bytes.available != sizeof(plugin::PluginEntry)) {
        refuse(file, "plugin.size",
               fmt::format("has an entry of {} bytes instead of the expected {} bytes",
                           entry.struct_size, sizeof(plugin::PluginEntry)),
               rebuild);
    }
    if (entry.abi_minor > DSC_ABI_MINOR) {
        refuse(file, "plugin.abi",
               fmt::format("needs ABI {}, this dsc has ABI {}",
                           version_text(entry.abi_major, entry.abi_minor),
                           version_text(DSC_ABI_MAJOR, DSC_ABI_MINOR)),
               "install a newer dsc, or rebuild the plugin with the headers of this one");
    }
    require_same_build(entry, file);
}

}  // namespace dsc::host
