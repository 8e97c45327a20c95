// PLY surfaces: text, little and big endian. Elements and properties that are not needed are
// skipped.
#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include <fmt/core.h>

#include <dsc/base/log.hpp>
#include <dsc/decode/obj.hpp>
#include <dsc/decode/ply_header.hpp>
#include <dsc/text/reading.hpp>
#include <dsc/text/words.hpp>

#include "io/bytes.hpp"
#include "io/codecs.hpp"
#include "io/ply_body.hpp"

namespace dsc::io {
namespace {

using namespace decode::ply;

template <class Body>
class PlyReader {
public:
    PlyReader(const Header& header, Body body, std::size_t size, text::Place end_of_header,
              std::vector<DataArray>* further)
        : header_(header),
          body_(std::move(body)),
          size_(size),
          header_place_(end_of_header),
          further_(further) {}

    surface::TriangleMesh read() {
        check_header();
        for (const Element& element : header_.elements) {
            if (element.name == "vertex")
                read_vertices(element);
            else if (element.name == "face")
                read_faces(element);
            else if (element.name == "tristrips")
                read_strips(element);
            else
                skip_element(element);
        }
        if (!body_.ended()) {
            text::fail("io.count", body_.place(), "data after the last element",
                       "the counts of the header are wrong: export the file again");
        }
        if (further_ != nullptr) {
            // A header may list the vertices in two parts, with different properties in each.
            const auto partial = [&](const DataArray& a) {
                return a.values.size() != mesh_.points.size();
            };
            further_->erase(std::remove_if(further_->begin(), further_->end(), partial),
                            further_->end());
        }
        return std::move(mesh_);
    }

private:
    /// A false count must not make the program reserve much memory or loop for very long.
    void check_header() {
        bool vertex = false;
        for (const Element& element : header_.elements) {
            std::size_t least = 0;
            for (const Property& p : element.properties)
                least += Body::least_size(p.count ? *p.count : p.type);
            if (element.count > 0 && least == 0) {
                text::fail("io.syntax", header_place_,
                           "element " + text::in_quotes(element.name) + " has no properties",
                           text::export_again);
            }
            if (least > 0 && element.count > size_ / least + 1) {
                text::fail(
                    "io.truncated", header_place_,
                    fmt::format(
                        "the header announces {} elements {}, more than a file of {} can contain",
                        element.count, text::in_quotes(element.name), text::counted(size_, "byte")),
                    text::copy_again);
            }
            if (element.name == "vertex") {
                vertex = true;
                points_ = element.count;
            }
        }
        if (!vertex)
            text::fail("io.syntax", header_place_, "the header has no element 'vertex'",
                       text::export_again);
        if (points_ > std::numeric_limits<std::uint32_t>::max()) {
            text::fail("io.count", header_place_, "more than 4294967295 vertices",
                       "split the file");
        }
    }

    void skip_property(const Property& p) {
        if (p.count)
            body_.skip_list(p.type, list_size(p));
        else
            body_.skip(p.type);
    }
    /// Skips an element. Logs a warning if it looks like a part of the surface: a list of integers,
    /// or an edge.
    void skip_element(const Element& element) {
        const bool lists =
            std::any_of(element.properties.begin(), element.properties.end(),
                        [](const Property& p) { return p.count && is_integer(p.type); });
        if (element.count > 0 && (lists || element.name == "edge")) {
            log(LogLevel::warning,
                fmt::format("{}: element {} ({}) is not read; only the elements 'vertex', 'face' "
                            "and 'tristrips' of a PLY file are read",
                            header_place_.file, text::in_quotes(element.name), element.count));
        }
        for (std::uint64_t i = 0; i < element.count; ++i) {
            body_.begin_element();
            for (const Property& p : element.properties) skip_property(p);
            body_.end_element(element.name);
        }
    }

    std::uint64_t list_size(const Property& p) {
        const std::int64_t count = body_.integer(*p.count);
        if (count < 0)
            text::fail("io.count", body_.place(), fmt::format("a list of {} values", count),
                       text::export_again);
        return static_cast<std::uint64_t>(count);
    }

