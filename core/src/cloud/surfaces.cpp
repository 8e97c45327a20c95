// The shapes sphere, torus and box with a tunnel.
#include "surfaces.hpp"

#include <cmath>
#include <map>
#include <numbers>
#include <utility>

namespace dsc::cloud {

namespace {

using Face = std::array<std::uint32_t, 3>;
constexpr double pi = std::numbers::pi;

std::uint32_t add(ShapeMesh& mesh, const Vec3& p) {
    mesh.points.push_back(p);
    return static_cast<std::uint32_t>(mesh.points.size() - 1);
}

void add_quad(ShapeMesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    mesh.faces.push_back({a, b, c});
    mesh.faces.push_back({a, c, d});
}

class Sphere final : public Shape {
public:
    Vec3 sample(RandomStream& random) const override {
        // Equal heights correspond to equal areas of a sphere.
        const double z = random.uniform(-1.0, 1.0);
        const double angle = random.uniform(0.0, 2.0 * pi);
        const double r = std::sqrt(1.0 - z * z);
        return {r * std::cos(angle), r * std::sin(angle), z};
    }
    Box3 box() const override { return {Vec3::Constant(-1.0), Vec3::Constant(1.0)}; }

    ShapeMesh mesh() const override {
        ShapeMesh mesh;
        for (const double s : {1.0, -1.0})
            for (int axis = 0; axis < 3; ++axis) add(mesh, s * Vec3::Unit(axis));
        // Octahedron: x y z are 0 1 2, their opposites 3 4 5; eight faces, oriented outwards.
        for (std::uint32_t corner = 0; corner < 8; ++corner) {
            const std::uint32_t x = corner & 1U ? 3 : 0, y = corner & 2U ? 4 : 1,
                                z = corner & 4U ? 5 : 2;
            const bool mirrored =
                ((corner & 1U) + ((corner >> 1U) & 1U) + ((corner >> 2U) & 1U)) % 2 == 1;
            mesh.faces.push_back(mirrored ? Face{x, z, y} : Face{x, y, z});
        }
        for (int level = 0; level < 6; ++level) refine(mesh);
        return mesh;
    }

private:
    static void refine(ShapeMesh& mesh) {
        std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
        const auto middle = [&](std::uint32_t a, std::uint32_t b) {
            const auto [place, added] = middles.try_emplace(std::minmax(a, b), 0);
            if (added) place->second = add(mesh, (mesh.points[a] + mesh.points[b]).normalized());
            return place->second;
        };
        std::vector<Face> faces;
        faces.reserve(4 * mesh.faces.size());
        for (const auto& [a, b, c] : std::exchange(mesh.faces, {})) {
            const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
            for (const Face& face :
                 {Face{a, ab, ca}, Face{ab, b, bc}, Face{ca, bc, c}, Face{ab, bc, ca}})
                faces.push_back(face);
        }
        mesh.faces = std::move(faces);
    }
};

class Torus final : public Shape {
public:
    static constexpr double major = 1.0, minor = 0.4;

    static Vec3 at(double around, double tube) {
        const double r = major + minor * std::cos(tube);
        return {r * std::cos(around), r * std::sin(around), minor * std::sin(tube)};
    }
    Vec3 sample(RandomStream& random) const override {
        // The area of a ring grows with its radius: points are accepted in this proportion.
        double tube;
        do {
            tube = random.uniform(0.0, 2.0 * pi);
        } while (random.uniform() * (major + minor) > major + minor * std::cos(tube));
        return at(random.uniform(0.0, 2.0 * pi), tube);
    }
    Box3 box() const override {
        const Vec3 half(major + minor, major + minor, minor);
        return {-half, half};
    }
    ShapeMesh mesh() const override {
        constexpr std::uint32_t rings = 384, sides = 160;
        ShapeMesh mesh;
        for (std::uint32_t i = 0; i < rings; ++i)
            for (std::uint32_t j = 0; j < sides; ++j)
                add(mesh, at(2.0 * pi * i / rings, 2.0 * pi * j / sides));
        const auto id = [](std::uint32_t i, std::uint32_t j) {
            return (i % rings) * sides + j % sides;
        };
        for (std::uint32_t i = 0; i < rings; ++i)
            for (std::uint32_t j = 0; j < sides; ++j)
                add_quad(mesh, id(i, j), id(i + 1, j), id(i + 1, j + 1), id(i, j + 1));
        return mesh;
    }
};

class BoxTunnel final : public Shape {
public:
    static constexpr double half_width = 1.0, half_height = 0.6, radius = 0.5;

