#pragma once
// Plots of figures: small SVGs whose bytes are always the same, readable in print.

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace dsc::report {

/// y over x; a pair with NaN, or without a positive y on a logarithmic axis, is a gap.
struct Curve {
    std::string name;
    std::vector<double> x;
    std::vector<double> y;
    std::optional<std::size_t> run{};   ///< number of the run that a page can show or hide
    std::optional<std::size_t> slot{};  ///< its colour if it is shown; empty: it is hidden at first
};

struct Plot {
    std::string title;
    std::string x_label;
    std::vector<Curve> curves;  ///< up to 8 colours, then they repeat
    bool logarithmic = false;   ///< the y axis
    bool from_zero = false;     ///< the y axis begins at 0
    std::size_t points = 1200;  ///< a curve with more points is thinned to about this many
};

/// Number of curves with colours of their own.
inline constexpr std::size_t most_colours = 8;

/// Empty if no curve has two points. The axes have room for all curves, also for hidden ones.
std::string svg_plot(const Plot& plot);

/// Number of values in each of equal parts of [low, high]; values outside count for the nearest
/// part.
std::vector<std::size_t> count_bins(const std::vector<double>& values, double low, double high,
                                    std::size_t bins);

/// Bars over equal parts of [low, high].
std::string svg_histogram(const std::string& title, const std::string& x_label, double low,
                          double high, const std::vector<std::size_t>& counts);

/// Parts of a whole as one bar with a legend.
std::string svg_shares(const std::vector<std::pair<std::string, double>>& parts,
                       const std::string& unit);

/// Round numbers of an axis for [low, high], at most about `count`.
std::vector<double> axis_ticks(double low, double high, int count);

}  // namespace dsc::report
