// The fingerprint of this build, and the comparison of two fingerprints.
#include "dsc/plugin/fingerprint.hpp"

#include <algorithm>
#include <array>
#include <type_traits>

#include <dsc/plugin/entry.hpp>

namespace dsc::plugin {

static_assert(std::is_trivially_copyable_v<PluginEntry> && std::is_standard_layout_v<PluginEntry>,
              "the host copies the entry out of a file");
static_assert(sizeof(DSC_FINGERPRINT) <= sizeof(PluginEntry::fingerprint));

namespace {

struct Pair {
    std::string_view key;
    std::string_view value;
};

std::vector<Pair> parse(std::string_view text) {
    std::vector<Pair> pairs;
    while (!text.empty()) {
        const std::string_view item = text.substr(0, text.find(';'));
        text.remove_prefix(std::min(text.size(), item.size() + 1));
        const std::size_t equals = item.find('=');
        if (item.empty()) continue;
        pairs.push_back({item.substr(0, equals), equals == std::string_view::npos
                                                     ? std::string_view{}
                                                     : item.substr(equals + 1)});
    }
    return pairs;
}

const Pair* find(const std::vector<Pair>& pairs, std::string_view key) {
    const auto found =
        std::find_if(pairs.begin(), pairs.end(), [key](const Pair& p) { return p.key == key; });
    return found == pairs.end() ? nullptr : &*found;
}

bool is_hard(std::string_view key) {
    constexpr std::array<std::string_view, 8> hard = {"abi_major", "cxx11abi", "eigen",  "align",
                                                      "real",      "index",    "dbgstl", "san"};
    return std::find(hard.begin(), hard.end(), key) != hard.end();
}

}  // namespace

std::string_view core_fingerprint() noexcept { return DSC_FINGERPRINT; }

std::vector<FingerprintDifference> compare_fingerprints(std::string_view plugin,
                                                        std::string_view host) {
    const std::vector<Pair> theirs = parse(plugin);
    const std::vector<Pair> ours = parse(host);
    std::vector<FingerprintDifference> differences;
    for (const Pair& own : ours) {
        const Pair* other = find(theirs, own.key);
        const std::string_view value = other == nullptr ? std::string_view{} : other->value;
        if (value == own.value) continue;
        differences.push_back(
            {std::string(own.key), std::string(value), std::string(own.value), is_hard(own.key)});
    }
    for (const Pair& other : theirs) {
        if (find(ours, other.key) != nullptr) continue;
        differences.push_back(
            {std::string(other.key), std::string(other.value), {}, is_hard(other.key)});
    }
    return differences;
}

const void* core_address() noexcept {
    // Data, not a function: the address of a function could be that of a jump table in the caller's
    // file.
    static const char inside = 0;
    return &inside;
}

}  // namespace dsc::plugin
