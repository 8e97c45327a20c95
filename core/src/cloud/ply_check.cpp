// Checks a PLY cloud before PCL reads it.
#include <algorithm>
#include <cstdint>
#include <vector>

#include <dsc/base/error.hpp>
#include <dsc/text/numbers.hpp>
#include <dsc/text/words.hpp>

#include "formats.hpp"
#include "header.hpp"

namespace dsc::cloud {

namespace {

struct Property {
    std::string_view name;
    std::string_view type;        ///< canonical: int8, ... float64
    std::string_view count_type;  ///< of a list, else empty
};

struct Element {
    std::string_view name;
    std::size_t count = 0;
    std::vector<Property> properties;
};

enum class Format { ascii, little, big };

struct PlyHeader {
    Format format = Format::ascii;
    std::vector<Element> elements;
    std::string_view body;
    std::size_t lines = 0;
    std::vector<std::size_t> grid_comments;  ///< places of their "obj_info"
};

struct Type {
    std::string_view name, alias;
    std::size_t size;
};
constexpr Type types[] = {{"int8", "char", 1},     {"uint8", "uchar", 1},   {"int16", "short", 2},
                          {"uint16", "ushort", 2}, {"int32", "int", 4},     {"uint32", "uint", 4},
                          {"float32", "float", 4}, {"float64", "double", 8}};

std::size_t size_of(std::string_view name) {
    for (const Type& type : types)
        if (type.name == name) return type.size;
    return 0;
}

class PlyHeaderReader {
public:
    PlyHeaderReader(const std::string& file, std::string_view bytes) : file_(file), rest_(bytes), begin_(bytes.data()) {}

    PlyHeader read() {
        std::string_view line;
        if (!next_header_line(rest_, line) || line != "ply")
            throw IoError("io.syntax", file_, "1", "the first line is not 'ply'",
                          "this is no PLY file, check its name");
        line_ = 1;
        bool format = false;
        while (next_header_line(rest_, line)) {
            ++line_;
            std::string_view rest = line;
            const std::string_view key = text::next_word(rest);
            if (key == "comment") continue;
            if (key == "end_header") {
                if (!format) fail("the header has no line 'format'");
                header_.body = rest_;
                header_.lines = line_;
                return header_;
            }
            if (key == "format") {
                read_format(rest);
                format = true;
            } else if (key == "element") {
                read_element(rest);
            } else if (key == "property") {
                read_property(rest);
            } else if (key == "obj_info") {
                const std::string_view what = text::next_word(rest);
                if (what == "num_cols" || what == "num_rows")
                    header_.grid_comments.push_back(static_cast<std::size_t>(line.data() - begin_) + line.find(key));
            } else {
                fail(text::in_quotes(key) + " is not an entry of a PLY header");
            }
        }
        throw IoError("io.truncated", file_, "", "the PLY header has no line 'end_header'",
                      "the file is cut off, write it again");
    }

private:
    [[noreturn]] void fail(const std::string& cause) const { header_error(file_, line_, cause); }

    /// Range images have fewer points than grid positions; PCL fills the rest with NaN. Only an element makes a range image; a
    /// comment with the size of a grid does not.
    [[noreturn]] void grid() const {
        throw IoError("io.format", file_, std::to_string(line_), "PLY files with a range grid are not supported",
                      "save only the points, for instance with MeshLab or CloudCompare");
    }

    void read_format(std::string_view rest) {
        const std::string_view name = text::next_word(rest);
        if (name == "ascii")
            header_.format = Format::ascii;
        else if (name == "binary_little_endian")
            header_.format = Format::little;
        else if (name == "binary_big_endian")
            header_.format = Format::big;
        else
            fail(text::in_quotes(name) +
                 " is not a PLY format; supported are ascii, binary_little_endian and binary_big_endian");
    }

    void read_element(std::string_view rest) {
        Element element;
        element.name = text::next_word(rest);
        const std::string_view count = text::next_word(rest);
        if (element.name == "range_grid") grid();
        if (!text::parse_count(count, element.count) || element.count > most_points)
            fail(text::in_quotes(count) + " is not a count between 0 and " + std::to_string(most_points));
        for (const Element& other : header_.elements)
            if (other.name == element.name) fail("element " + text::in_quotes(element.name) + " occurs twice");
        header_.elements.push_back(element);
    }

    std::string_view read_type(std::string_view word) const {
        for (const Type& type : types)
            if (word == type.name || word == type.alias) return type.name;
        fail(text::in_quotes(word) + " is not a PLY type");
    }

    void read_property(std::string_view rest) {
        if (header_.elements.empty()) fail("a property comes before the first element");
        Element& element = header_.elements.back();
        Property property;
        std::string_view word = text::next_word(rest);
        if (word == "list") {
            property.count_type = read_type(text::next_word(rest));
            if (property.count_type.substr(0, 5) == "float")
                fail("the length of a list is not an integer");
            word = text::next_word(rest);
        }
        property.type = read_type(word);
        property.name = text::next_word(rest);
        if (property.name.empty()) fail("a property has no name");
        for (const Property& other : element.properties)
            if (other.name == property.name) fail("property " + text::in_quotes(property.name) + " occurs twice");
        element.properties.push_back(property);
    }

