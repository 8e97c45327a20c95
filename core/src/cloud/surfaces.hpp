#pragma once
// The built-in shapes behind a common interface.

#include <memory>

#include <dsc/base/random.hpp>
#include <dsc/cloud/shapes.hpp>

namespace dsc::cloud {

class Shape {
public:
    virtual ~Shape() = default;
    /// A point on the shape, uniform by area.
    virtual Vec3 sample(RandomStream& random) const = 0;
    virtual Box3 box() const = 0;
    virtual ShapeMesh mesh() const = 0;
};

std::unique_ptr<Shape> make_sphere();
std::unique_ptr<Shape> make_torus();
std::unique_ptr<Shape> make_box_tunnel();
std::unique_ptr<Shape> make_teapot();

}  // namespace dsc::cloud