    Vec3 sample(RandomStream& random) const override {
        constexpr double wall = 2.0 * half_width * 2.0 * half_height;
        constexpr double lid = 4.0 * half_width * half_width - pi * radius * radius;
        constexpr double tunnel = 2.0 * pi * radius * 2.0 * half_height;
        double pick = random.uniform(0.0, 4.0 * wall + 2.0 * lid + tunnel);
        const double z = random.uniform(-half_height, half_height);
        if (pick < tunnel) {
            const double angle = random.uniform(0.0, 2.0 * pi);
            return {radius * std::cos(angle), radius * std::sin(angle), z};
        }
        pick -= tunnel;
        const double along = random.uniform(-half_width, half_width);
        if (pick < wall) return {half_width, along, z};
        if (pick < 2.0 * wall) return {-half_width, along, z};
        if (pick < 3.0 * wall) return {along, half_width, z};
        if (pick < 4.0 * wall) return {along, -half_width, z};
        const double side = pick - 4.0 * wall < lid ? half_height : -half_height;
        double x, y;
        do {
            x = random.uniform(-half_width, half_width);
            y = random.uniform(-half_width, half_width);
        } while (x * x + y * y < radius * radius);
        return {x, y, side};
    }
    Box3 box() const override {
        const Vec3 half(half_width, half_width, half_height);
        return {-half, half};
    }
    ShapeMesh mesh() const override {
        constexpr std::uint32_t sides = 256;  // a multiple of 8, so that rays go through the
                                              // corners of the box
        ShapeMesh mesh;
        for (std::uint32_t i = 0; i < sides; ++i) {
            const double angle = 2.0 * pi * i / sides;
            const Eigen::Vector2d ray(std::cos(angle), std::sin(angle));
            Eigen::Vector2d outer = ray * (half_width / ray.cwiseAbs().maxCoeff());
            for (int k = 0; k < 2; ++k)  // exactly on the walls
                if (std::abs(std::abs(outer[k]) - half_width) < 1e-12)
                    outer[k] = std::copysign(half_width, outer[k]);
            for (const double z : {-half_height, half_height})
                add(mesh, {radius * ray.x(), radius * ray.y(), z});
            for (const double z : {-half_height, half_height}) add(mesh, {outer.x(), outer.y(), z});
        }
        for (std::uint32_t i = 0; i < sides; ++i) {
            const std::uint32_t a = 4 * i,
                                // inner low, inner high, outer low, outer high
                b = 4 * ((i + 1) % sides);
            add_quad(mesh, a + 2, b + 2, b + 3, a + 3);  // outer wall
            add_quad(mesh, b, a, a + 1, b + 1);          // tunnel, seen from its axis
            add_quad(mesh, a + 1, a + 3, b + 3, b + 1);  // top
            add_quad(mesh, b, b + 2, a + 2, a);          // bottom
        }
        return mesh;
    }
};

}  // namespace

std::unique_ptr<Shape> make_sphere() { return std::make_unique<Sphere>(); }
std::unique_ptr<Shape> make_torus() { return std::make_unique<Torus>(); }
std::unique_ptr<Shape> make_box_tunnel() { return std::make_unique<BoxTunnel>(); }

}  // namespace dsc::cloud
