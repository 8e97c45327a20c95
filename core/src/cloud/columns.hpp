#pragma once
// The columns of a text cloud: how a line is divided, and which columns hold what.

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <dsc/cloud/read.hpp>

#include "attributes.hpp"

namespace dsc::cloud {

/// How the columns of a line are divided: ';', ',', with `tabs` '\t', or ' ' for blanks and tabs. A line with a
/// semicolon keeps its commas, one with a comma its blanks, so that decimal commas are refused and not read as
/// two columns. What stands in double quotes does not count.
char separator_of(std::string_view line, bool tabs);

/// The columns of a line, without their quotes. A separator at the end of the line opens no column.
void split_columns(std::string_view line, char separator, std::vector<std::string>& columns);

/// Which columns, counted from 0, are read: as the caller chose, as a header calls them, or the first three.
class ColumnChoice {
public:
    /// Throws IoError "io.columns" for a column 0 and for one that is chosen twice.
    ColumnChoice(const std::string& file, const ReadOptions& options);

    /// Whether the caller chose.
    bool chosen() const { return !options_.columns.empty(); }
    /// Whether the caller chose by names that have not been found yet.
    bool wants_names() const { return wants_names_; }
    /// Whether names of a header decided.
    bool named() const { return named_; }
    const std::array<std::size_t, 3>& coordinates() const { return coordinates_; }
    const std::optional<std::array<std::size_t, 3>>& colours() const { return colours_; }
    const std::optional<std::array<std::size_t, 3>>& normals() const { return normals_; }
    const std::optional<std::size_t>& intensity() const { return intensity_; }

    /// Whether the words hold all names that are needed: the chosen ones, else x, y and z.
    bool knows(const std::vector<std::string>& words) const;
    /// Takes the columns of these names, if they hold what is needed. Of a comment only x, y and z themselves count, of a
    /// header the usual names for them, too.
    void take_names(const std::vector<std::string>& names, bool comment);
    /// Throws IoError "io.columns" if a chosen name is not in the header of that line, or without a choice none of the usual
    /// names of a coordinate is.
    void require_names(const std::vector<std::string>& header, std::size_t line) const;

    /// For a message about a line that ends before column `last`.
    std::string of_needed(std::size_t last) const;

private:
    void take(const std::vector<std::size_t>& columns);
    /// The chosen columns; `missing` gets the first that is not there.
    std::optional<std::vector<std::size_t>> resolve(const std::vector<std::string>& header,
                                                    std::string& missing) const;

    const std::string& file_;
    const ReadOptions& options_;
    std::array<std::size_t, 3> coordinates_{0, 1, 2};
    std::optional<std::array<std::size_t, 3>> colours_;
    std::optional<std::array<std::size_t, 3>> normals_;
    std::optional<std::size_t> intensity_;
    bool wants_names_ = false;
    bool named_ = false;
};

}  // namespace dsc::cloud
