#pragma once
// Did-you-mean: finds the accepted word that is closest to a mistyped word.

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace dsc::config {

/// Damerau-Levenshtein distance (optimal string alignment): insertions, deletions, substitutions
/// and swaps of two neighbouring characters.
std::size_t edit_distance(std::string_view a, std::string_view b);

/// The candidate nearest to `word`: the distance is at most max(2, length / 3) and less than the
/// length of the word; of equal distances the first. Empty if no candidate is near.
std::optional<std::string> closest(std::string_view word,
                                   const std::vector<std::string>& candidates);

/// "did you mean 'NAME'? " with the closest candidate, as the beginning of a remedy; empty if no
/// candidate is near.
std::string did_you_mean(std::string_view word, const std::vector<std::string>& candidates);

/// "a, b, c".
std::string join(const std::vector<std::string>& words, std::string_view separator = ", ");

}  // namespace dsc::config
