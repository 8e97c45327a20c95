// XYZ, CSV and similar formats: one point per line. Own reader, because PCL's reader rounds every
// coordinate to float.
#include <algorithm>
#include <array>
#include <limits>
#include <optional>

#include <fmt/core.h>

#include <dsc/base/byte_order_mark.hpp>
#include <dsc/base/error.hpp>
#include <dsc/text/numbers.hpp>
#include <dsc/text/reading.hpp>
#include <dsc/text/words.hpp>

#include "attributes.hpp"
#include "columns.hpp"
#include "formats.hpp"

namespace dsc::cloud {

namespace {

/// A block of points that a count line announced.
struct Announced {
    bool any = false;
    std::size_t line = 0;
    std::size_t count = 0;
    std::size_t first = 0;  ///< number of points before it
};

class TableReader {
public:
    TableReader(const std::string& file, std::string_view text, const ReadOptions& options)
        : file_(file), lines_(text, file), choice_(file, options) {}

    Cloud read() {
        for (std::string_view whole; lines_.next(whole);) {
            const std::string_view line = text::trim(whole);
            if (line.empty()) continue;
            if (const std::size_t mark = comment_mark(line); mark > 0) {
                comment(line.substr(mark));
                continue;
            }
            refuse_decimal_commas(line);
            const char separator = separator_for(line);
            // a tab may end an empty column
            split_columns(separator == '\t' ? whole : line, separator, words_);
            if (count_line(line)) continue;
            if (cloud_.points.empty() && take_names()) continue;
            point();
        }
        check_announced();
        if (cloud_.points.empty()) no_points(file_, "a text cloud has one line 'x y z' per point");
        finish_colours();
        finish_normals();
        names_ = find_names();
        return std::move(cloud_);
    }

    /// The names of the columns, from a header or by what they were taken for; empty if they have
    /// no names.
    const std::vector<std::string>& names() const { return names_; }

private:
    std::vector<std::string> find_names() const {
        if (!header_.empty()) return header_;
        if (!comment_.empty() && comment_.size() == previous_) return comment_;
        if (choice_.chosen()) return {};
        std::vector<std::string> out = {"x", "y", "z"};
        for (std::size_t first = 3; first < previous_; first += 3) {
            const std::size_t triple = first / 3 - 1;
            if (triple < guesses_.size() && !cloud_.colours.empty() &&
                guesses_[triple].colour(cloud_.points.size()))
                out.insert(out.end(), {"red", "green", "blue"});
            else if (triple < guesses_.size() && !cloud_.normals.empty() &&
                     guesses_[triple].normal(cloud_.points.size()))
                out.insert(out.end(), {"nx", "ny", "nz"});
            else
                for (std::size_t column = first; column < std::min(first + 3, previous_); ++column)
                    out.push_back("column " + std::to_string(column + 1));
        }
        return out;
    }

    /// Three columns without names, and in how many lines they can be colours or normals.
    struct Guess {
        std::vector<Vec3> values;
        std::size_t bytes = 0, units = 0;
        double largest = 0.0;
        /// Unit normals along the axes are also integers, so a colour must have a number above 1.
        bool colour(std::size_t points) const { return bytes == points && largest > 1.0; }
        bool normal(std::size_t points) const { return units == points; }
    };

    [[noreturn]] void syntax(const std::string& cause, std::string_view remedy) const {
        text::fail("io.syntax", lines_.place(), cause, remedy);
    }

    static std::size_t comment_mark(std::string_view line) {
        if (line.front() == '#') return std::min(line.find_first_not_of('#'), line.size());
        return line.substr(0, 2) == "//" ? 2 : 0;
    }

    /// Decimal commas between blanks, tabs or commas would be read as separators. With a semicolon
    /// or quotes a number stays in one piece and is refused. In columns that are also divided by
    /// commas, there are twice as many columns as it seems; a fraction that begins with 0
    /// distinguishes them from integers.
    void refuse_decimal_commas(std::string_view line) const {
        if (line.find(',') == std::string_view::npos ||
            line.find_first_of(";\"") != std::string_view::npos)
            return;
        std::string_view rest = line, decimal;
        for (int k = 0; k < 3; ++k) {
            std::string_view word = text::next_word(rest);
            if (!word.empty() && word.back() == ',') word.remove_suffix(1);
            double value = 0.0;
            if (text::has_decimal_comma(word)) {
                if (decimal.empty()) decimal = word;
            } else if (text::parse_number(word, value) != text::Number::ok) {
                constexpr std::size_t looked_at = 1000;
                return cloud_.points.size() < looked_at ? refuse_split_decimals(line) : void();
            }
        }
        if (!decimal.empty()) not_a_number(decimal, lines_.place(), "");
    }

