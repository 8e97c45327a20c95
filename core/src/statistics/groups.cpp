// Identities of runs, their groups and pairs.
#include "dsc/statistics/groups.hpp"

#include <algorithm>
#include <map>

namespace dsc::statistics {
namespace {

bool is_or_below(const std::string& path, const std::string& key) {
    return path == key || path.rfind(key + ".", 0) == 0;
}

}  // namespace

bool is_data_key(const std::string& path) {
    if (path == "input" || path == "truth") return true;
    return is_or_below(path, "input.cloud") && !is_or_below(path, "input.cloud.filters");
}

Identity identity_of(std::span<const KeyValue> values) {
    std::vector<KeyValue> sorted(values.begin(), values.end());
    std::sort(sorted.begin(), sorted.end());
    Identity identity;
    for (const auto& [path, value] : sorted) {
        if (path == "seed") {
            identity.seed = value;
            continue;
        }
        std::string& text = is_data_key(path) ? identity.data : identity.setting;
        text += path + "=" + value + "\n";
    }
    return identity;
}

std::vector<Group> group_runs(std::span<const Identity> runs) {
    std::vector<Group> groups;
    std::map<std::pair<std::string, std::string>, std::size_t> places;
    std::map<std::string, std::size_t> settings;
    for (std::size_t i = 0; i < runs.size(); ++i) {
        const std::size_t setting =
            settings.try_emplace(runs[i].setting, settings.size()).first->second;
        const auto [place, fresh] =
            places.try_emplace({runs[i].setting, runs[i].data}, groups.size());
        if (fresh) groups.push_back({{}, setting});
        groups[place->second].runs.push_back(i);
    }
    return groups;
}

std::vector<std::pair<std::size_t, std::size_t>> pair_runs(std::span<const Identity> runs,
                                                           const std::string& first,
                                                           const std::string& second) {
    std::map<std::pair<std::string, std::string>, std::size_t> partners;
    for (std::size_t i = 0; i < runs.size(); ++i) {
        if (runs[i].setting == second) partners.try_emplace({runs[i].data, runs[i].seed}, i);
    }
    std::vector<std::pair<std::size_t, std::size_t>> pairs;
    for (std::size_t i = 0; i < runs.size(); ++i) {
        if (runs[i].setting != first) continue;
        const auto partner = partners.find({runs[i].data, runs[i].seed});
        if (partner == partners.end()) continue;
        pairs.emplace_back(i, partner->second);
        partners.erase(partner);
    }
    return pairs;
}

}  // namespace dsc::statistics
