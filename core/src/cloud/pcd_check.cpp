// Checks a PCD file before PCL reads it.
#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <vector>

#include <fmt/core.h>

#include <dsc/base/error.hpp>
#include <dsc/text/numbers.hpp>
#include <dsc/text/words.hpp>

#include "formats.hpp"
#include "header.hpp"

namespace dsc::cloud {

namespace {

/// Removes the next line from `rest`. Only LF ends it, because binary data may follow a header; a
/// CR before it is dropped. False at the end and for a line without LF.
bool next_header_line(std::string_view& rest, std::string_view& line) {
    const std::size_t end = rest.find('\n');
    if (end == std::string_view::npos) return false;
    line = rest.substr(0, end);
    rest.remove_prefix(end + 1);
    if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    return true;
}

struct Field {
    std::string_view name;
    std::size_t size = 4;
    char type = 'F';
    std::size_t count = 1;
};

struct PcdHeader {
    std::vector<Field> fields;
    std::size_t points = 0;
    std::string_view data;  ///< "ascii", "binary", "binary_compressed"
    std::string_view body;
    std::size_t lines = 0;
    std::optional<Sensor> sensor;

    std::size_t step() const {
        std::size_t sum = 0;
        for (const Field& field : fields) sum += field.size * field.count;
        return sum;
    }
};

class PcdHeaderReader {
public:
    PcdHeaderReader(const std::string& file, std::string_view bytes) : file_(file), rest_(bytes) {}

    PcdHeader read() {
        std::string_view line;
        while (next_header_line(rest_, line)) {
            ++line_;
            std::string_view rest = line;
            const std::string_view key = text::next_word(rest);
            if (key.empty() || key.front() == '#') continue;
            std::vector<std::string_view> values;
            for (std::string_view word = text::next_word(rest); !word.empty();
                 word = text::next_word(rest))
                values.push_back(word);
            entry(key, values);
            if (key == "DATA") {
                finish();
                return header_;
            }
        }
        throw IoError("io.truncated", file_, "", "the PCD header has no line DATA",
                      "the file is truncated or not a PCD file; write it again");
    }

private:
    [[noreturn]] void fail(const std::string& cause) const { header_error(file_, line_, cause); }

    std::size_t count(std::string_view word, std::size_t most) const {
        std::size_t value = 0;
        if (!text::parse_count(word, value) || value > most)
            fail(fmt::format("{} is not a count between 0 and {}", text::in_quotes(word), most));
        return value;
    }

    /// PCL resizes its buffers when it reads these lines, so their order and number matter.
    void entry(std::string_view key, const std::vector<std::string_view>& values) {
        static constexpr std::array<std::string_view, 10> order{
            "VERSION", "FIELDS", "SIZE",      "TYPE",   "COUNT",
            "WIDTH",   "HEIGHT", "VIEWPOINT", "POINTS", "DATA"};
        const std::string_view name = key == "COLUMNS" ? "FIELDS" : key;
        const auto place = std::find(order.begin(), order.end(), name);
        if (place == order.end()) fail(text::in_quotes(key) + " is not an entry of a PCD header");
        const auto rank = place - order.begin() + 1;
        if (rank <= rank_) fail(text::in_quotes(key) + " occurs twice or in the wrong order");
        rank_ = rank;

        if (name == "FIELDS") {
            for (const std::string_view value : values) header_.fields.push_back({value});
            if (values.empty()) fail("FIELDS names no field");
        } else if (name == "SIZE" || name == "TYPE" || name == "COUNT") {
            if (values.size() != header_.fields.size())
                fail(fmt::format("{} has {}, FIELDS has {}", name,
                                 text::counted(values.size(), "value"), header_.fields.size()));
            for (std::size_t i = 0; i < values.size(); ++i)
                column(header_.fields[i], name, values[i]);
            seen_ += name == "COUNT" ? 0 : 1;
        } else if (name == "VIEWPOINT") {
            if (values.size() != 7)
                fail("VIEWPOINT has " + text::counted(values.size(), "value") + ", it needs 7");
            viewpoint(values);
        } else if (name != "VERSION") {
            if (values.size() != 1)
                fail(std::string(name) + " has " + text::counted(values.size(), "value") +
                     ", it needs 1");
            if (name == "WIDTH") width_ = count(values[0], most_points);
            if (name == "HEIGHT") height_ = count(values[0], most_points);
            if (name == "POINTS") header_.points = count(values[0], most_points);
            if (name == "DATA") header_.data = values[0];
            has_points_ = has_points_ || name == "POINTS";
            has_width_ = has_width_ || name == "WIDTH";
            has_height_ = has_height_ || name == "HEIGHT";
        }
    }

    /// The first three numbers are the sensor's position; if a word is not a number, the position
    /// is missing.
    void viewpoint(const std::vector<std::string_view>& values) {
        Vec3 place;
        for (int k = 0; k < 3; ++k)
            if (text::parse_number(values[static_cast<std::size_t>(k)], place[k]) !=
                text::Number::ok)
                return;
        header_.sensor = Sensor{place, !place.isZero(0.0)};
    }

