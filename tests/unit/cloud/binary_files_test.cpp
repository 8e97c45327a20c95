// PCD and PLY.
#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <limits>
#include <vector>

#include <fcntl.h>
#include <unistd.h>

#include <doctest/doctest.h>

#include <dsc/cloud/read.hpp>

#include "files.hpp"

using dsc::Vec3;
using dsc::cloud::Cloud;
using dsc::cloud::read_cloud;
using dsc::cloud::ReadReport;

namespace {

constexpr double missing = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

// Millimetres and less beside five million metres; a float would round them away.
const std::vector<Vec3> far{{5000000.001, -5000000.002, 5123456.789},
                            {5000000.0010000005, 4999999.9990000002, 0.1},
                            {5e6 + 1.0 / 3.0, 1e-17, -2.5e6 - 1.0 / 7.0}};

template <class T>
void put(std::string& bytes, T value, bool big = false) {
    std::array<char, sizeof(T)> raw;
    std::memcpy(raw.data(), &value, sizeof(T));
    if (big) std::reverse(raw.begin(), raw.end());
    bytes.append(raw.data(), raw.size());
}

std::string lines(const std::vector<Vec3>& points) {
    std::string text;
    char line[100];
    for (const Vec3& p : points) {
        std::snprintf(line, sizeof line, "%.17g %.17g %.17g\n", p.x(), p.y(), p.z());
        text += line;
    }
    return text;
}

std::string doubles(const std::vector<Vec3>& points, bool big) {
    std::string bytes;
    for (const Vec3& p : points)
        for (int k = 0; k < 3; ++k) put(bytes, p[k], big);
    return bytes;
}

std::string pcd_header(std::size_t points, std::string_view data) {
    const std::string n = std::to_string(points);
    return "# .PCD v0.7\nVERSION 0.7\nFIELDS x y z\nSIZE 8 8 8\nTYPE F F F\nCOUNT 1 1 1\nWIDTH " +
           n + "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " + n + "\nDATA " + std::string(data) +
           "\n";
}

/// LZF with literal runs only, field after field, as PCL lays it out.
std::string pcd_compressed(const std::vector<Vec3>& points) {
    std::string plain, packed;
    for (int k = 0; k < 3; ++k)
        for (const Vec3& p : points) put(plain, p[k]);
    for (std::size_t at = 0; at < plain.size(); at += 32) {
        const std::string run = plain.substr(at, 32);
        packed += static_cast<char>(run.size() - 1);
        packed += run;
    }
    std::string bytes = pcd_header(points.size(), "binary_compressed");
    put(bytes, static_cast<std::uint32_t>(packed.size()));
    put(bytes, static_cast<std::uint32_t>(plain.size()));
    return bytes + packed;
}

std::string ply_header(std::string_view format, std::size_t points, std::string_view type,
                       std::string_view more = "") {
    std::string text = "ply\nformat " + std::string(format) +
                       " 1.0\ncomment made by hand\nelement vertex " + std::to_string(points) +
                       "\n";
    for (const char* axis : {" x\n", " y\n", " z\n"})
        text += "property " + std::string(type) + axis;
    return text + std::string(more) + "end_header\n";
}

using Points = std::vector<Vec3>;
struct Sample {
    std::string name;
    std::string (*make)(const Points&);
};
const Sample samples[] = {
    {"ascii.pcd",
     [](const Points& points) { return pcd_header(points.size(), "ascii") + lines(points); }},
    {"binary.pcd",
     [](const Points& points) {
         return pcd_header(points.size(), "binary") + doubles(points, false);
     }},
    {"compressed.pcd", pcd_compressed},
    {"ascii.ply",
     [](const Points& points) {
         return ply_header("ascii", points.size(), "double") + lines(points);
     }},
    {"little.ply",
     [](const Points& points) {
         return ply_header("binary_little_endian", points.size(), "double") +
                doubles(points, false);
     }},
    {"big.ply",
     [](const Points& points) {
         return ply_header("binary_big_endian", points.size(), "double") + doubles(points, true);
     }},
};

}  // namespace

TEST_CASE("PCD and PLY keep doubles far from the origin") {
    const test::Folder folder;
    Points many;
    for (int i = 0; i < 1000; ++i)
        many.push_back(far[static_cast<std::size_t>(i) % 3] + Vec3::Constant(i * 1e-3 / 7.0));
    for (const Sample& sample : samples) {
        CAPTURE(sample.name);
        ReadReport report;
        const Cloud cloud = read_cloud(folder.write(sample.name, sample.make(far)), &report);
        CHECK(cloud.points == far);
        CHECK(cloud.colours.empty());
        CHECK(cloud.source == folder.path(sample.name).string());
        CHECK(report.format == (sample.name.find("pcd") == std::string::npos ? "PLY" : "PCD"));
        CHECK(report.points == 3);
        CHECK(report.dropped_non_finite == 0);
        CHECK(read_cloud(folder.write(sample.name, sample.make(many))).points == many);
    }
}

