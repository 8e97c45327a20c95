// Checks a VTU or VTP file before VTK reads it.
#include "io/vtu_check.hpp"

#include <bit>
#include <charconv>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <dsc/text/reading.hpp>
#include <dsc/text/words.hpp>

#include "io/bytes.hpp"

namespace dsc::io {
namespace {

bool is_space(char c) { return text::is_blank(c) || c == '\n'; }

std::size_t skip_space(std::string_view text, std::size_t at) {
    while (at < text.size() && is_space(text[at])) ++at;
    return at;
}

/// Value of an attribute of one tag; empty if there is none.
std::string_view attribute(std::string_view tag, std::string_view name) {
    for (std::size_t at = tag.find(name); at != std::string_view::npos;
         at = tag.find(name, at + 1)) {
        if (at == 0 || !is_space(tag[at - 1])) continue;
        std::size_t next = skip_space(tag, at + name.size());
        if (next >= tag.size() || tag[next] != '=') continue;
        next = skip_space(tag, next + 1);
        if (next >= tag.size() || (tag[next] != '"' && tag[next] != '\'')) continue;
        const std::size_t end = tag.find(tag[next], next + 1);
        if (end != std::string_view::npos) return tag.substr(next + 1, end - next - 1);
    }
    return {};
}

std::optional<std::uint64_t> number(std::string_view text) {
    text = text.substr(skip_space(text, 0));
    std::uint64_t value = 0;
    const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
    if (result.ec != std::errc{}) return std::nullopt;
    return value;
}

/// Calls action(tag, position of its end) for every tag that begins with `opening`.
template <class Action>
void for_tags(std::string_view xml, std::string_view opening, Action&& action) {
    for (std::size_t at = xml.find(opening); at != std::string_view::npos;
         at = xml.find(opening, at + 1)) {
        const std::size_t end = xml.find('>', at);
        if (end == std::string_view::npos) return;
        action(xml.substr(at, end - at), end + 1);
    }
}

/// The first `size` bytes of base64 text, or fewer if the text is shorter.
std::string from_base64(std::string_view text, std::size_t size) {
    constexpr std::string_view digits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string out;
    std::uint32_t bits = 0;
    int held = 0;
    for (const char c : text) {
        const std::size_t digit = digits.find(c);
        if (digit == std::string_view::npos || out.size() >= size) break;
        bits = (bits << 6U) | static_cast<std::uint32_t>(digit);
        held += 6;
        if (held < 8) continue;
        held -= 8;
        out += static_cast<char>((bits >> static_cast<unsigned>(held)) & 0xffU);
    }
    return out;
}

class Checker {
public:
    Checker(std::string_view content, std::string_view file) : content_(content), place_{file, 0} {
        const std::size_t appended = content.find("<AppendedData");
        xml_ = content.substr(0, appended);
        for_tags(xml_, "<VTKFile", [&](std::string_view tag, std::size_t) {
            compressed_ = !attribute(tag, "compressor").empty();
            wide_ = attribute(tag, "header_type") == "UInt64";
            if (attribute(tag, "byte_order") == "BigEndian") order_ = std::endian::big;
        });
        if (appended == std::string_view::npos) return;
        for_tags(content.substr(appended), "<AppendedData",
                 [&](std::string_view tag, std::size_t end) {
                     if (!appended_.empty()) return;
                     raw_ = attribute(tag, "encoding") == "raw";
                     const std::size_t mark = skip_space(content, appended + end);
                     if (mark < content.size() && content[mark] == '_')
                         appended_ = content.substr(mark + 1);
                 });
    }

    void check() const {
        check_version();
        check_counts();
        for (const std::string_view opening : {"<DataArray", "<Array"}) {
            for_tags(xml_, opening, [&](std::string_view tag, std::size_t end) {
                const std::string_view format = attribute(tag, "format");
                if (format != "ascii" && format != "binary" && format != "appended") {
                    text::fail("io.syntax", place_,
                               "array " + text::in_quotes(attribute(tag, "Name")) + " has format " +
                                   text::in_quotes(format) +
                                   "; supported are ascii, binary, appended",
                               text::copy_again);
                }
                if (!compressed_) return;
                if (format == "binary") {
                    check_blocks(xml_.substr(skip_space(xml_, end)), false, attribute(tag, "Name"));
                } else if (format == "appended") {
                    const auto offset = number(attribute(tag, "offset"));
                    if (!offset || *offset >= appended_.size()) refuse(attribute(tag, "Name"));
                    check_blocks(appended_.substr(*offset), raw_, attribute(tag, "Name"));
                }
            });
        }
    }

private:
    /// VTK assumes other layouts of the same bytes for other versions.
    void check_version() const {
        bool found = false, known = false;
        std::string_view version;
        for_tags(xml_, "<VTKFile", [&](std::string_view tag, std::size_t) {
            found = true;
            version = attribute(tag, "version");
            known = version.size() == 3 && version[0] >= '0' && version[0] <= '2' &&
                    version[1] == '.' && version[2] >= '0' && version[2] <= '9';
        });
        if (known) return;
        if (!found)
            text::fail("io.syntax", place_, "there is no element VTKFile",
                       "check that it is a VTU file");
        text::fail("io.syntax", place_,
                   "VTK file version " + text::in_quotes(version) + "; supported are 0.1 to 2.9",
                   "check that it is a VTU file or export it again");
    }

