#pragma once
// Files and meshes for the tests.

#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include <unistd.h>

#include <dsc/base/error.hpp>
#include <dsc/base/random.hpp>
#include <dsc/mesh/tet_mesh.hpp>
#include <dsc/surface/triangle_mesh.hpp>

namespace dsc::io::test {

/// A folder of its own that goes away with the object.
class Folder {
public:
    Folder() {
        static std::atomic<int> number{0};
        path_ = std::filesystem::temp_directory_path() /
                ("dsc_io_test_" + std::to_string(::getpid()) + "_" + std::to_string(number++));
        std::filesystem::create_directories(path_);
    }
    ~Folder() {
        std::error_code ignored;
        std::filesystem::permissions(path_, std::filesystem::perms::owner_all, ignored);
        std::filesystem::remove_all(path_, ignored);
    }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;

    std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
    const std::filesystem::path& path() const { return path_; }
    std::filesystem::path with(const std::string& name, const std::string& content) const {
        // Some file systems flush a file that is cut and written again; a new one is quicker.
        std::filesystem::remove(path_ / name);
        std::ofstream(path_ / name, std::ios::binary) << content;
        return path_ / name;
    }
    std::size_t files() const {
        return static_cast<std::size_t>(
            std::distance(std::filesystem::directory_iterator(path_), {}));
    }

private:
    std::filesystem::path path_;
};

inline std::string content_of(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

struct Refusal {
    std::string code;
    std::string message;  ///< with FILE for the file's path
};

/// Runs what must throw IoError.
template <class Action>
Refusal refusal(const std::filesystem::path& file, Action&& action) {
    try {
        action(file);
    } catch (const IoError& error) {
        std::string text = error.what();
        const std::string name = file.string();
        for (std::size_t at = text.find(name); at != std::string::npos; at = text.find(name)) {
            text.replace(at, name.size(), "FILE");
        }
        return {error.code(), text};
    }
    return {"", "accepted"};
}

/// Points with awkward digits: denormal, huge, tiny, thirds, negative zero.
inline surface::TriangleMesh awkward_mesh() {
    surface::TriangleMesh m;
    m.points = {{0.1, 1.0 / 3.0, -0.0},
                {5e-324, 1.7976931348623157e308, 2.2250738585072014e-308},
                {5000000.001, -4999999.999, 123456789.12345679},
                {-1e-17, 6.02214076e23, 0.30000000000000004}};
    m.faces = {{0, 1, 2}, {2, 1, 3}, {3, 0, 2}};
    return m;
}

inline bool same_bits(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
    if (a.size() != b.size()) return false;
    for (std::size_t i = 0; i < a.size(); ++i) {
        for (int k = 0; k < 3; ++k) {
            if (a[i][k] != b[i][k] || std::signbit(a[i][k]) != std::signbit(b[i][k])) return false;
        }
    }
    return true;
}

/// Cube of six positive tets round its diagonal, at a place where every digit counts.
inline mesh::TetMesh cube_of_tets(const Vec3& corner = {0.1, 0.2, 0.3}, double edge = 1.0 / 3.0) {
    mesh::TetMesh m;
    for (int i = 0; i < 8; ++i)
        m.points.push_back(corner + edge * Vec3(i & 1, (i >> 1) & 1, (i >> 2) & 1));
    m.tets = {{0, 1, 3, 7}, {0, 3, 2, 7}, {0, 2, 6, 7}, {0, 6, 4, 7}, {0, 4, 5, 7}, {0, 5, 1, 7}};
    m.labels = {0, 1, 1, 0, 2, 2147483647};
    return m;
}

}  // namespace dsc::io::test
