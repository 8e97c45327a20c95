#pragma once
// Fixtures for the tests: ordinary surfaces and clouds, and hostile ones.

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <dsc/cloud/target.hpp>
#include <dsc/mesh/complex.hpp>
#include <dsc/surface/surface_view.hpp>

namespace dsc::conformance {

/// An interface with its cloud and tets.
struct Fixture {
    std::string name;
    surface::SurfaceView view;
    std::shared_ptr<const mesh::Complex> complex;  ///< complex of the view; null if there are only
                                                   ///< triangles
    std::optional<cloud::TargetCloud> cloud;
    Box3 box = cloud::simulation_box();
};

/// Builds what all fixtures share. Called before tests run in processes of their own, each of them
/// has it without building it again.
void prepare_fixtures();

/// A sphere in a box of tets, and 1,500 points of an ellipsoid as its target.
Fixture ordinary();
/// The unit sphere as 20 * 4^level triangles with an ellipsoid of points, without tets.
Fixture triangles(unsigned level);

/// Surfaces that a bad run may have: an empty one, one tet, slivers, faces without area, coinciding
/// points, tiny and distant surfaces, many pieces, vertices that may not move.
std::vector<Fixture> hostile_surfaces();
/// The ordinary surface with no cloud, one point, points on a line, all points in one place, few
/// distant points.
std::vector<Fixture> hostile_clouds();

/// The fixture at a step: the surface is moved a little towards its centroid. Its previous
/// positions are those of the step before, every fifth vertex has not arrived, and the ages count
/// from 0.
Fixture at_step(const Fixture& fixture, std::uint64_t step);

/// The fixture moved as a rigid body: x becomes rotation * x + shift.
struct Motion {
    Eigen::Matrix3d rotation;
    Vec3 shift;
};
Fixture moved(const Fixture& fixture, const Motion& motion);

/// The fixture with all its lengths multiplied by `factor`, the box too.
Fixture scaled(const Fixture& fixture, double factor);

/// Vertex i of the result is vertex order[i] of the fixture. The birth ids stay in their places,
/// because those of a view ascend: a vertex gets another birth id.
Fixture reordered(const Fixture& fixture, const std::vector<std::uint32_t>& order);

}  // namespace dsc::conformance