    void refuse_split_decimals(std::string_view line) const {
        std::vector<std::string> words;
        split_columns(line, ',', words);
        if (choice_.named() || words.size() < 6 || words.size() % 2 != 0) return;
        const auto whole = [](std::string_view word) {
            return !word.empty() && word.find_first_not_of("0123456789") == std::string_view::npos;
        };
        for (std::size_t k = 0; k + 1 < words.size(); k += 2) {
            const std::string_view before = words[k];
            const std::size_t sign = before.find_first_of("+-") == 0 ? 1 : 0;
            if (!whole(before.substr(sign)) || !whole(words[k + 1])) return;
        }
        for (const std::size_t k : {std::size_t{1}, std::size_t{3}}) {
            if (words[k].size() > 1 && words[k].front() == '0') {
                not_a_number(words[k - 1] + "," + words[k], lines_.place(), "");
            }
        }
    }

    /// The names of the columns may be in a comment above the points.
    void comment(std::string_view text) {
        if (!cloud_.points.empty()) return;
        text = text::trim(text);
        split_columns(text, separator_of(text, choice_.chosen()), words_);
        if (choice_.knows(words_)) comment_ = words_;
    }

    /// Before the first point: decides the names of the columns. True for a header, which is not a
    /// point. Words are names of columns only if there are as many words as columns, because other
    /// text may also contain x y z.
    bool take_names() {
        const std::vector<std::string>& above = header_.empty() ? comment_ : header_;
        if (!above.empty() && above.size() == words_.size())
            choice_.take_names(above, header_.empty());
        if (header_.empty() && is_header()) {
            header_ = words_;
            drop_units();
            choice_.require_names(header_, lines_.number());
            return true;
        }
        const bool unfit = !header_.empty() && !choice_.chosen() && header_.size() != words_.size();
        if (choice_.wants_names() || unfit)
            syntax(fmt::format("the header has {}, the line {}",
                               text::counted(header_.size(), "column"), words_.size()),
                   words_.size() == 2 * header_.size() ? decimal_comma_remedy
                                                       : "choose columns by their numbers from 1");
        return false;
    }

    /// Between blanks, the unit of a column is a separate word and not a name: X [m] Y [m] Z [m].
    void drop_units() {
        const auto is_unit = [](const std::string& word) {
            return word.size() > 1 && ((word.front() == '[' && word.back() == ']') ||
                                       (word.front() == '(' && word.back() == ')'));
        };
        header_.erase(std::remove_if(header_.begin(), header_.end(), is_unit), header_.end());
    }

    /// If columns were chosen, the separator of the first line is used for all lines, because text
    /// columns may contain others.
    char separator_for(std::string_view line) {
        if (!choice_.chosen()) return separator_of(line, false);
        if (!separator_) separator_ = separator_of(line, true);
        return *separator_;
    }

    bool count_line(std::string_view line) {
        std::size_t count = 0;
        const bool block_full = cloud_.points.empty() ||
                                (block_.any && cloud_.points.size() - block_.first == block_.count);
        if (words_.size() != 1 || !block_full || !text::parse_count(line, count)) return false;
        check_announced();
        block_ = {true, lines_.number(), count, cloud_.points.size()};
        separator_.reset();
        return true;
    }

    void check_announced() const {
        const std::size_t got = cloud_.points.size() - block_.first;
        if (!block_.any || got == block_.count) return;
        throw IoError(
            got < block_.count ? "io.truncated" : "io.syntax", file_, std::to_string(block_.line),
            fmt::format("the count line announces {}, the file has {}",
                        text::counted(block_.count, "point"), got),
            got < block_.count ? "the file is cut off, write it again" : "correct the count");
    }

    std::string_view word(std::size_t column) const {
        return column < words_.size() ? std::string_view(words_[column]) : std::string_view();
    }

    bool is_header() const {
        if (choice_.wants_names()) return true;  // the names must exist
        double value = 0.0;
        const std::string_view first = word(choice_.coordinates()[0]);
        return text::parse_number(first, value) == text::Number::not_a_number &&
               !text::has_decimal_comma(first);
    }

    void point() {
        const std::array<std::size_t, 3>& columns = choice_.coordinates();
        const bool cut = !lines_.terminated() && words_.size() < previous_;
        const std::size_t last = *std::max_element(columns.begin(), columns.end());
        if (words_.size() <= last || cut)
            syntax("the line has " + text::counted(words_.size(), "column") +
                       (words_.size() <= last ? choice_.of_needed(last)
                                              : ", the previous one has more"),
                   "a point needs x, y and z, separated by blanks, commas or semicolons; the file "
                   "may be cut off");
        Vec3 point;
        for (int k = 0; k < 3; ++k) {
            const std::size_t column = columns[static_cast<std::size_t>(k)];
            if (word(column).empty())
                syntax(fmt::format("column {} is empty", column + 1), "a point needs x, y and z");
            point[k] = coordinate(word(column), lines_.place());
        }
        cloud_.points.push_back(point);
        previous_ = words_.size();
        if (choice_.normals()) named_normal(*choice_.normals());
        if (choice_.intensity()) named_intensity(*choice_.intensity());
        if (choice_.colours())
            named_colour(*choice_.colours());
        else
            guess();
    }