    void column(Field& field, std::string_view name, std::string_view value) const {
        if (name == "SIZE") {
            field.size = count(value, 8);
            if (field.size != 1 && field.size != 2 && field.size != 4 && field.size != 8)
                fail("field " + text::in_quotes(field.name) + " has size " + std::string(value) +
                     "; supported are 1, 2, 4 and 8");
        } else if (name == "TYPE") {
            field.type = value.front();
            if (value.size() != 1 ||
                std::string_view("FIU").find(field.type) == std::string_view::npos ||
                (field.type == 'F' && field.size < 4))
                fail("field " + text::in_quotes(field.name) + " has the unknown type " +
                     text::in_quotes(value) + " of " + text::counted(field.size, "byte"));
        } else {
            field.count = count(value, 100000);
            if (field.count == 0) fail("field " + text::in_quotes(field.name) + " has count 0");
        }
    }

    void finish() {
        if (seen_ != 2) fail("FIELDS, SIZE or TYPE is missing");
        if (!has_points_ || has_width_ != has_height_) fail("WIDTH, HEIGHT or POINTS is missing");
        if (has_width_ && width_ * height_ != header_.points)
            fail(fmt::format("WIDTH {} x HEIGHT {} is not POINTS {}", width_, height_,
                             header_.points));
        for (const std::string_view axis : {"x", "y", "z"}) {
            const auto named = [&](const Field& field) { return field.name == axis; };
            const auto found = std::find_if(header_.fields.begin(), header_.fields.end(), named);
            if (std::count_if(header_.fields.begin(), header_.fields.end(), named) != 1 ||
                found->count != 1)
                fail("a point needs the fields x, y and z exactly once; " + text::in_quotes(axis) +
                     " does not occur exactly once");
        }
        // In a depth image the scanner's own position is the origin; elsewhere 0 0 0 is the default
        // that programs write.
        if (header_.sensor && has_height_ && height_ > 1) header_.sensor->stated = true;
        header_.body = rest_;
        header_.lines = line_;
    }

    const std::string& file_;
    std::string_view rest_;
    std::size_t line_ = 0;
    std::ptrdiff_t rank_ = 0;
    int seen_ = 0;
    std::size_t width_ = 0, height_ = 0;
    bool has_points_ = false, has_width_ = false, has_height_ = false;
    PcdHeader header_;
};

void check_ascii_rows(const std::string& file, const PcdHeader& header) {
    std::size_t columns = 0;
    for (const Field& field : header.fields) columns += field.count;
    std::size_t points = 0, number = header.lines;
    std::string_view rest = header.body;
    while (points < header.points && !rest.empty()) {
        const std::size_t end = rest.find('\n');
        std::string_view line = rest.substr(0, end);
        rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
        ++number;
        if (line.empty()) continue;  // as PCL does
        if (line.back() == '\r') line.remove_suffix(1);
        std::size_t column = 0;
        std::size_t field = 0, left = header.fields[0].count;
        for (std::string_view word = text::next_word(line); !word.empty();
             word = text::next_word(line), ++column) {
            if (column >= columns) break;
            double value = 0.0;
            const std::string_view name = header.fields[field].name;
            if ((name == "x" || name == "y" || name == "z") &&
                text::parse_number(word, value) == text::Number::not_a_number)
                not_a_number(word, {file, number}, "write its true coordinate");
            if (--left == 0 && ++field < header.fields.size()) left = header.fields[field].count;
        }
        if (column < columns)
            throw IoError("io.truncated", file, std::to_string(number),
                          fmt::format("the point has {}, the header requires {}",
                                      text::counted(column, "value"), columns),
                          "the file may be cut off, write it again");
        ++points;
    }
    if (points < header.points) truncated(file, text::counted(header.points, "point"), points);
}

void check_compressed(const std::string& file, const PcdHeader& header) {
    for (const Field& field : header.fields)
        if (field.name == "_")
            header_error(file, header.lines,
                         "a padding field '_' in compressed data cannot be read");
    std::array<std::uint32_t, 2> sizes{};  // compressed, uncompressed
    const std::size_t wanted = header.points * header.step();
    if (header.body.size() < sizeof sizes)
        truncated(file, text::counted(header.points, "point"), 0);
    std::memcpy(sizes.data(), header.body.data(), sizeof sizes);
    if (header.body.size() - sizeof sizes < sizes[0])
        throw IoError("io.truncated", file, "",
                      fmt::format("the compressed data have {} of {} bytes",
                                  header.body.size() - sizeof sizes, sizes[0]),
                      "the file is cut off, write it again");
    // Three bytes of LZF represent at most 264, so a small file cannot request much memory.
    if (sizes[1] != wanted || wanted / 100 > sizes[0])
        throw IoError(
            "io.syntax", file, "",
            fmt::format("the compressed data claim to have {} bytes, the header's {} need {}",
                        sizes[1], text::counted(header.points, "point"), wanted),
            "the file is damaged, write it again");
}

}  // namespace

FileCheck check_pcd(const std::string& file, std::string_view bytes) {
    const PcdHeader header = PcdHeaderReader(file, bytes).read();
    if (header.points == 0) no_points(file, "save the cloud again");
    if (header.data == "ascii") {
        check_ascii_rows(file, header);
    } else if (header.data == "binary") {
        const std::size_t held = header.body.size() / header.step();
        if (held < header.points) truncated(file, text::counted(header.points, "point"), held);
    } else if (header.data == "binary_compressed") {
        check_compressed(file, header);
    } else {
        header_error(
            file, header.lines,
            text::in_quotes(header.data) +
                " is not a kind of PCD data; supported are ascii, binary and binary_compressed");
    }
    FileCheck check{header.points};
    for (const Field& field : header.fields)
        if (field.name != "_") check.names.emplace_back(field.name);
    check.sensor = header.sensor;
    check.body = bytes.size() - header.body.size();
    return check;
}

}  // namespace dsc::cloud