    void read_vertices(const Element& element) {
        std::vector<int> axes;  // 0 to 2: coordinate; 3 to 5: colour; from 6: further number; -1:
                                // other
        std::array<int, 3> seen{};
        const bool coloured = has_colours(element);
        for (const Property& p : element.properties) {
            const int axis = p.name == "x" ? 0 : p.name == "y" ? 1 : p.name == "z" ? 2 : -1;
            if (axis >= 0 && p.count)
                text::fail("io.syntax", header_place_,
                           "coordinate " + text::in_quotes(p.name) + " is a list",
                           text::export_again);
            if (axis >= 0) ++seen[static_cast<std::size_t>(axis)];
            axes.push_back(coloured && axis < 0 ? channel(p) : axis);
            if (further_ != nullptr && is_further(p)) {
                axes.back() = 6 + static_cast<int>(further_->size());
                further_->push_back({std::string(p.name), {}});
                further_->back().values.reserve(element.count);
            }
        }
        if (seen != std::array<int, 3>{1, 1, 1}) {
            text::fail("io.syntax", header_place_,
                       "element 'vertex' needs each of the properties x, y, z once",
                       text::export_again);
        }
        mesh_.points.reserve(element.count);
        for (std::uint64_t i = 0; i < element.count; ++i) {
            Vec3 p;
            std::array<std::uint8_t, 3> colour{};
            body_.begin_element();
            for (std::size_t k = 0; k < axes.size(); ++k) {
                if (axes[k] < 0)
                    skip_property(element.properties[k]);
                else if (axes[k] > 5)
                    (*further_)[static_cast<std::size_t>(axes[k] - 6)].values.push_back(
                        body_.any(element.properties[k].type));
                else if (axes[k] > 2)
                    colour[static_cast<std::size_t>(axes[k] - 3)] =
                        read_byte(element.properties[k].type);
                else
                    p[axes[k]] = body_.real(element.properties[k].type);
            }
            body_.end_element(element.name);
            mesh_.points.push_back(p);
            if (coloured) mesh_.colours.push_back(colour);
        }
    }

    /// Whether the property is a single float or double and does not belong to the position, the
    /// normal or the colour.
    static bool is_further(const Property& p) {
        constexpr std::array<std::string_view, 10> known = {"x",  "y",   "z",     "nx",   "ny",
                                                            "nz", "red", "green", "blue", "alpha"};
        return !p.count && !is_integer(p.type) &&
               std::find(known.begin(), known.end(), p.name) == known.end();
    }

    /// 3, 4 or 5 for red, green or blue as bytes, else -1: colours of another type are not read.
    static int channel(const Property& p) {
        if (p.count || p.type != Type::uint8) return -1;
        return p.name == "red" ? 3 : p.name == "green" ? 4 : p.name == "blue" ? 5 : -1;
    }

    static bool has_colours(const Element& element) {
        std::array<int, 3> seen{};
        for (const Property& p : element.properties) {
            if (const int k = channel(p); k > 0) ++seen[static_cast<std::size_t>(k - 3)];
        }
        return seen == std::array<int, 3>{1, 1, 1};
    }

    /// In a text body, a value may be larger than the byte that the header announces.
    std::uint8_t read_byte(Type type) {
        const std::int64_t value = body_.integer(type);
        if (value < 0 || value > 255) {
            text::fail("io.syntax", body_.place(),
                       fmt::format("colour {} is not a byte (0 to 255)", value),
                       text::export_again);
        }
        return static_cast<std::uint8_t>(value);
    }

    static bool is_corners(const Property& p) {
        return p.count && (p.name == "vertex_indices" || p.name == "vertex_index");
    }

    /// An element of faces or of strips has one list of corners.
    void require_corners(const Element& element) {
        int lists = 0;
        for (const Property& p : element.properties) {
            if (!is_corners(p)) continue;
            ++lists;
            if (!is_integer(p.type))
                text::fail("io.syntax", header_place_, "vertex indices are fractions",
                           text::export_again);
        }
        if (lists != 1) {
            text::fail(
                "io.syntax", header_place_,
                "element " + text::in_quotes(element.name) + " needs one list vertex_indices",
                text::export_again);
        }
    }

    void read_faces(const Element& element) {
        require_corners(element);
        mesh_.faces.reserve(element.count);
        for (std::uint64_t i = 0; i < element.count; ++i) {
            body_.begin_element();
            for (const Property& p : element.properties) {
                if (is_corners(p))
                    read_corners(p, i);
                else
                    skip_property(p);
            }
            body_.end_element(element.name);
        }
    }

    /// Strips of triangles; -1 ends a strip. Each corner after the second makes a triangle with the
    /// two corners before it, with alternating orientation. A repeated corner changes the
    /// orientation and makes no triangle.
    void read_strips(const Element& element) {
        require_corners(element);
        for (std::uint64_t i = 0; i < element.count; ++i) {
            body_.begin_element();
            for (const Property& p : element.properties) {
                if (is_corners(p))
                    read_strip(p);
                else
                    skip_property(p);
            }
            body_.end_element(element.name);
        }
    }

