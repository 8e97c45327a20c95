#pragma once
// The columns of a text cloud: how a line is divided, and what the columns contain.

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <dsc/cloud/read.hpp>

namespace dsc::cloud {

/// How the columns of a line are divided: ';', ',', with `tabs` '\t', or ' ' for blanks and tabs.
/// Commas do not divide a line with a semicolon, and blanks do not divide a line with a comma, so
/// that decimal commas are refused and not read as two columns. Text in double quotes is ignored.
char separator_of(std::string_view line, bool tabs);

/// The columns of a line, without their quotes. A separator at the end of the line starts no
/// column.
void split_columns(std::string_view line, char separator, std::vector<std::string>& columns);

/// Decides which columns, counted from 0, are read: those that the caller chose, those that a
/// header names, or the first three.
class ColumnChoice {
public:
    /// Throws IoError "io.columns" for a column 0 and for a column that is chosen twice.
    ColumnChoice(const std::string& file, const ReadOptions& options);

    /// Whether the caller chose columns.
    bool chosen() const { return !options_.columns.empty(); }
    /// Whether the caller chose by names that were not found yet.
    bool wants_names() const { return wants_names_; }
    /// Whether the names of a header decided.
    bool named() const { return named_; }
    const std::array<std::size_t, 3>& coordinates() const { return coordinates_; }
    const std::optional<std::array<std::size_t, 3>>& colours() const { return colours_; }
    const std::optional<std::array<std::size_t, 3>>& normals() const { return normals_; }
    const std::optional<std::size_t>& intensity() const { return intensity_; }

    /// Whether the words contain all necessary names: the chosen ones, else x, y and z.
    bool knows(const std::vector<std::string>& words) const;
    /// Uses the columns with these names if they contain what is needed. In a comment only x, y and
    /// z themselves are recognised, in a header also the usual names for them.
    void take_names(const std::vector<std::string>& names, bool comment);
    /// Throws IoError "io.columns" if the header in that line lacks a chosen name or, without a
    /// choice, all usual names of a coordinate.
    void require_names(const std::vector<std::string>& header, std::size_t line) const;

    /// Part of a message about a line that ends before column `last`.
    std::string of_needed(std::size_t last) const;

private:
    void take(const std::vector<std::size_t>& columns);
    /// The chosen columns; `missing` receives the first name that was not found.
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
