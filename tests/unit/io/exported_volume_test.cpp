// MSH and MEDIT files, byte for byte and number by number: the readers here know nothing of the
// writers.
#include <cstdlib>
#include <map>
#include <sstream>

#include <doctest/doctest.h>

#include <dsc/io/write.hpp>

#include "files.hpp"

using namespace dsc;
using namespace dsc::io;
using mesh::TetMesh;

namespace {

/// Two tets of different labels, with coordinates that take every digit.
TetMesh two_tets() {
    TetMesh m;
    m.points = {{0, 0, 0}, {0.1, 0, 0}, {0, 1e22, 0}, {0, 0, 3}, {0, 0, -0.30000000000000004}};
    m.tets = {{0, 1, 2, 3}, {0, 2, 1, 4}};
    m.labels = {7, 0};
    return m;
}

TetMesh random_tets(std::uint32_t count, std::uint64_t seed) {
    RandomStream random(RandomKey{seed, 0, 0, 0});
    TetMesh m;
    for (std::uint32_t i = 0; i < count; ++i) {
        const Vec3 at(random.normal() * 1e6, random.normal(), random.normal() * 1e-9);
        m.points.insert(m.points.end(),
                        {at, at + Vec3(1, 0, random.uniform()), at + Vec3(0, 1, random.uniform()),
                         at + Vec3(0, 0, 2 + random.uniform())});
        m.tets.push_back({4 * i, 4 * i + 1, 4 * i + 2, 4 * i + 3});
        m.labels.push_back(static_cast<mesh::Label>(random.index(4) * random.index(1000000)));
    }
    m.points.emplace_back(5e-324, 1.7976931348623157e308, -0.0);  // no tet uses it
    return m;
}

/// Reads words; strtod, which is not what the writers are built on, reads the numbers.
class Words {
public:
    explicit Words(const std::string& text) : in_(text) {}
    std::string word() {
        std::string text;
        in_ >> text;
        return text;
    }
    std::uint64_t count() { return std::strtoull(word().c_str(), nullptr, 10); }
    double real() { return std::strtod(word().c_str(), nullptr); }
    Vec3 point() {
        const double x = real(), y = real(), z = real();
        return {x, y, z};
    }
    std::array<std::uint32_t, 4> tet() {
        std::array<std::uint32_t, 4> corners{};
        for (std::uint32_t& v : corners) v = static_cast<std::uint32_t>(count() - 1);
        return corners;
    }
    void expect(const std::string& wanted) { REQUIRE(word() == wanted); }

private:
    std::istringstream in_;
};

TetMesh read_medit(const std::string& text) {
    Words words(text);
    TetMesh m;
    for (const char* word : {"MeshVersionFormatted", "2", "Dimension", "3", "Vertices"})
        words.expect(word);
    for (std::uint64_t left = words.count(); left > 0; --left) {
        m.points.push_back(words.point());
        words.expect("0");
    }
    words.expect("Tetrahedra");
    for (std::uint64_t left = words.count(); left > 0; --left) {
        m.tets.push_back(words.tet());
        m.labels.push_back(static_cast<mesh::Label>(words.count()));
    }
    words.expect("End");
    return m;
}

/// By the names of the physical groups, the tets back in the order of their numbers.
TetMesh read_msh(const std::string& text) {
    Words words(text);
    TetMesh m;
    for (const char* word : {"$MeshFormat", "4.1", "0", "8", "$EndMeshFormat", "$PhysicalNames"})
        words.expect(word);
    std::map<std::uint64_t, mesh::Label> labels;
    const std::uint64_t groups = words.count();
    for (std::uint64_t i = 0; i < groups; ++i) {
        words.expect("3");
        const std::uint64_t tag = words.count();
        labels[tag] = std::stoi(words.word().substr(7));  // "label_N"
    }
    for (const char* word : {"$EndPhysicalNames", "$Entities", "0", "0", "0"}) words.expect(word);
    REQUIRE(words.count() == groups);
    std::map<std::uint64_t, Box3> boxes;
    for (std::uint64_t i = 0; i < groups; ++i) {
        const std::uint64_t tag = words.count();
        boxes[tag].low = words.point();
        boxes[tag].high = words.point();
        words.expect("1");
        REQUIRE(words.count() == tag);
        words.expect("0");
    }
    for (const char* word : {"$EndEntities", "$Nodes", "1"}) words.expect(word);
    const std::uint64_t nodes = words.count();
    words.expect("1");
    REQUIRE(words.count() == nodes);
    words.expect("3");
    REQUIRE(labels.count(words.count()) == 1);
    words.expect("0");
    REQUIRE(words.count() == nodes);
    for (std::uint64_t i = 1; i <= nodes; ++i) REQUIRE(words.count() == i);
    for (std::uint64_t i = 1; i <= nodes; ++i) m.points.push_back(words.point());
    for (const char* word : {"$EndNodes", "$Elements"}) words.expect(word);
    REQUIRE(words.count() == groups);
    const std::uint64_t elements = words.count();
    words.expect("1");
    REQUIRE(words.count() == elements);
    m.tets.resize(elements);
    m.labels.resize(elements);
    for (std::uint64_t i = 0; i < groups; ++i) {
        words.expect("3");
        const std::uint64_t tag = words.count();
        words.expect("4");
        for (std::uint64_t left = words.count(); left > 0; --left) {
            const std::uint64_t t = words.count() - 1;
            m.tets.at(t) = words.tet();
            m.labels.at(t) = labels.at(tag);
            for (const std::uint32_t v : m.tets.at(t))
                CHECK(boxes.at(tag).contains(m.points.at(v)));
        }
    }
    words.expect("$EndElements");
    return m;
}

}  // namespace

