// Further numbers of points: what a PLY and a VTU contain besides place, normal and colour.
#include <algorithm>
#include <bit>
#include <limits>

#include <doctest/doctest.h>

#include <dsc/io/read.hpp>
#include <dsc/io/write.hpp>

#include "files.hpp"

using namespace dsc;
using namespace dsc::io;
using surface::TriangleMesh;

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double no_value = std::numeric_limits<double>::quiet_NaN();

bool same_bits(const std::vector<DataArray>& a, const std::vector<DataArray>& b) {
    const auto same = [](double x, double y) {
        return std::bit_cast<std::uint64_t>(x) == std::bit_cast<std::uint64_t>(y);
    };
    return std::equal(
        a.begin(), a.end(), b.begin(), b.end(), [&](const DataArray& x, const DataArray& y) {
            return x.name == y.name && std::equal(x.values.begin(), x.values.end(),
                                                  y.values.begin(), y.values.end(), same);
        });
}

const std::vector<DataArray> awkward_arrays = {
    {"support", {0.1, 5e-324, -0.0, 1.7976931348623157e308}},
    {"gap", {no_value, -infinite, infinite, -no_value}}};

template <class Number>
void append(std::string& out, Number value, std::endian order) {
    std::array<char, sizeof(Number)> bytes = std::bit_cast<std::array<char, sizeof(Number)>>(value);
    if (order != std::endian::native) std::reverse(bytes.begin(), bytes.end());
    out.append(bytes.data(), bytes.size());
}

/// Properties in an order that nobody expects, with what is not to be given back in between.
const std::string mixed_properties =
    "element vertex 3\nproperty double gap\nproperty float y\nproperty int age\nproperty float "
    "nx\nproperty list uchar float rest\n"
    "property float x\nproperty float red\nproperty float support\nproperty float z\nproperty "
    "double alpha\n"
    "element face 1\nproperty list uchar int vertex_indices\nproperty float area\nend_header\n";

const std::vector<Vec3> mixed_points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
// In halves, which text, float and double have alike.
const std::vector<DataArray> mixed_arrays = {{"gap", {-0.5, no_value, 2.5}},
                                             {"support", {8, 0.25, infinite}}};

std::string mixed_text() {
    return "ply\nformat ascii 1.0\n" + mixed_properties +
           "-0.5 0 7 0 2 1 2 0 9 8 0 1\nnan 0 7 0 0 1 9 0.25 0 1\n2.5 1 7 0 1 nan 0 9 inf 0 1\n3 0 "
           "1 2 0.5\n";
}

std::string mixed_binary(std::endian order) {
    std::string out = std::string("ply\nformat binary_") +
                      (order == std::endian::little ? "little" : "big") + "_endian 1.0\n" +
                      mixed_properties;
    for (std::size_t i = 0; i < 3; ++i) {
        append(out, mixed_arrays[0].values[i], order);
        append(out, static_cast<float>(mixed_points[i].y()), order);
        append(out, std::int32_t{7}, order);
        append(out, 0.0F, order);
        out += static_cast<char>(i);
        for (std::size_t k = 0; k < i; ++k)
            append(out, std::numeric_limits<float>::quiet_NaN(), order);
        append(out, static_cast<float>(mixed_points[i].x()), order);
        append(out, 9.0F, order);
        append(out, static_cast<float>(mixed_arrays[1].values[i]), order);
        append(out, static_cast<float>(mixed_points[i].z()), order);
        append(out, 1.0, order);
    }
    out += '\3';
    for (const std::int32_t v : {0, 1, 2}) append(out, v, order);
    append(out, 0.5F, order);
    return out;
}

}  // namespace

TEST_CASE("further numbers of a PLY come back to the last bit, NaN and infinity among them, with "
          "colours and without") {
    const test::Folder folder;
    TriangleMesh m = test::awkward_mesh();
    for (const bool coloured : {false, true}) {
        CAPTURE(coloured);
        if (coloured) m.colours = {{1, 2, 3}, {4, 5, 6}, {7, 8, 9}, {0, 255, 128}};
        write_surface(folder / "a.ply", m, awkward_arrays);
        std::vector<DataArray> back = {{"of another file", {1}}};
        const TriangleMesh read = read_surface(folder / "a.ply", &back);
        CHECK(test::same_bits(read.points, m.points));
        CHECK(read.faces == m.faces);
        CHECK(read.colours == m.colours);
        CHECK(same_bits(back, awkward_arrays));
        write_surface(folder / "b.ply", read, back);
        CHECK(test::content_of(folder / "a.ply") == test::content_of(folder / "b.ply"));
        CHECK(test::same_bits(read_surface(folder / "a.ply").points, m.points));
    }
    write_surface(folder / "none.ply", m);
    std::vector<DataArray> back = awkward_arrays;
    read_surface(folder / "none.ply", &back);
    CHECK(back.empty());
}

