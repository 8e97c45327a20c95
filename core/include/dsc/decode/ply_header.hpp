#pragma once
// The header of a PLY file, for clouds and for surfaces.

#include <bit>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace dsc::decode::ply {

enum class Type { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

/// Number of bytes of a number in a binary file.
constexpr std::size_t size_of(Type type) {
    switch (type) {
        case Type::int8:
        case Type::uint8: return 1;
        case Type::int16:
        case Type::uint16: return 2;
        case Type::int32:
        case Type::uint32:
        case Type::float32: return 4;
        case Type::float64: return 8;
    }
    return 8;
}

constexpr bool is_integer(Type type) { return type != Type::float32 && type != Type::float64; }

struct Property {
    std::string_view name;
    Type type = Type::float32;
    std::optional<Type> count;  ///< of a list
    std::size_t line = 0;
};

struct Element {
    std::string_view name;
    std::uint64_t count = 0;
    std::size_t line = 0;
    std::vector<Property> properties{};
};

struct Header {
    std::optional<std::endian> order;  ///< empty: text
    std::vector<Element> elements;
    std::size_t size = 0;  ///< number of bytes, including the line feed of end_header
    std::size_t lines = 0;
    std::vector<std::size_t> grid_comments;  ///< positions of the words "obj_info" that give the
                                             ///< size of a grid
};

/// Reads the header at the start of `content`; the names refer to `content`. Elements and
/// properties may repeat. Throws IoError "io.syntax", "io.truncated". `file` is used only in
/// messages.
Header read_header(std::string_view content, std::string_view file);

}  // namespace dsc::decode::ply
