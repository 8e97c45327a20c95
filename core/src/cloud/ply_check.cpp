// Checks a PLY cloud before PCL reads it.
#include <algorithm>
#include <bit>
#include <cstdint>
#include <vector>

#include <fmt/core.h>

#include <dsc/base/error.hpp>
#include <dsc/decode/ply_header.hpp>
#include <dsc/text/numbers.hpp>
#include <dsc/text/words.hpp>

#include "formats.hpp"
#include "header.hpp"

namespace dsc::cloud {

namespace {

using decode::ply::Element;
using decode::ply::Header;
using decode::ply::Property;
using decode::ply::Type;

/// Refuses what a header may say but PCL's reader mistakes. Range images have fewer points than
/// grid positions; PCL fills the rest with NaN. Only an element makes a range image; a comment with
/// the size of a grid does not.
void check_element(const std::string& file, const Element& element) {
    if (element.name == "range_grid")
        throw IoError("io.format", file, std::to_string(element.line),
                      "PLY files with a range grid are not supported",
                      "save only the points, for instance with MeshLab or CloudCompare");
    if (element.count > most_points)
        header_error(file, element.line,
                     fmt::format("{} elements {} are too many; at most {} can be read",
                                 element.count, text::in_quotes(element.name), most_points));
    for (const Property& p : element.properties) {
        const auto same = [&](const Property& other) { return other.name == p.name; };
        if (std::find_if(element.properties.begin(), element.properties.end(), same)->line !=
            p.line)
            header_error(file, p.line, "property " + text::in_quotes(p.name) + " occurs twice");
    }
}

void check_elements(const std::string& file, const std::vector<Element>& elements) {
    for (const Element& element : elements) {
        const auto same = [&](const Element& other) { return other.name == element.name; };
        if (std::find_if(elements.begin(), elements.end(), same)->line != element.line)
            header_error(file, element.line,
                         "element " + text::in_quotes(element.name) + " occurs twice");
        check_element(file, element);
    }
}

/// Finds properties that PCL's reader would silently read into the wrong place of a point.
void check_vertex(const std::string& file, const Element& vertex) {
    const auto refuse = [&](const std::string& cause) {
        throw IoError("io.format", file, "", cause, "save the points with only x, y and z");
    };
    std::size_t axes = 0;
    std::vector<std::size_t> bytes;  // positions of red, green, blue; their order is checked by
                                     // name
    for (std::size_t i = 0; i < vertex.properties.size(); ++i) {
        const Property& p = vertex.properties[i];
        if (p.count) refuse("the points have a list, " + text::in_quotes(p.name));
        if (p.name == "x" || p.name == "y" || p.name == "z") ++axes;
        if (p.type != Type::uint8) continue;
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
        if (p.name == "alpha" && bytes.size() != 3)
            refuse("the points have alpha without colours before it");
    }
    if (!bytes.empty() && bytes.size() != 3)
        refuse("the colours of the points are not red, green, blue in a row");
    if (axes != 3) refuse("the points do not have each of x, y and z");
}

[[noreturn]] void cut(const std::string& file, const Element& element, std::size_t held) {
    truncated(file,
              element.name == "vertex"
                  ? text::counted(element.count, "point")
                  : fmt::format("{} of {}", element.count, text::in_quotes(element.name)),
              held);
}

std::uint64_t unsigned_at(std::string_view bytes, std::size_t size, std::endian order) {
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < size; ++i) {
        const std::size_t byte = order == std::endian::big ? i : size - 1 - i;
        value = value << 8U | static_cast<unsigned char>(bytes[byte]);
    }
    return value;
}

void check_binary(const std::string& file, const Header& header, std::string_view rest) {
    for (const Element& element : header.elements) {
        if (element.count == 0) continue;  // it may have no properties
        std::size_t fixed = 0;
        bool lists = false;
        for (const Property& p : element.properties) {
            fixed += p.count ? 0 : size_of(p.type);
            lists = lists || p.count;
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
                if (p.count) {
                    const std::size_t size = size_of(*p.count);
                    if (rest.size() < size) cut(file, element, n);
                    need *= unsigned_at(rest, size, *header.order);
                    rest.remove_prefix(size);
                }
                if (rest.size() < need) cut(file, element, n);
                rest.remove_prefix(need);
            }
    }
}

void check_line(const std::string& file, std::size_t number, const Element& element,
                std::string_view line) {
    const auto value = [&](std::string_view what) {
        const std::string_view word = text::next_word(line);
        double ignored = 0.0;
        if (word.empty())
            throw IoError("io.truncated", file, std::to_string(number),
                          "the line ends before " + text::in_quotes(what) + " of element " +
                              text::in_quotes(element.name),
                          "the file may be cut off, write it again");
        if (text::parse_number(word, ignored) == text::Number::not_a_number)
            not_a_number(word, {file, number}, "save the cloud again");
        return word;
    };
    for (const Property& p : element.properties) {
        std::size_t count = 1;
        if (p.count) {
            const std::string_view word = value(p.name);
            if (!text::parse_count(word, count))
                header_error(file, number, text::in_quotes(word) + " is not the length of a list");
        }
        for (std::size_t i = 0; i < count; ++i) value(p.name);  // ends with the line at the latest
    }
    if (!text::trim(line).empty())
        header_error(file, number,
                     "the line has more values than element " + text::in_quotes(element.name) +
                         " has properties");
}

void check_ascii_body(const std::string& file, const Header& header, std::string_view rest) {
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
    const Header header = decode::ply::read_header(bytes, file);
    check_elements(file, header.elements);
    const auto vertex =
        std::find_if(header.elements.begin(), header.elements.end(),
                     [](const Element& element) { return element.name == "vertex"; });
    if (vertex == header.elements.end() || vertex->count == 0)
        no_points(file, "save the cloud again");
    check_vertex(file, *vertex);
    for (const Element& element : header.elements)
        if (element.properties.empty() && element.count > 0)
            throw IoError("io.syntax", file, "",
                          "element " + text::in_quotes(element.name) + " has no properties",
                          "save the cloud again");
    const std::string_view body = bytes.substr(header.size);
    if (header.order)
        check_binary(file, header, body);
    else
        check_ascii_body(file, header, body);
    FileCheck check{vertex->count};
    for (const Property& property : vertex->properties) check.names.emplace_back(property.name);
    check.grid_comments = header.grid_comments;
    return check;
}

}  // namespace dsc::cloud
