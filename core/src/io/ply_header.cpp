// Reads the header of a PLY surface.
#include "io/ply_header.hpp"

#include <array>
#include <utility>

#include <dsc/text/reading.hpp>
#include <dsc/text/words.hpp>


namespace dsc::io::ply {
namespace {

struct TypeName {
    std::string_view name;
    Type type;
};
constexpr std::array<TypeName, 16> type_names = {{{"char", Type::int8},
                                                  {"uchar", Type::uint8},
                                                  {"short", Type::int16},
                                                  {"ushort", Type::uint16},
                                                  {"int", Type::int32},
                                                  {"uint", Type::uint32},
                                                  {"float", Type::float32},
                                                  {"double", Type::float64},
                                                  {"int8", Type::int8},
                                                  {"uint8", Type::uint8},
                                                  {"int16", Type::int16},
                                                  {"uint16", Type::uint16},
                                                  {"int32", Type::int32},
                                                  {"uint32", Type::uint32},
                                                  {"float32", Type::float32},
                                                  {"float64", Type::float64}}};

class HeaderReader {
public:
    HeaderReader(std::string_view content, std::string_view file) : content_(content), place_{file, 0} {}

    Header read() {
        if (next_line() != "ply")
            text::fail("io.syntax", place_, "the file does not start with 'ply'", "check that it is a PLY file");
        bool format = false;
        while (true) {
            text::Fields fields(next_line());
            const std::string_view word = fields.next();
            if (word == "end_header") break;
            if (word == "format") {
                read_format(fields);
                format = true;
            } else if (word == "element") {
                read_element(fields);
            } else if (word == "property") {
                read_property(fields);
            } else if (word != "comment" && word != "obj_info" && !word.empty()) {
                text::fail("io.syntax", place_, text::in_quotes(word) + " is not a word of a PLY header", text::export_again);
            }
        }
        if (!format) text::fail("io.syntax", place_, "the header has no format", text::export_again);
        header_.size = at_;
        header_.lines = place_.line;
        return std::move(header_);
    }

private:
    std::string_view next_line() {
        const std::size_t end = content_.find('\n', at_);
        if (end == std::string_view::npos) {
            text::fail("io.truncated", place_, "the file ends before 'end_header'", text::copy_again);
        }
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
            text::fail("io.syntax", place_, text::in_quotes(name) + " is not a PLY format", text::export_again);
        if (version != "1.0")
            text::fail("io.syntax", place_, "PLY version " + text::in_quotes(version) + "; only 1.0 is supported", text::export_again);
    }

    void read_element(text::Fields& fields) {
        const std::string_view name = fields.next();
        const std::int64_t count = text::read_integer(fields.next(), place_);
        if (name.empty() || count < 0)
            text::fail("io.syntax", place_, "an element needs a name and a count", text::export_again);
        header_.elements.push_back({name, static_cast<std::uint64_t>(count), {}});
    }

    Type read_type(text::Fields& fields) {
        const std::string_view name = fields.next();
        for (const TypeName& known : type_names) {
            if (known.name == name) return known.type;
        }
        text::fail("io.syntax", place_, text::in_quotes(name) + " is not a PLY type", text::export_again);
    }

    void read_property(text::Fields& fields) {
        if (header_.elements.empty())
            text::fail("io.syntax", place_, "a property before the first element", text::export_again);
        Property property;
        text::Fields ahead = fields;
        if (ahead.next() == "list") {
            fields = ahead;
            property.count = read_type(fields);
            if (!is_integer(*property.count))
                text::fail("io.syntax", place_, "the length of a list is not an integer", text::export_again);
        }
        property.type = read_type(fields);
        property.name = fields.next();
        if (property.name.empty()) text::fail("io.syntax", place_, "a property without a name", text::export_again);
        header_.elements.back().properties.push_back(property);
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

}  // namespace dsc::io::ply