TEST_CASE("PCD and PLY: points with NaN or infinity are dropped and counted") {
    const test::Folder folder;
    Points points = far;
    points.insert(points.begin() + 1, Vec3(missing, 1, 2));
    points.insert(points.begin() + 3, Vec3(1, infinity, 2));
    points.push_back(Vec3(1, 2, -infinity));
    for (const Sample& sample : samples) {
        CAPTURE(sample.name);
        ReadReport report;
        CHECK(read_cloud(folder.write(sample.name, sample.make(points)), &report).points == far);
        CHECK(report.points == 6);
        CHECK(report.dropped_non_finite == 3);
        const auto path =
            folder.write(sample.name, sample.make({{missing, missing, missing}, {0, infinity, 0}}));
        CHECK(folder.strip(test::error_of([&] { read_cloud(path); })) ==
              "io.non_finite 6: " + sample.name +
                  ": all 2 points have NaN or infinite coordinates; save a cloud with finite "
                  "coordinates");
    }
}

TEST_CASE("a file cut off anywhere is an error, never a shorter cloud and never a crash") {
    const test::Folder folder;
    for (const Sample& sample : samples) {
        const std::string whole = sample.make(far);
        const std::size_t end = whole.back() == '\n' ? whole.size() - 1 : whole.size();
        for (std::size_t size = 1; size < end; ++size) {
            const auto path = folder.write(sample.name, std::string_view(whole).substr(0, size));
            const std::string outcome = test::error_of([&] { read_cloud(path); });
            if (outcome != "no error") continue;
            // Only digits of the last number of a text can be missing without a trace.
            CAPTURE(sample.name);
            CAPTURE(size);
            CHECK(sample.name.substr(0, 5) == "ascii");
            CHECK(whole.find_last_of(' ') < size);
        }
    }
}

TEST_CASE("a damaged header or body never crashes and never makes points up") {
    const test::Folder folder;
    for (const Sample& sample : samples) {
        const std::string whole = sample.make(far);
        std::size_t refused = 0;
        for (std::size_t at = 0; at < whole.size(); ++at)
            for (const char wrong : {'9', '-', ' ', '\n', '\xff'}) {
                std::string bytes = whole;
                bytes[at] = wrong;
                const auto path = folder.write(sample.name, bytes);
                std::size_t points = 0;
                refused +=
                    test::error_of([&] { points = read_cloud(path).points.size(); }) != "no error";
                CHECK(points <= 3);
            }
        CHECK(refused > 100);
    }
}

TEST_CASE("PCD: floats, integers, further fields, colours, line ends") {
    const test::Folder folder;
    const auto cloud = [&](std::string_view text) {
        return read_cloud(folder.write("a.pcd", text));
    };
    const std::string tail = "WIDTH 2\nHEIGHT 1\nPOINTS 2\nDATA ascii\n";
    const Points expected{{1, 2, 3}, {-4, 5.5, 6}};
    CHECK(cloud("FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\n" + tail + "1 2 3\n-4 5.5 6\n")
              .points == expected);
    CHECK(
        cloud("FIELDS x y z\r\nSIZE 4 4 4\r\nTYPE F F F\r\nWIDTH 2\r\nHEIGHT 1\r\nPOINTS 2\r\nDATA "
              "ascii\r\n1 2 3\r\n"
              "-4 5.5 6\r\n")
            .points == expected);
    CHECK(cloud("FIELDS i x h z y\nSIZE 1 8 4 4 2\nTYPE U F F F I\nCOUNT 1 1 3 1 1\n" + tail +
                "7 1 0 0 0 3 2\n8 -4 9 9 9 6 5\n")
              .points == Points{{1, 2, 3}, {-4, 5, 6}});
    const Cloud coloured = cloud("FIELDS x y z rgb\nSIZE 8 8 8 4\nTYPE F F F U\nCOUNT 1 1 1 1\n" +
                                 tail + "1 2 3 16744448\n-4 5.5 6 255\n");
    CHECK(coloured.points == expected);
    REQUIRE(coloured.colours.size() == 2);
    CHECK(coloured.colours[0] == std::array<std::uint8_t, 3>{255, 128, 0});
    CHECK(coloured.colours[1] == std::array<std::uint8_t, 3>{0, 0, 255});

    std::string organised = "FIELDS x y z _\nSIZE 4 4 4 1\nTYPE F F F U\nCOUNT 1 1 1 4\nWIDTH "
                            "2\nHEIGHT 2\nVIEWPOINT 1 2 3 1 0 0 0\nPOINTS 4\n"
                            "DATA binary\n";
    for (int i = 0; i < 4; ++i) {
        for (const float c : {1.5F, 2.0F, static_cast<float>(i)}) put(organised, c);
        put(organised, std::uint32_t{0});
    }
    CHECK(cloud(organised).points == Points{{1.5, 2, 0}, {1.5, 2, 1}, {1.5, 2, 2}, {1.5, 2, 3}});
}