    /// For columns with names, or chosen ones; only chosen columns must contain a colour in every
    /// line.
    void named_colour(const std::array<std::size_t, 3>& columns) {
        Vec3 colour;
        for (int k = 0; k < 3; ++k) {
            const std::string_view text = word(columns[static_cast<std::size_t>(k)]);
            if (text::parse_number(text, colour[k]) == text::Number::ok && colour[k] >= 0.0) {
                whole_ = whole_ && text.find_first_not_of("+0123456789") == std::string_view::npos;
                continue;
            }
            if (choice_.chosen())
                syntax("colour " + text::in_quotes(text) + " is not a number of at least 0",
                       "choose three columns of coordinates only, or correct the line");
            return;
        }
        colours_.push_back(colour);
    }

    /// Zero, without a direction, if a line has no normal.
    void named_normal(const std::array<std::size_t, 3>& columns) {
        Vec3 normal = Vec3::Zero();
        bool whole = true;
        for (int k = 0; k < 3; ++k)
            whole = text::parse_number(word(columns[static_cast<std::size_t>(k)]), normal[k]) ==
                        text::Number::ok &&
                    whole;
        cloud_.normals.push_back(whole ? direction_of(normal) : Vec3(Vec3::Zero()));
    }

    void named_intensity(std::size_t column) {
        double value = 0.0;
        if (text::parse_number(word(column), value) == text::Number::ok)
            intensities_.push_back(value);
    }

    /// Without names: columns 4 to 6 of six, and 7 to 9 of nine.
    void guess() {
        if (!header_.empty() || choice_.chosen() || choice_.named() ||
            (words_.size() != 6 && words_.size() != 9))
            return;
        for (std::size_t triple = 0; 3 * triple + 3 < words_.size(); ++triple) {
            Guess& guess = guesses_[triple];
            Vec3 values = Vec3::Zero();
            bool bytes = true;
            for (std::size_t k = 0; k < 3; ++k) {
                const std::string& text = words_[3 * triple + 3 + k];
                std::size_t count = 0;
                bytes = bytes && text::parse_count(text, count) && count <= 255;
                if (text::parse_number(text, values[static_cast<int>(k)]) != text::Number::ok)
                    values = Vec3::Constant(infinite);
            }
            guess.bytes += bytes ? 1U : 0U;
            guess.units += looks_like_unit(values) ? 1U : 0U;
            guess.largest = std::max(guess.largest, values.maxCoeff());
            guess.values.push_back(values);
        }
    }

    void finish_colours() {
        if (!colours_.empty() && colours_.size() == cloud_.points.size())
            cloud_.colours = colours_from(colours_, whole_);
        if (!choice_.colours() && intensities_.size() == cloud_.points.size())
            cloud_.colours = greys_from(intensities_);
        for (const Guess& guess : guesses_)
            if (cloud_.colours.empty() && guess.colour(cloud_.points.size()))
                cloud_.colours = colours_from(guess.values, true);
    }

    void finish_normals() {
        for (const Guess& guess : guesses_) {
            if (!cloud_.normals.empty() || !guess.normal(cloud_.points.size())) continue;
            for (const Vec3& value : guess.values) cloud_.normals.push_back(direction_of(value));
        }
        keep_whole_normals(cloud_);
    }

    static constexpr double infinite = std::numeric_limits<double>::infinity();

    const std::string& file_;
    text::Lines lines_;
    ColumnChoice choice_;
    Cloud cloud_;
    Announced block_;
    std::vector<std::string> words_;    ///< of the line
    std::vector<std::string> comment_;  ///< the last one that contains the names
    std::vector<std::string> header_;   ///< empty if there is no header
    std::optional<char> separator_;     ///< of chosen columns
    std::vector<Vec3> colours_;
    std::vector<double> intensities_;
    std::array<Guess, 2> guesses_;
    std::vector<std::string> names_;
    std::size_t previous_ = 0;  ///< number of columns of the previous point
    bool whole_ = true;         ///< no colour has a fraction
};

}  // namespace

Cloud read_table(const std::string& file, std::string_view text, const ReadOptions& options,
                 std::vector<std::string>& names) {
    TableReader reader(file, text, options);
    Cloud cloud = reader.read();
    names = reader.names();
    return cloud;
}

}  // namespace dsc::cloud