TEST_CASE("all encodings: any order of the properties; lists, integers, normals and colours are "
          "not among them") {
    const test::Folder folder;
    for (const std::string& content :
         {mixed_text(), mixed_binary(std::endian::little), mixed_binary(std::endian::big)}) {
        std::vector<DataArray> back;
        const TriangleMesh read = read_surface(folder.with("m.ply", content), &back);
        CHECK(test::same_bits(read.points, mixed_points));
        CHECK(read.faces.size() == 1);
        REQUIRE(back.size() == 2);
        for (std::size_t k = 0; k < 2; ++k) {
            CHECK(back[k].name == mixed_arrays[k].name);
            REQUIRE(back[k].values.size() == 3);
            for (std::size_t i = 0; i < 3; ++i) {
                const double is = back[k].values[i], wanted = mixed_arrays[k].values[i];
                CHECK((is == wanted || (std::isnan(is) && std::isnan(wanted))));
            }
        }
    }
}

TEST_CASE("a PLY that ends among its further numbers is refused, with and without a look at them") {
    const test::Folder folder;
    for (const std::endian order : {std::endian::little, std::endian::big}) {
        const std::string whole = mixed_binary(order);
        for (std::size_t size = whole.find("end_header\n") + 11; size < whole.size(); ++size) {
            CAPTURE(size);
            const auto file = folder.with("cut.ply", whole.substr(0, size));
            std::vector<DataArray> values;
            CHECK(test::refusal(file, [&](const auto& f) { read_surface(f, &values); }).code ==
                  "io.truncated");
            CHECK(test::refusal(file, [](const auto& f) { read_surface(f); }).code ==
                  "io.truncated");
        }
    }
    const std::string text = mixed_text();
    std::vector<DataArray> values;
    const auto cut = test::refusal(folder.with("cut.ply", text.substr(0, text.find(" 9 inf"))),
                                   [&](const auto& f) { read_surface(f, &values); });
    CHECK(cut.code == "io.truncated");
}

TEST_CASE("text that is not a number is refused where it is asked for") {
    const test::Folder folder;
    std::string text = mixed_text();
    text.replace(text.find("0.25"), 4, "much");
    const auto file = folder.with("m.ply", text);
    std::vector<DataArray> values;
    const auto bad = test::refusal(file, [&](const auto& f) { read_surface(f, &values); });
    CHECK(bad.code == "io.syntax");
    CHECK(bad.message ==
          "FILE:19: 'much' is not a number; correct the line or export the file again");
    CHECK(read_surface(file).points.size() == 3);
    text.replace(text.find("much"), 4, "1e999");
    CHECK(test::refusal(folder.with("m.ply", text), [&](const auto& f) {
              read_surface(f, &values);
          }).code == "io.not_finite");
    // Coordinates are as strict as ever.
    text = mixed_text();
    text.replace(text.find("-0.5 0 7"), 8, "-0.5 nan 7");
    CHECK(test::refusal(folder.with("m.ply", text), [&](const auto& f) {
              read_surface(f, &values);
          }).code == "io.not_finite");
}

TEST_CASE(
    "vertices in two parts: an array is given back only where it has a value for each point") {
    const test::Folder folder;
    const std::string text =
        "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\nproperty "
        "float z\nproperty float gap\n"
        "element vertex 2\nproperty float x\nproperty float y\nproperty float z\nelement face 1\n"
        "property list uchar int vertex_indices\nend_header\n0 0 0 5\n1 0 0 5\n0 1 0\n0 0 1\n3 0 1 "
        "1\n";
    std::vector<DataArray> values;
    CHECK(read_surface(folder.with("m.ply", text), &values).points.size() == 4);
    CHECK(values.empty());
}

TEST_CASE("formats without further numbers leave none") {
    const test::Folder folder;
    TriangleMesh m = test::awkward_mesh();
    m.points[1] = Vec3(1, 2, 3);  // floats have no room for 1e308
    for (const char* name : {"m.obj", "m.off", "m.stl"}) {
        CAPTURE(name);
        write_surface(folder / name, m, awkward_arrays);
        std::vector<DataArray> back = awkward_arrays;
        read_surface(folder / name, &back);
        CHECK(back.empty());
    }
}

TEST_CASE("the point arrays of a VTU come back to the last bit; a DSC has none") {
    const test::Folder folder;
    const mesh::TetMesh m = test::cube_of_tets();
    const std::vector<DataArray> arrays = {
        {"gap", {0.1, no_value, -0.0, infinite, 5e-324, no_value, 1.0 / 3.0, 8}},
        {"support", {1, 2, 3, 4, 5, 6, 7, 8}}};
    write_volume(folder / "m.vtu", m, {{{"age", {1, 2, 3, 4, 5, 6}}}, arrays});
    std::vector<DataArray> back = awkward_arrays;
    const mesh::TetMesh read = read_volume(folder / "m.vtu", &back);
    CHECK(test::same_bits(read.points, m.points));
    CHECK(read.tets == m.tets);
    CHECK(same_bits(back, arrays));
    write_volume(folder / "m.dsc", m, {{}, arrays});
    read_volume(folder / "m.dsc", &back);
    CHECK(back.empty());
}