    void read_strip(const Property& p) {
        polygon_.clear();
        for (std::uint64_t left = list_size(p); left > 0; --left) {
            const std::int64_t index = body_.integer(p.type);
            if (index == -1) {
                polygon_.clear();
                continue;
            }
            if (index < 0 || static_cast<std::uint64_t>(index) >= points_) {
                text::fail("io.index", body_.place(),
                           fmt::format("strip: vertex index {} of {}", index, points_),
                           "PLY counts from 0; export the file again");
            }
            polygon_.push_back(static_cast<std::uint32_t>(index));
            const std::size_t count = polygon_.size();
            if (count < 3) continue;
            std::uint32_t a = polygon_[count - 3], b = polygon_[count - 2];
            const std::uint32_t c = polygon_[count - 1];
            if (a == b || b == c || a == c) continue;
            if (count % 2 == 0) std::swap(a, b);
            mesh_.faces.push_back({a, b, c});
        }
    }

    void read_corners(const Property& p, std::uint64_t face) {
        const std::uint64_t count = list_size(p);
        if (count < 3) {
            text::fail("io.syntax", body_.place(),
                       fmt::format("face {} with {}, at least 3 are needed", face,
                                   text::counted(count, "corner")),
                       text::export_again);
        }
        polygon_.clear();
        for (std::uint64_t k = 0; k < count; ++k) {
            const std::int64_t index = body_.integer(p.type);
            if (index < 0 || static_cast<std::uint64_t>(index) >= points_) {
                text::fail("io.index", body_.place(),
                           fmt::format("face {}: vertex index {} of {}", face, index, points_),
                           "PLY counts from 0; export the file again");
            }
            polygon_.push_back(static_cast<std::uint32_t>(index));
        }
        decode::append_fan(mesh_.faces, polygon_);
    }

    const Header& header_;
    Body body_;
    std::size_t size_;
    text::Place header_place_;
    std::vector<DataArray>* further_;  ///< may be null
    std::uint64_t points_ = 0;
    surface::TriangleMesh mesh_;
    std::vector<std::uint32_t> polygon_;
};

}  // namespace

surface::TriangleMesh decode_ply(std::string_view content, std::string_view file,
                                 std::vector<DataArray>* further) {
    const Header header = read_header(content, file);
    const text::Place place{file, header.lines};
    if (header.order) {
        const BinaryBody body(content, file, header.size, *header.order);
        return PlyReader(header, body, content.size(), place, further).read();
    }
    const TextBody body(content.substr(header.size), file, header.lines + 1);
    return PlyReader(header, body, content.size(), place, further).read();
}

std::string encode_ply(const surface::TriangleMesh& mesh, const std::vector<DataArray>& points,
                       const std::vector<Vec3>& normals) {
    std::string further;
    for (const DataArray& a : points) further += "property double " + a.name + "\n";
    std::string out = fmt::format(
        "ply\nformat binary_little_endian 1.0\nelement vertex {}\nproperty double x\nproperty "
        "double y\nproperty double z\n{}{}{}element face {}\nproperty list uchar int "
        "vertex_indices\nend_header\n",
        mesh.points.size(),
        normals.empty() ? "" : "property float nx\nproperty float ny\nproperty float nz\n",
        mesh.colours.empty() ? ""
                             : "property uchar red\nproperty uchar green\nproperty uchar blue\n",
        further, mesh.faces.size());
    out.reserve(out.size() + (39 + 8 * points.size()) * mesh.points.size() +
                13 * mesh.faces.size());
    for (std::size_t i = 0; i < mesh.points.size(); ++i) {
        for (int k = 0; k < 3; ++k) append_bytes(out, mesh.points[i][k]);
        if (!normals.empty()) {
            for (int k = 0; k < 3; ++k) append_bytes(out, static_cast<float>(normals[i][k]));
        }
        if (!mesh.colours.empty()) {
            for (const std::uint8_t c : mesh.colours[i]) append_bytes(out, c);
        }
        for (const DataArray& a : points) append_bytes(out, a.values[i]);
    }
    for (const auto& face : mesh.faces) {
        append_bytes(out, std::uint8_t{3});
        for (const std::uint32_t v : face) append_bytes(out, static_cast<std::int32_t>(v));
    }
    return out;
}

}  // namespace dsc::io