TEST_CASE("PLY: floats, integers, further properties and elements, colours, line ends") {
    const test::Folder folder;
    const auto cloud = [&](std::string_view text) {
        return read_cloud(folder.write("a.ply", text));
    };
    const Points expected{{1, 2, 3}, {-4, 5, 6}};
    for (const char* type :
         {"float", "float32", "double", "float64", "int", "short", "char", "int16"})
        CHECK_MESSAGE(cloud(ply_header("ascii", 2, type) + "1 2 3\n-4 5 6\n").points == expected,
                      type);
    CHECK(
        cloud("ply\r\nformat ascii 1.0\r\nelement vertex 2\r\nproperty double x\r\nproperty double "
              "y\r\nproperty double "
              "z\r\nend_header\r\n1 2 3\r\n-4 5 6\r\n")
            .points == expected);
    const Cloud coloured =
        cloud(ply_header("ascii", 2, "double",
                         "property float nx\nproperty uchar red\nproperty uchar green\nproperty "
                         "uchar blue\nproperty uchar alpha\nproperty double quality\n") +
              "1 2 3 0 255 128 0 255 0.5\n-4 5 6 0 0 0 255 255 0.5\n");
    CHECK(coloured.points == expected);
    REQUIRE(coloured.colours.size() == 2);
    CHECK(coloured.colours[0] == std::array<std::uint8_t, 3>{255, 128, 0});
    CHECK(coloured.colours[1] == std::array<std::uint8_t, 3>{0, 0, 255});

    for (const bool big : {false, true}) {
        std::string bytes =
            "ply\nformat " + std::string(big ? "binary_big_endian" : "binary_little_endian") +
            " 1.0\nelement camera 1\nproperty float view_px\nproperty float view_py\nelement "
            "vertex 2\n"
            "property uchar flag\nproperty float z\nproperty double y\nproperty float x\n"
            "element face 2\nproperty list uchar int vertex_indices\nend_header\n";
        put(bytes, 1.0F, big);
        put(bytes, 2.0F, big);
        for (const Vec3& p : expected) {
            put(bytes, std::uint8_t{1});
            put(bytes, static_cast<float>(p.z()), big);
            put(bytes, p.y(), big);
            put(bytes, static_cast<float>(p.x()), big);
        }
        for (int face = 0; face < 2; ++face) {
            put(bytes, std::uint8_t{3});
            for (const std::int32_t i : {0, 1, 0}) put(bytes, i, big);
        }
        CHECK(cloud(bytes).points == expected);
    }
}

TEST_CASE("PCL says nothing") {
    const test::Folder folder;
    const int keep_out = ::dup(1), keep_err = ::dup(2);
    const int sink = ::open(folder.path("spoken").c_str(), O_CREAT | O_WRONLY | O_TRUNC, 0600);
    std::fflush(nullptr);
    ::dup2(sink, 1);
    ::dup2(sink, 2);
    std::vector<std::string> outcomes;
    for (const Sample& sample : samples)
        for (const std::string& bytes :
             {sample.make(far), sample.make({{missing, 0, 0}, {0, 0, 0}})})
            for (const char* more : {"", "more than the header says\n"}) {
                const auto path = folder.write(sample.name, bytes + more);
                outcomes.push_back(test::error_of([&] { read_cloud(path); }));
            }
    std::string broken = pcd_compressed(far);
    std::fill(broken.end() - 60, broken.end(),
              '\xff');  // LZF references to before the start: only PCL can tell
    const auto path = folder.write("broken.pcd", broken);
    const std::string refusal = folder.strip(test::error_of([&] { read_cloud(path); }));
    std::fflush(nullptr);
    ::dup2(keep_out, 1);
    ::dup2(keep_err, 2);
    for (const int fd : {keep_out, keep_err, sink}) ::close(fd);
    CHECK(test::slurp(folder.path("spoken")).empty());
    CHECK(refusal.find("io.syntax 6: broken.pcd: PCL's PCD reader does not accept the file; ") ==
          0);
    for (const std::string& outcome : outcomes) CHECK(outcome == "no error");
}