TEST_CASE("medit: what is written, byte for byte") {
    const test::Folder folder;
    write_volume(folder / "m.mesh", two_tets());
    CHECK(test::content_of(folder / "m.mesh") ==
          "MeshVersionFormatted 2\n\nDimension 3\n\nVertices\n5\n0 0 0 0\n0.1 0 0 0\n0 1e+22 0 "
          "0\n0 0 3 0\n"
          "0 0 -0.30000000000000004 0\n\nTetrahedra\n2\n1 2 3 4 7\n1 3 2 5 0\n\nEnd\n");
}

TEST_CASE("msh: what is written, byte for byte") {
    const test::Folder folder;
    write_volume(folder / "m.msh", two_tets());
    CHECK(test::content_of(folder / "m.msh") ==
          "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n3 1 \"label_0\"\n3 8 "
          "\"label_7\"\n"
          "$EndPhysicalNames\n$Entities\n0 0 0 2\n1 0 0 -0.30000000000000004 0.1 1e+22 0 1 1 0\n"
          "8 0 0 0 0.1 1e+22 3 1 8 0\n$EndEntities\n$Nodes\n1 5 1 5\n3 1 0 5\n1\n2\n3\n4\n5\n0 0 "
          "0\n0.1 0 0\n"
          "0 1e+22 0\n0 0 3\n0 0 -0.30000000000000004\n$EndNodes\n$Elements\n2 2 1 2\n3 1 4 1\n2 1 "
          "3 2 5\n"
          "3 8 4 1\n1 1 2 3 4\n$EndElements\n");
}

TEST_CASE("many random tets come back from both formats, bit for bit and in their order") {
    const test::Folder folder;
    for (const std::uint64_t seed : {1U, 2U, 3U}) {
        CAPTURE(seed);
        const TetMesh m = random_tets(1500, seed);
        write_volume(folder / "m.mesh", m);
        write_volume(folder / "m.msh", m);
        for (const TetMesh& back : {read_medit(test::content_of(folder / "m.mesh")),
                                    read_msh(test::content_of(folder / "m.msh"))}) {
            CHECK(test::same_bits(back.points, m.points));
            CHECK(back.tets == m.tets);
            CHECK(back.labels == m.labels);
        }
    }
}

TEST_CASE("a label without a tag is refused, and medit holds it") {
    const test::Folder folder;
    const TetMesh m = test::cube_of_tets();  // its last label is the greatest there is
    try {
        write_volume(folder / "m.msh", m);
        FAIL("no error");
    } catch (const GeometryError& error) {
        CHECK(error.code() == "volume.label");
        CHECK(std::string(error.what()) == "volume: tet 5 has the label 2147483647; .msh can store "
                                           "labels from 0 to 2147483646, write a .vtu or .dsc");
    }
    CHECK(folder.files() == 0);
    write_volume(folder / "m.mesh", m);
    CHECK(read_medit(test::content_of(folder / "m.mesh")).labels == m.labels);
}
