#pragma once
// Reads a plugin's entry from the library's file, so that the gate decides before any code of the
// library runs, including its static constructors and the start-up code of a sanitizer that the
// host lacks.

#include <filesystem>
#include <string>

#include <dsc/plugin/entry.hpp>

namespace dsc::host {

/// The plain part of the entry. `enroll` is an address in the file and must not be used.
struct EntryBytes {
    plugin::PluginEntry entry{};
    std::size_t available = 0;  ///< size of the symbol in bytes; entries of other layouts may be
                                ///< shorter
};

/// Throws PluginError "plugin.open", "plugin.not_elf", "plugin.no_entry".
EntryBytes read_entry(const std::filesystem::path& file);

/// Checks magic, ABI, size and fingerprint, in this order, since another ABI explains another size.
/// Throws PluginError "plugin.magic", "plugin.abi", "plugin.size", "plugin.fingerprint".
void require_fitting(const EntryBytes& bytes, const std::filesystem::path& file);

/// The text up to its zero byte, never beyond the array.
template <std::size_t N>
std::string text_of(const char (&text)[N]) {
    std::size_t length = 0;
    while (length < N && text[length] != '\0') ++length;
    return {text, length};
}

/// Throws PluginError "FILE: CAUSE; REMEDY".
[[noreturn]] void refuse(const std::filesystem::path& file, std::string code,
                         const std::string& cause, const std::string& remedy);

}  // namespace dsc::host
