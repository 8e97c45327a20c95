#pragma once
// The sortable tables of a comparison, and their data for export.

#include <string>

#include "compared.hpp"

namespace dsc::report {

/// One row per group of repeats: n, and mean, standard deviation and confidence interval of the
/// figures; empty if no run is repeated.
std::string groups_table(const Comparison& comparison);

/// One row per run: what differs first, then the figures that differ.
std::string runs_table(const Comparison& comparison);

/// The figures that are the same for all runs, as one sentence; empty if there are none.
std::string same_figures(const Comparison& comparison);

/// The paired comparison of two settings, which the reader chooses; empty if no two settings have a
/// pair of runs.
std::string pairs_table(const Comparison& comparison);

/// JSON for compare.js: the rows of all figures and of the groups, for export as CSV, and the
/// texts of the paired comparisons.
std::string comparison_data(const Comparison& comparison);

}  // namespace dsc::report
