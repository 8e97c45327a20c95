#include <doctest/doctest.h>
#include <dsc/mesh/adopt.hpp>
#include <dsc/mesh/project.hpp>
#include <dsc/mesh/validate.hpp>
#include <cstdio>
#include "meshes.hpp"
using namespace dsc;
using namespace dsc::mesh;
TEST_CASE("x") {
  for (int n : {14, 16, 20, 24, 30, 40}) for (int rule : {0, 1}) {
    TetMesh m = test::ball_grid(n, 1.0);
    if (rule == 1) for (std::size_t t = 0; t < m.tets.size(); ++t) { m.labels[t] = 1; for (auto v : m.tets[t]) if (m.points[v].norm() > 1.0 + 0.4 * 3.0 / n) m.labels[t] = 0; }
    Complex c = adopt(m, "m");
    double before = labelled_volume(c);
    ProjectReport r = project_interface(c, [](const Vec3& p) { return Vec3(p.normalized()); });
    std::vector<int> h(11);
    for (TetId t = 0; t < c.tet_slots(); ++t) ++h[int(c.quality(t) * 10)];
    double rmin = 2, rmax = 0;
    for (VertexId v : c.interface_vertices()) { rmin = std::min(rmin, c.position(v).norm()); rmax = std::max(rmax, c.position(v).norm()); }
    std::printf("n %d: v %zu off %zu relabelled %zu minq %.3f vol %.4f -> %.4f (4.18879) r %.4f..%.4f hist", n, r.vertices, r.off_surface, r.relabelled, r.min_quality, before, labelled_volume(c), rmin, rmax);
    for (int k : h) std::printf(" %d", k);
    std::printf("\n");
    CHECK(validate(c).valid());
  }
}
