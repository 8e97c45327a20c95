#pragma once
// The entry of a plugin: one constant of plain bytes that the host reads before any code of the
// plugin runs.

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string_view>

#include <dsc/plugin/fingerprint.hpp>

#define DSC_PLUGIN_EXPORT __attribute__((visibility("default")))

namespace dsc::plugin {

class Registrar;

/// "DSC1" read as a little-endian number.
inline constexpr std::uint32_t entry_magic = 0x31435344U;
/// Name of the symbol that every plugin exports.
inline constexpr const char* entry_symbol = "dsc_plugin_entry";

/// What a plugin declares about itself. Texts are stored inside the struct and end with a zero
/// byte, so that the host can read everything except `enroll` from the file without loading it.
struct PluginEntry {
    std::uint32_t magic;        ///< entry_magic
    std::uint32_t struct_size;  ///< sizeof(PluginEntry) in the plugin's build
    std::uint16_t abi_major;
    std::uint16_t abi_minor;
    std::uint32_t reserved;  ///< 0
    char fingerprint[256];
    char name[64];
    char version[32];
    char license[64];
    char summary[256];
    char authors[128];           ///< may be empty
    void (*enroll)(Registrar&);  ///< registers the strategies; may throw
};

namespace detail {
template <std::size_t N>
constexpr void set_text(char (&to)[N], std::string_view text) {
    if (text.size() >= N) throw std::length_error("a text of DSC_PLUGIN is too long");
    for (std::size_t i = 0; i < text.size(); ++i) to[i] = text[i];
}
}  // namespace detail

/// The entry for the calling translation unit; used by DSC_PLUGIN.
constexpr PluginEntry make_entry(void (*enroll)(Registrar&), std::string_view name,
                                 std::string_view version, std::string_view license,
                                 std::string_view summary, std::string_view authors = {}) {
    PluginEntry entry{};
    entry.magic = entry_magic;
    entry.struct_size = sizeof(PluginEntry);
    entry.abi_major = DSC_ABI_MAJOR;
    entry.abi_minor = DSC_ABI_MINOR;
    detail::set_text(entry.fingerprint, DSC_FINGERPRINT);
    detail::set_text(entry.name, name);
    detail::set_text(entry.version, version);
    detail::set_text(entry.license, license);
    detail::set_text(entry.summary, summary);
    detail::set_text(entry.authors, authors);
    entry.enroll = enroll;
    return entry;
}

}  // namespace dsc::plugin

extern "C" DSC_PLUGIN_EXPORT const dsc::plugin::PluginEntry dsc_plugin_entry;

/// Makes a library a plugin. Write it once per library, outside all namespaces. The name is
/// [a-z][a-z0-9_]*, the library is libdsc_NAME.so.
///
/// ```
/// DSC_PLUGIN("my_flow", "1.0.0", "MIT", "what it is for", "its authors, optional") {
///     registrar.add<MyFlow>("my_flow", "what the strategy does");
/// }
/// ```
#define DSC_PLUGIN(...)                                                 \
    static void dsc_plugin_enroll(::dsc::plugin::Registrar& registrar); \
    constinit const ::dsc::plugin::PluginEntry dsc_plugin_entry =       \
        ::dsc::plugin::make_entry(&dsc_plugin_enroll, __VA_ARGS__);     \
    static void dsc_plugin_enroll([[maybe_unused]] ::dsc::plugin::Registrar& registrar)
