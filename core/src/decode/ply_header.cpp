// Reads the header of a PLY file.
#include "dsc/decode/ply_header.hpp"

#include <array>
#include <utility>

#include <dsc/text/numbers.hpp>
#include <dsc/text/reading.hpp>
#include <dsc/text/words.hpp>

namespace dsc::decode::ply {
namespace {

struct TypeName {
    std::string_view name, alias;
    Type type;
};
constexpr std::array<TypeName, 8> type_names = {{{"char", "int8", Type::int8},
                                                 {"uchar", "uint8", Type::uint8},
                                                 {"short", "int16", Type::int16},
                                                 {"ushort", "uint16", Type::uint16},
                                                 {"int", "int32", Type::int32},
                                                 {"uint", "uint32", Type::uint32},
                                                 {"float", "float32", Type::float32},
                                                 {"double", "float64", Type::float64}}};

class HeaderReader {
public:
    HeaderReader(std::string_view content, std::string_view file)
        : content_(content), place_{file, 0} {}

    Header read() {
        if (next_line() != "ply")
            text::fail("io.syntax", place_, "the first line is not 'ply'",
                       "check that the file is a PLY file");
        bool format = false;
        while (true) {
            const std::string_view line = next_line();
            text::Fields fields(line);
            const std::string_view word = fields.next();
            if (word == "end_header") break;
            if (word == "format") {
                read_format(fields);
                format = true;
            } else if (word == "element") {
                read_element(fields);
            } else if (word == "property") {
                read_property(fields);
            } else if (word == "obj_info") {
                note_grid(word, fields);
            } else if (word != "comment" && !word.empty()) {
                syntax(text::in_quotes(word) + " is not an entry of a PLY header");
            }
        }
        if (!format) syntax("the header has no line 'format'");
        header_.size = at_;
        header_.lines = place_.line;
        return std::move(header_);
    }

private:
    [[noreturn]] void syntax(const std::string& cause) const {
        text::fail("io.syntax", place_, cause, text::export_again);
    }

    /// Only a line feed ends a line, because binary data may follow the header.
    std::string_view next_line() {
        const std::size_t end = content_.find('\n', at_);
        if (end == std::string_view::npos)
            text::fail("io.truncated", place_, "the PLY header has no line 'end_header'",
                       text::copy_again);
        std::string_view line = content_.substr(at_, end - at_);
        at_ = end + 1;
        ++place_.line;
        while (!line.empty() && line.back() == '\r') line.remove_suffix(1);
        return line;
    }

    void read_format(text::Fields& fields) {
        const std::string_view name = fields.next(), version = fields.next();
        if (name == "binary_little_endian")
            header_.order = std::endian::little;
        else if (name == "binary_big_endian")
            header_.order = std::endian::big;
        else if (name != "ascii")
            syntax(text::in_quotes(name) + " is not a PLY format; supported are ascii, "
                                           "binary_little_endian and binary_big_endian");
        if (version != "1.0")
            syntax("PLY version " + text::in_quotes(version) + "; only 1.0 is supported");
    }

    void read_element(text::Fields& fields) {
        const std::string_view name = fields.next(), count = fields.next();
        std::int64_t value = 0;
        if (count.empty()) syntax("an element needs a name and a count");
        if (!text::parse_integer(count, value) || value < 0)
            syntax(text::in_quotes(count) + " is not a count");
        header_.elements.push_back({name, static_cast<std::uint64_t>(value), place_.line});
    }

    Type read_type(std::string_view name) const {
        for (const TypeName& known : type_names) {
            if (name == known.name || name == known.alias) return known.type;
        }
        syntax(text::in_quotes(name) + " is not a PLY type");
    }

    void read_property(text::Fields& fields) {
        if (header_.elements.empty()) syntax("a property comes before the first element");
        Property property;
        property.line = place_.line;
        std::string_view word = fields.next();
        if (word == "list") {
            property.count = read_type(fields.next());
            if (!is_integer(*property.count)) syntax("the length of a list is not an integer");
            word = fields.next();
        }
        property.type = read_type(word);
        property.name = fields.next();
        if (property.name.empty()) syntax("a property has no name");
        header_.elements.back().properties.push_back(property);
    }

    void note_grid(std::string_view word, text::Fields& fields) {
        const std::string_view what = fields.next();
        if (what == "num_cols" || what == "num_rows")
            header_.grid_comments.push_back(
                static_cast<std::size_t>(word.data() - content_.data()));
    }

    std::string_view content_;
    text::Place place_;
    std::size_t at_ = 0;
    Header header_;
};

}  // namespace

Header read_header(std::string_view content, std::string_view file) {
    return HeaderReader(content, file).read();
}

}  // namespace dsc::decode::ply