    /// VTK allocates as much as the file announces. zlib compresses at most 1032 to 1, and a point
    /// or a tet has at least 12 bytes.
    void check_counts() const {
        bool polygons = false;
        for_tags(xml_, "<VTKFile", [&](std::string_view tag, std::size_t) {
            polygons = attribute(tag, "type") == "PolyData";
        });
        const std::vector<std::string_view> counts =
            polygons
                ? std::vector<std::string_view>{"NumberOfPoints", "NumberOfVerts", "NumberOfLines",
                                                "NumberOfStrips", "NumberOfPolys"}
                : std::vector<std::string_view>{"NumberOfPoints", "NumberOfCells"};
        for (const std::string_view name : counts) {
            for_tags(xml_, "<Piece", [&](std::string_view tag, std::size_t) {
                const std::string_view value = attribute(tag, name);
                const auto count = number(value);
                if (count && *count / 100 <= content_.size()) return;
                text::fail("io.count", place_,
                           std::string(name) + " is " + text::in_quotes(value) +
                               ", more than a file of " + text::counted(content_.size(), "byte") +
                               " can contain",
                           text::copy_again);
            });
        }
        for (const std::string_view name : {"NumberOfComponents", "NumberOfTuples"}) {
            for_tags(xml_, "<DataArray", [&](std::string_view tag, std::size_t) {
                const std::string_view value = attribute(tag, name);
                if (value.empty()) return;
                const auto count = number(value);
                const std::uint64_t most = name == "NumberOfTuples" ? 100 * content_.size() : 1000;
                if (count && *count <= most && (*count > 0 || name == "NumberOfTuples")) return;
                text::fail("io.count", place_,
                           std::string(name) + " of array " +
                               text::in_quotes(attribute(tag, "Name")) + " is " +
                               text::in_quotes(value),
                           text::copy_again);
            });
        }
    }

    /// The header of a compressed array: number of blocks, their size, size of a last partial
    /// block, compressed sizes.
    void check_blocks(std::string_view data, bool raw, std::string_view name) const {
        const std::size_t word = wide_ ? 8 : 4;
        const auto words = [&](std::size_t count) {
            return raw ? std::string(data.substr(0, count * word))
                       : from_base64(data, count * word);
        };
        const auto word_at = [&](const std::string& bytes, std::size_t i) {
            return wide_ ? load_number<std::uint64_t>(bytes.data() + 8 * i, order_)
                         : std::uint64_t{load_number<std::uint32_t>(bytes.data() + 4 * i, order_)};
        };
        const std::string head = words(3);
        if (head.size() < 3 * word) refuse(name);
        const std::uint64_t blocks = word_at(head, 0), size = word_at(head, 1),
                            partial = word_at(head, 2);
        if (blocks == 0 && partial == 0) return;
        // A block is compressed at most 1032 to 1; small arrays still contain the usual size of a
        // block.
        if (blocks == 0 || blocks > data.size() || size == 0 ||
            size > 2000 * content_.size() + (1U << 26U) || partial > size)
            refuse(name);
        const std::string all = words(3 + blocks);
        if (all.size() < (3 + blocks) * word) refuse(name);
        std::uint64_t total = 0;
        for (std::size_t i = 0; i < blocks; ++i) {
            const std::uint64_t packed = word_at(all, 3 + i);
            if (packed > data.size() || total + packed > data.size()) refuse(name);
            total += packed;
        }
    }

    [[noreturn]] void refuse(std::string_view name) const {
        text::fail("io.syntax", place_,
                   "the compressed array " + text::in_quotes(name) +
                       " has a header that does not fit the file",
                   text::copy_again);
    }

    std::string_view content_;
    std::string_view xml_;
    std::string_view appended_;
    text::Place place_;
    bool compressed_ = false;
    bool wide_ = false;
    bool raw_ = false;
    std::endian order_ = std::endian::little;
};

}  // namespace

void check_vtu(std::string_view content, std::string_view file) { Checker(content, file).check(); }

std::string with_point_data(std::string_view content) {
    const std::string_view xml = content.substr(0, content.find("<AppendedData"));
    std::string out;
    std::size_t copied = 0;
    for_tags(xml, "<Piece", [&](std::string_view tag, std::size_t end) {
        const std::string_view piece = xml.substr(end, xml.find("</Piece", end) - end);
        if (tag.back() == '/' || piece.find("<PointData") != std::string_view::npos) return;
        out.append(content.substr(copied, end - copied)).append("<PointData/>");
        copied = end;
    });
    return out.append(content.substr(copied));
}

}  // namespace dsc::io
