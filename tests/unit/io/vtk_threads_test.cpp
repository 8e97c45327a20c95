// VTK works on the thread that calls it, because the user decides how many threads the program has.
#include <doctest/doctest.h>

#include <dsc/io/read.hpp>
#include <dsc/io/series.hpp>
#include <dsc/io/write.hpp>

#include "files.hpp"

using namespace dsc;
using namespace dsc::io;

namespace {

constexpr std::uint32_t cells = 100000;

std::size_t threads_of_this_process() {
    return static_cast<std::size_t>(
        std::distance(std::filesystem::directory_iterator("/proc/self/task"), {}));
}

}  // namespace

TEST_CASE("a large volume is written and read as .vtu without further threads") {
    mesh::TetMesh m;
    for (std::uint32_t i = 0; i < cells; ++i) {
        const Vec3 at(i, 0, 0);
        m.points.insert(m.points.end(),
                        {at, at + Vec3(1, 0, 0), at + Vec3(0, 1, 0), at + Vec3(0, 0, 1)});
        m.tets.push_back({4 * i, 4 * i + 1, 4 * i + 2, 4 * i + 3});
        m.labels.push_back(1);
    }
    const test::Folder folder;
    const std::size_t before = threads_of_this_process();
    write_volume(folder / "m.vtu", m);
    CHECK(threads_of_this_process() == before);
    CHECK(read_volume(folder / "m.vtu").tets == m.tets);
    CHECK(threads_of_this_process() == before);
}

TEST_CASE("a large surface is written and read as .vtp without further threads") {
    surface::TriangleMesh m;
    for (std::uint32_t i = 0; i < cells; ++i) {
        const Vec3 at(i, 0, 0);
        m.points.insert(m.points.end(), {at, at + Vec3(1, 0, 0), at + Vec3(0, 1, 0)});
        m.faces.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    const test::Folder folder;
    const std::size_t before = threads_of_this_process();
    write_vtp(folder / "m.vtp", m, {});
    CHECK(threads_of_this_process() == before);
    SurfaceData data;
    CHECK(read_vtp(folder / "m.vtp", &data).faces == m.faces);
    CHECK(threads_of_this_process() == before);
}
