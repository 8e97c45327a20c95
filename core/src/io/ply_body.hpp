#pragma once
// Values of the body of a PLY file, as text or as bytes, one after the other.
#include <bit>
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>

#include <fmt/core.h>

#include <dsc/decode/ply_header.hpp>
#include <dsc/text/reading.hpp>
#include <dsc/text/words.hpp>

#include "io/bytes.hpp"

namespace dsc::io {

using decode::ply::size_of;
using decode::ply::Type;

/// Values of a text body.
class TextBody {
public:
    TextBody(std::string_view body, std::string_view file, std::size_t first_line)
        : tokens_(body, file, first_line) {}
    double real(Type) { return told(tokens_.coordinate()); }
    /// A number that may be NaN or infinite.
    double any(Type) { return told(tokens_.value()); }
    std::int64_t integer(Type) { return told(tokens_.integer()); }
    /// Accepts any number; NaN is allowed in values that are not used.
    void skip(Type) { told(tokens_.require("a number")); }
    void skip_list(Type type, std::uint64_t count) {
        for (std::uint64_t i = 0; i < count; ++i) skip(type);
    }
    text::Place place() const { return tokens_.place(); }
    /// Least size of a value: one digit and one blank.
    static std::size_t least_size(Type) { return 2; }
    bool ended() { return tokens_.next().empty(); }

    /// Called for each element. A line is an element: if values remain on it or must be taken from
    /// the next line, the header does not fit. Only a list may continue on further lines.
    void begin_element() { first_of_element_ = 0; }
    void end_element(std::string_view element) {
        if (first_of_element_ == 0 || !tokens_.more_on_line()) return;
        const bool short_line = tokens_.place().line != first_of_element_;
        text::fail("io.syntax", {tokens_.place().file, first_of_element_},
                   std::string("the line has ") + (short_line ? "fewer" : "more") +
                       " values than element " + text::in_quotes(element) + " has properties",
                   text::export_again);
    }

private:
    template <class Value>
    Value told(Value value) {
        if (first_of_element_ == 0) first_of_element_ = tokens_.place().line;
        return value;
    }

    text::Tokens tokens_;
    std::size_t first_of_element_ = 0;  ///< its line; 0 before its first value
};

/// Values of a binary body. Bounds are checked at every step.
class BinaryBody {
public:
    BinaryBody(std::string_view content, std::string_view file, std::size_t start,
               std::endian order)
        : content_(content), file_(file), at_(start), order_(order) {}

    double any(Type type) {
        return type == Type::float32   ? static_cast<double>(take<float>())
               : type == Type::float64 ? take<double>()
                                       : static_cast<double>(integer(type));
    }
    double real(Type type) {
        const double value = any(type);
        if (!std::isfinite(value)) {
            text::fail("io.not_finite", place(),
                       fmt::format("the coordinate before byte {} is NaN or infinite", at_),
                       "remove the point and its faces or export the file again");
        }
        return value;
    }
    std::int64_t integer(Type type) {
        switch (type) {
            case Type::int8: return take<std::int8_t>();
            case Type::uint8: return take<std::uint8_t>();
            case Type::int16: return take<std::int16_t>();
            case Type::uint16: return take<std::uint16_t>();
            case Type::int32: return take<std::int32_t>();
            case Type::uint32: return take<std::uint32_t>();
            default: text::fail("io.syntax", place(), "indices are fractions", text::export_again);
        }
    }
    void skip(Type type) { skip_list(type, 1); }
    void skip_list(Type type, std::uint64_t count) {
        require(count, size_of(type));
        at_ += count * size_of(type);
    }
    text::Place place() const { return {file_, 0}; }
    static std::size_t least_size(Type type) { return size_of(type); }
    void begin_element() {}
    void end_element(std::string_view) {}
    bool ended() {
        // Some programs end the file with a line feed.
        return content_.find_first_not_of(" \r\n\t", at_) == std::string_view::npos;
    }

private:
    template <class T>
    T take() {
        require(1, sizeof(T));
        const T value = load_number<T>(content_.data() + at_, order_);
        at_ += sizeof(T);
        return value;
    }
    void require(std::uint64_t count, std::size_t size) {
        if (count <= (content_.size() - at_) / size) return;
        text::fail("io.truncated", place(),
                   fmt::format("the file ends at byte {} where {} bytes should follow byte {}",
                               content_.size(), count * size, at_),
                   text::copy_again);
    }

    std::string_view content_;
    std::string_view file_;
    std::size_t at_;
    std::endian order_;
};

}  // namespace dsc::io
