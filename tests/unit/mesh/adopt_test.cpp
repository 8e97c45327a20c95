#include <string>

#include <doctest/doctest.h>

#include <dsc/base/error.hpp>
#include <dsc/mesh/adopt.hpp>
#include <dsc/mesh/validate.hpp>

#include "meshes.hpp"

using namespace dsc;
using namespace dsc::mesh;

namespace {
std::string refusal(const TetMesh& m) {
    try {
        adopt(m, "file.dsc");
    } catch (const GeometryError& error) {
        return error.what();
    }
    return "";
}
}  // namespace

TEST_CASE("adopt re-orients and drops unused vertices") {
    TetMesh m = test::cube_grid(6);
    for (std::size_t i = 0; i < m.tets.size(); i += 3) std::swap(m.tets[i][0], m.tets[i][1]);
    m.points.push_back(Vec3(0.123, 0, 0));
    AdoptReport report;
    const Complex c = adopt(m, "m", &report);
    CHECK(report.reoriented_tets >= m.tets.size() / 3);
    CHECK(report.dropped_vertices == 1);
    CHECK(validate(c).faults == std::vector<std::string>{});
    CHECK(count_interface(c).vertices == 98);
    CHECK(count_interface(c).faces == 192);
    CHECK(labelled_volume(c) == doctest::Approx(8.0));
}

TEST_CASE("adopt refuses what is not a box of tets, naming the first offender and the count") {
    TetMesh m = test::cube_grid(6);
    CHECK(refusal(TetMesh{}) ==
          "file.dsc: the mesh has no tets; provide a box filled with labelled tets");
    TetMesh index = m;
    index.tets[5][2] = 343;
    CHECK(refusal(index) == "file.dsc: tet 5 uses vertex 343 of 343; indices count from 0");
    TetMesh flat = m;
    flat.points[flat.tets[9][0]] = flat.points[flat.tets[9][1]];
    CHECK(refusal(flat).find("has zero volume (") != std::string::npos);
    TetMesh twice = m;
    twice.tets.push_back(twice.tets.back());
    twice.labels.push_back(twice.labels.back());
    CHECK(refusal(twice) ==
          "file.dsc: tet 1080 at (1.5, 1, 1) has a face that two other tets already have (4 in "
          "total); remove duplicate tets: some writers repeat the last line of the file");
    TetMesh gap = m;
    gap.tets.pop_back();
    gap.labels.pop_back();
    CHECK(refusal(gap) ==
          "file.dsc: the tets' volumes add up to 26.9583333333, their bounding box has 27; the "
          "tets must fill an axis-parallel box without gaps or overlaps");
    TetMesh labels = m;
    labels.labels.pop_back();
    CHECK(refusal(labels) ==
          "file.dsc: 1079 labels for 1080 tets; provide exactly one label per tet");
    TetMesh folded = m;
    folded.points[171] = Vec3(1.4, 1.4, 1.4);  // the centre vertex dragged through its neighbours
    CHECK(refusal(folded).find("lies on the same side of a face as its neighbour") !=
          std::string::npos);
    TetMesh nan = m;
    nan.points[3].x() = std::nan("");
    CHECK(refusal(nan) == "file.dsc: vertex 3 has a coordinate that is not finite; fix or remove "
                          "this vertex and export the mesh again");
}

TEST_CASE("checkerboard labels on 4x4x4 cells are unpinched, exactly") {
    const auto cell = [](double x) { return static_cast<int>(std::floor((x + 1.0) / 0.5)); };
    TetMesh m = test::grid(8, 2.0, [&](const Vec3& p) {
        if (p.cwiseAbs().maxCoeff() > 1.0) return 0;
        return (cell(p.x()) + cell(p.y()) + cell(p.z())) % 2;
    });
    AdoptReport report;
    const Complex c = adopt(m, "checkerboard", &report, 0.0);
    CHECK(report.unpinched_vertices > 50);
    CHECK(validate(c).faults == std::vector<std::string>{});
    const InterfaceCounts counts = count_interface(c);
    CHECK(counts.euler() % 2 == 0);
    CHECK(counts.shells >= 1);
}

TEST_CASE("two opposite tets round one vertex are unpinched") {
    TetMesh m = test::grid(4, 1.0, [](const Vec3& p) {
        return p.cwiseAbs().maxCoeff() < 0.5 && (p.minCoeff() > 0 || p.maxCoeff() < 0) ? 1 : 0;
    });
    AdoptReport report;
    const Complex c = adopt(m, "bow tie", &report, 0.0);
    CHECK(report.unpinched_vertices == 1);
    CHECK(count_interface(c).shells == 2);
    CHECK(validate(c).faults == std::vector<std::string>{});
}

TEST_CASE("small components vanish, loaded labels may touch the box") {
    TetMesh m = test::ball_grid(10, 1.0);
    // One tet of another label far from the ball.
    AdoptReport report;
    m.labels[0] = 0;
    std::size_t lonely = 0;
    for (std::size_t t = 0; t < m.tets.size(); ++t) {
        Vec3 centroid = Vec3::Zero();
        for (const auto v : m.tets[t]) centroid += 0.25 * m.points[v];
        if ((centroid - Vec3(1.05, 1.05, 1.05)).norm() < 0.2) lonely = t;
    }
    m.labels[lonely] = 5;
    const Complex c = adopt(m, "m", &report);
    CHECK(report.vanished_components == 1);
    CHECK(count_interface(c).shells == 1);
    TetMesh touching = test::grid(6, 1.5, [](const Vec3& p) { return p.x() < 0 ? 1 : 0; });
    const Complex half = adopt(touching, "half");
    CHECK(validate(half).faults == std::vector<std::string>{});
    CHECK(count_interface(half).euler() == 2);
    CHECK(labelled_volume(half) == doctest::Approx(13.5));
}
