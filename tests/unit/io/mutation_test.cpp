// Files that are damaged at random: a reader gives a sound mesh or one IoError, never anything
// else.
#include <algorithm>

#include <doctest/doctest.h>

#include <dsc/io/read.hpp>
#include <dsc/io/write.hpp>
#include <dsc/surface/measure.hpp>

#include "files.hpp"

using namespace dsc;
using namespace dsc::io;

namespace {

std::string damaged(std::string text, RandomStream& random) {
    const std::uint64_t changes = 1 + random.index(6);
    for (std::uint64_t i = 0; i < changes && !text.empty(); ++i) {
        const std::size_t at = random.index(text.size());
        switch (random.index(6)) {
            case 0: text[at] = static_cast<char>(random.index(256)); break;
            case 1: text[at] = "0123456789-+.e \n/"[random.index(17)]; break;
            case 2: text.erase(at, 1 + random.index(20)); break;
            case 3:
                text.insert(at, text.substr(random.index(text.size()), random.index(30)));
                break;
            case 4: text.resize(at); break;
            default: text[at] = static_cast<char>(text[at] ^ (1 << random.index(8))); break;
        }
    }
    return text;
}

surface::TriangleMesh small_surface() {
    surface::TriangleMesh m = test::awkward_mesh();
    for (int i = 0; i < 20; ++i) m.points.emplace_back(i, 0.1 * i, -i * i);
    for (std::uint32_t i = 4; i < 20; ++i) m.faces.push_back({i, i + 1, i + 2});
    return m;
}

/// Reads with everything that may be read, which must fit together.
void read_whole(const std::filesystem::path& file) {
    std::vector<DataArray> arrays;
    const surface::TriangleMesh m = read_surface(file, &arrays);
    surface::require_sound(m);
    for (const DataArray& a : arrays) CHECK(a.values.size() == m.points.size());
}

/// Runs the action; counts refusals.
template <class Action>
bool refused(Action&& action) {
    try {
        action();
        return false;
    } catch (const IoError& error) {
        const std::string text = error.what();
        CHECK(text.find('\n') == std::string::npos);
        CHECK(error.code().substr(0, 3) == "io.");
        return true;
    }
}

}  // namespace

TEST_CASE("damaged surfaces") {
    const test::Folder folder;
    for (const char* name : {"m.obj", "m.off", "m.ply", "m.stl"}) {
        CAPTURE(name);
        surface::TriangleMesh m = small_surface();
        m.points[1] = Vec3(1, 2, 3);  // floats have no room for 1e308
        write_surface(folder / name, m, {{"gap", std::vector<double>(m.points.size(), 0.5)}});
        const std::string good = test::content_of(folder / name);
        RandomStream random(RandomKey{1, 0, 0, 0});
        int refusals = 0;
        for (int i = 0; i < 1500; ++i) {
            const auto file = folder.with(std::string("bad_") + name, damaged(good, random));
            if (refused([&] { read_whole(file); })) ++refusals;
        }
        CHECK(refusals > 300);
    }
}

TEST_CASE("damaged text stl and text ply") {
    const test::Folder folder;
    std::string stl = "solid\n";
    for (int i = 0; i < 8; ++i) {
        stl += "facet normal 0 0 1\nouter loop\nvertex 0 0 " + std::to_string(i) +
               "\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n";
    }
    stl += "endsolid\n";
    const std::string ply = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty "
                            "float y\nproperty float z\nproperty double gap\nelement face 2\n"
                            "property list uchar int vertex_indices\nend_header\n0 0 0 nan\n1 0 0 "
                            "1\n0 1 0 2.5\n0 0 1 -3\n3 0 1 2\n4 0 1 2 3\n";
    RandomStream random(RandomKey{2, 0, 0, 0});
    for (int i = 0; i < 1500; ++i) {
        refused([&] { read_whole(folder.with("a.stl", damaged(stl, random))); });
        refused([&] { read_whole(folder.with("a.ply", damaged(ply, random))); });
    }
}

TEST_CASE("damaged volumes") {
    const test::Folder folder;
    for (const char* name : {"m.dsc", "m.vtu"}) {
        CAPTURE(name);
        write_volume(folder / name, test::cube_of_tets(),
                     {{}, {{"gap", std::vector<double>(8, 0.5)}}});
        const std::string good = test::content_of(folder / name);
        RandomStream random(RandomKey{3, 0, 0, 0});
        int refusals = 0;
        for (int i = 0; i < 1000; ++i) {
            const auto file = folder.with(std::string("bad_") + name, damaged(good, random));
            const bool bad = refused([&] {
                std::vector<DataArray> arrays;
                const mesh::TetMesh m = read_volume(file, &arrays);
                for (const DataArray& a : arrays) CHECK(a.values.size() == m.points.size());
                CHECK(m.labels.size() == m.tets.size());
                for (const auto& tet : m.tets)
                    CHECK(*std::max_element(tet.begin(), tet.end()) < m.points.size());
                for (const Vec3& p : m.points) CHECK(p.allFinite());
            });
            if (bad) ++refusals;
        }
        CHECK(refusals > 300);
    }
}