    const std::string& file_;
    std::string_view rest_;
    const char* begin_;
    std::size_t line_ = 0;
    PlyHeader header_;
};

/// Finds properties that PCL's reader would silently read into the wrong place of a point.
void check_vertex(const std::string& file, const Element& vertex) {
    const auto refuse = [&](const std::string& cause) {
        throw IoError("io.format", file, "", cause, "save the points with only x, y and z");
    };
    std::size_t axes = 0;
    std::vector<std::size_t> bytes;  // positions of red, green, blue; their order is checked by name
    for (std::size_t i = 0; i < vertex.properties.size(); ++i) {
        const Property& p = vertex.properties[i];
        if (!p.count_type.empty()) refuse("the points have a list, " + text::in_quotes(p.name));
        if (p.name == "x" || p.name == "y" || p.name == "z") ++axes;
        if (p.type != "uint8") continue;
        std::string_view colour = p.name;
        if (colour.substr(0, 8) == "diffuse_") colour.remove_prefix(8);
        constexpr std::string_view order[] = {"red", "green", "blue"};
        const auto found = std::find(std::begin(order), std::end(order), colour);
        if (found != std::end(order)) {
            const auto place = static_cast<std::size_t>(found - std::begin(order));
            if (bytes.size() != place || (place > 0 && bytes.back() + 1 != i))
                refuse("the colours of the points are not red, green, blue in a row");
            bytes.push_back(i);
        }
        if (p.name == "alpha" && bytes.size() != 3) refuse("the points have alpha without colours before it");
    }
    if (!bytes.empty() && bytes.size() != 3)
        refuse("the colours of the points are not red, green, blue in a row");
    if (axes != 3) refuse("the points do not have each of x, y and z");
}

[[noreturn]] void cut(const std::string& file, const Element& element, std::size_t held) {
    truncated(file,
              element.name == "vertex" ? text::counted(element.count, "point")
                                       : std::to_string(element.count) + " of " + text::in_quotes(element.name),
              held);
}

std::uint64_t unsigned_at(std::string_view bytes, std::size_t size, Format format) {
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < size; ++i) {
        const std::size_t byte = format == Format::big ? i : size - 1 - i;
        value = value << 8U | static_cast<unsigned char>(bytes[byte]);
    }
    return value;
}

void check_binary(const std::string& file, const PlyHeader& header) {
    std::string_view rest = header.body;
    for (const Element& element : header.elements) {
        if (element.count == 0) continue;  // it may have no properties
        std::size_t fixed = 0;
        bool lists = false;
        for (const Property& p : element.properties) {
            fixed += p.count_type.empty() ? size_of(p.type) : 0;
            lists = lists || !p.count_type.empty();
        }
        if (!lists) {
            const std::size_t held = rest.size() / fixed;
            if (held < element.count) cut(file, element, held);
            rest.remove_prefix(element.count * fixed);
            continue;
        }
        for (std::size_t n = 0; n < element.count; ++n)
            for (const Property& p : element.properties) {
                std::uint64_t need = size_of(p.type);
                if (!p.count_type.empty()) {
                    const std::size_t size = size_of(p.count_type);
                    if (rest.size() < size) cut(file, element, n);
                    need *= unsigned_at(rest, size, header.format);
                    rest.remove_prefix(size);
                }
                if (rest.size() < need) cut(file, element, n);
                rest.remove_prefix(need);
            }
    }
}

void check_line(const std::string& file, std::size_t number, const Element& element, std::string_view line) {
    const auto value = [&](std::string_view what) {
        const std::string_view word = text::next_word(line);
        double ignored = 0.0;
        if (word.empty())
            throw IoError(
                "io.truncated", file, std::to_string(number),
                "the line ends before " + text::in_quotes(what) + " of element " + text::in_quotes(element.name),
                "the file may be cut off, write it again");
        if (text::parse_number(word, ignored) == text::Number::not_a_number) not_a_number(file, number, word, "save the cloud again");
        return word;
    };
    for (const Property& p : element.properties) {
        std::size_t count = 1;
        if (!p.count_type.empty()) {
            const std::string_view word = value(p.name);
            if (!text::parse_count(word, count))
                header_error(file, number, text::in_quotes(word) + " is not the length of a list");
        }
        for (std::size_t i = 0; i < count; ++i) value(p.name);  // ends with the line at the latest
    }
    if (!text::trim(line).empty())
        header_error(file, number,
                     "the line has more values than element " + text::in_quotes(element.name) + " has properties");
}

void check_ascii_body(const std::string& file, const PlyHeader& header) {
    std::string_view rest = header.body;
    std::size_t number = header.lines;
    for (const Element& element : header.elements)
        for (std::size_t n = 0; n < element.count; ++n) {
            if (rest.empty()) cut(file, element, n);
            const std::size_t end = rest.find('\n');
            std::string_view line = rest.substr(0, end);
            rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
            if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
            check_line(file, ++number, element, line);
        }
}

}  // namespace

FileCheck check_ply(const std::string& file, std::string_view bytes) {
    const PlyHeader header = PlyHeaderReader(file, bytes).read();
    const auto vertex = std::find_if(header.elements.begin(), header.elements.end(),
                                     [](const Element& element) { return element.name == "vertex"; });
    if (vertex == header.elements.end() || vertex->count == 0) no_points(file, "save the cloud again");
    check_vertex(file, *vertex);
    for (const Element& element : header.elements)
        if (element.properties.empty() && element.count > 0)
            throw IoError("io.syntax", file, "", "element " + text::in_quotes(element.name) + " has no properties",
                          "save the cloud again");
    if (header.format == Format::ascii)
        check_ascii_body(file, header);
    else
        check_binary(file, header);
    FileCheck check{vertex->count};
    for (const Property& property : vertex->properties) check.names.emplace_back(property.name);
    check.grid_comments = header.grid_comments;
    return check;
}

}  // namespace dsc::cloud
