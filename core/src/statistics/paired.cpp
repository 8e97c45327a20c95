// The signed-rank test and the sign test.
#include "dsc/statistics/paired.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include <boost/math/distributions/binomial.hpp>
#include <boost/math/distributions/normal.hpp>

#include <dsc/base/error.hpp>

namespace dsc::statistics {
namespace {

/// Twice the rank of each value among the magnitudes: equal ones share the mean of their ranks, so
/// that twice the rank is an integer.
std::vector<std::size_t> doubled_ranks(const std::vector<double>& values) {
    const auto before = [&](std::size_t a, std::size_t b) {
        return std::abs(values[a]) < std::abs(values[b]);
    };
    std::vector<std::size_t> order(values.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(), before);
    std::vector<std::size_t> ranks(values.size());
    for (std::size_t begin = 0; begin < order.size();) {
        std::size_t end = begin + 1;
        while (end < order.size() && !before(order[begin], order[end])) ++end;
        for (std::size_t i = begin; i < end; ++i) ranks[order[i]] = begin + 1 + end;
        begin = end;
    }
    return ranks;
}

/// Part of all signs for which the doubled ranks with a positive sign sum to at most `most`.
double exact_tail(const std::vector<std::size_t>& ranks, std::size_t most) {
    std::vector<double> ways(most + 1, 0.0);  // below 2^25, so the counts are exact
    ways[0] = 1.0;
    for (const std::size_t rank : ranks) {
        for (std::size_t sum = most + 1; sum-- > rank;) ways[sum] += ways[sum - rank];
    }
    return std::accumulate(ways.begin(), ways.end(), 0.0) /
           std::ldexp(1.0, static_cast<int>(ranks.size()));
}

/// Two-sided probability by the normal approximation.
double approximate(const std::vector<std::size_t>& ranks, double statistic) {
    const auto n = static_cast<double>(ranks.size());
    const double mean = n * (n + 1.0) / 4.0;
    // The sum of the squared ranks includes the correction for equal ranks.
    double squares = 0.0;
    for (const std::size_t rank : ranks)
        squares += 0.25 * static_cast<double>(rank) * static_cast<double>(rank);
    const double z = std::min(0.0, statistic - mean + 0.5) / std::sqrt(squares / 4.0);
    return std::min(1.0, 2.0 * boost::math::cdf(boost::math::normal(), z));
}

}  // namespace

SignedRank signed_rank(std::span<const double> differences) {
    std::vector<double> values;
    for (const double value : differences) {
        if (value != 0.0 && !std::isnan(value)) values.push_back(value);
    }
    SignedRank result;
    result.n = values.size();
    if (values.empty()) return result;
    const std::vector<std::size_t> ranks = doubled_ranks(values);
    std::size_t positive = 0, negative = 0;
    for (std::size_t i = 0; i < values.size(); ++i)
        (values[i] > 0.0 ? positive : negative) += ranks[i];
    const std::size_t smaller = std::min(positive, negative);
    result.statistic = 0.5 * static_cast<double>(smaller);
    result.exact = values.size() <= most_exact;
    result.probability = result.exact ? std::min(1.0, 2.0 * exact_tail(ranks, smaller))
                                      : approximate(ranks, result.statistic);
    return result;
}

Signs sign_test(std::span<const double> differences) {
    Signs signs;
    for (const double value : differences) {
        signs.positive += value > 0.0 ? 1U : 0U;
        signs.negative += value < 0.0 ? 1U : 0U;
        signs.zero += value == 0.0 ? 1U : 0U;
    }
    const std::size_t n = signs.positive + signs.negative;
    if (n == 0) return signs;
    const boost::math::binomial distribution(static_cast<double>(n), 0.5);
    const auto fewer = static_cast<double>(std::min(signs.positive, signs.negative));
    signs.probability = std::min(1.0, 2.0 * boost::math::cdf(distribution, fewer));
    return signs;
}

PairedComparison compare_pairs(std::span<const double> first, std::span<const double> second) {
    if (first.size() != second.size())
        throw UsageError("statistics.pairs", "paired comparison",
                         "the two settings have different numbers of values",
                         "give one value of each setting for every pair");
    std::vector<double> a, b, difference;
    for (std::size_t i = 0; i < first.size(); ++i) {
        if (std::isnan(first[i]) || std::isnan(second[i])) continue;
        a.push_back(first[i]);
        b.push_back(second[i]);
        difference.push_back(second[i] - first[i]);
    }
    return {summarise(a), summarise(b), summarise(difference), signed_rank(difference),
            sign_test(difference)};
}

}  // namespace dsc::statistics
