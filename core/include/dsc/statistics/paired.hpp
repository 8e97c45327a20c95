#pragma once
// Tests of two samples whose values belong together in pairs.

#include <cstddef>
#include <span>

#include <dsc/statistics/sample.hpp>

namespace dsc::statistics {

/// Largest number of differences for which the Wilcoxon test counts all signs.
inline constexpr std::size_t most_exact = 25;

/// Wilcoxon's signed-rank test [Wilcoxon1945], two-sided. Differences of 0 are left out, and equal
/// differences get the mean of their ranks.
struct SignedRank {
    std::size_t n = 0;         ///< number of differences that are not 0
    double statistic = 0.0;    ///< the smaller of the sums of ranks of both signs
    double probability = 1.0;  ///< of a statistic that is at most this, without an effect; 1 for n
                               ///< = 0
    bool exact = true;         ///< false: by the normal approximation
};

/// Exact for up to `most_exact` differences: all 2^n signs are counted, also for equal ranks. Above
/// that, the normal approximation with corrections for continuity and for equal ranks. [parallel]
SignedRank signed_rank(std::span<const double> differences);

/// The sign test, two-sided: the binomial distribution with probability 1/2.
struct Signs {
    std::size_t positive = 0;
    std::size_t negative = 0;
    std::size_t zero = 0;      ///< these differences are left out
    double probability = 1.0;  ///< of signs that are at least as uneven, without an effect
};

/// Exact. [parallel]
Signs sign_test(std::span<const double> differences);

/// Two settings over the same seeds and clouds.
struct PairedComparison {
    Sample first;
    Sample second;
    Sample difference;  ///< second - first; its interval is that of the paired t test
    SignedRank ranks;
    Signs signs;
};

/// Entries with the same index belong together; pairs with NaN are left out. Throws UsageError
/// "statistics.pairs" if the spans have different lengths. [parallel]
PairedComparison compare_pairs(std::span<const double> first, std::span<const double> second);

}  // namespace dsc::statistics
