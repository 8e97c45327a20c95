#include "solid.hpp"

#include <cmath>
#include <functional>
#include <map>

#include <dsc/mesh/complex.hpp>
#include <dsc/mesh/face_groups.hpp>

namespace dsc::corner_box {
namespace {

constexpr double quarter_turn = 1.5707963267948966;

using Node = std::array<int, 3>;
Node plus(const Node& a, const Node& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
int levels(const Node& node) { return std::abs(node[0]) + std::abs(node[1]) + std::abs(node[2]); }

// Collects tets between integer nodes; a node becomes a point when it is first used.
class Builder {
public:
    explicit Builder(std::function<Vec3(const Node&)> place) : place_(std::move(place)) {}

    std::uint32_t point(const Node& node) {
        const auto [entry, is_new] =
            index_.try_emplace(node, static_cast<std::uint32_t>(solid_.points.size()));
        if (is_new) {
            solid_.points.push_back(place_(node));
            nodes_.push_back(node);
        }
        return entry->second;
    }
    void add(const Node& a, const Node& b, const Node& c, const Node& d) {
        solid_.tets.push_back({point(a), point(b), point(c), point(d)});
    }
    const Vec3& at(const Node& node) { return solid_.points[point(node)]; }

    Solid finish(int divisions) {
        for (int axis = 0; axis < 3; ++axis) {
            Node pole = {0, 0, 0};
            const auto a = static_cast<std::size_t>(axis);
            for (const int end : {0, 1}) {
                pole[a] = end == 0 ? divisions : -divisions;
                solid_.poles[a][static_cast<std::size_t>(end)] = point(pole);
            }
        }
        const auto corners = [this](std::size_t t) { return &solid_.tets[t]; };
        mesh::for_each_face(solid_.points.size(), solid_.tets.size(), corners,
                            [this](const mesh::FaceKey& key, std::span<const mesh::FaceUse> uses) {
                                if (uses.size() == 1)
                                    solid_.faces.push_back({{key[0], key[1], key[2]}, octant(key)});
                            });
        return std::move(solid_);
    }

private:
    // No face crosses a plane between octants, and no face of the surface lies in such a plane.
    Octant octant(const mesh::FaceKey& key) const {
        unsigned bits = 0;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            if (nodes_[key[0]][axis] + nodes_[key[1]][axis] + nodes_[key[2]][axis] > 0)
                bits |= 1U << axis;
        }
        return static_cast<Octant>(bits);
    }

    std::function<Vec3(const Node&)> place_;
    Solid solid_;
    std::vector<Node> nodes_;
    std::map<Node, std::uint32_t> index_;
};

// The nodes of one octant with at most `divisions` levels, cut as a tet is cut into smaller tets:
// each cube of nodes gives an upright tet, an octahedron and an inverted tet, as far as they are
// inside.
void fill_octant(Builder& builder, const Node& signs, int divisions) {
    const Node x = {signs[0], 0, 0}, y = {0, signs[1], 0}, z = {0, 0, signs[2]};
    for (int k = 0; k < divisions; ++k) {
        for (int j = 0; j + k < divisions; ++j) {
            for (int i = 0; i + j + k < divisions; ++i) {
                const Node p = {i * signs[0], j * signs[1], k * signs[2]};
                const Node px = plus(p, x), py = plus(p, y), pz = plus(p, z);
                builder.add(p, px, py, pz);
                const int room = divisions - (i + j + k);
                if (room < 2) continue;
                const Node pxy = plus(px, y), pyz = plus(py, z), pzx = plus(pz, x);
                // Four tets around the shortest of the octahedron's three diagonals; ring[m] is
                // opposite ring[m + 2].
                struct Diagonal {
                    Node from, to;
                    std::array<Node, 4> ring;
                };
                const std::array<Diagonal, 3> diagonals = {{{px, pyz, {py, pz, pzx, pxy}},
                                                            {py, pzx, {pz, px, pxy, pyz}},
                                                            {pz, pxy, {px, py, pyz, pzx}}}};
                const Diagonal* shortest = &diagonals[0];
                const auto length = [&](const Diagonal& d) {
                    return (builder.at(d.from) - builder.at(d.to)).norm();
                };
                for (const Diagonal& d : diagonals) {
                    if (length(d) < length(*shortest) * (1 - 1e-9)) shortest = &d;
                }
                for (std::size_t m = 0; m < 4; ++m) {
                    builder.add(shortest->from, shortest->to, shortest->ring[m],
                                shortest->ring[(m + 1) % 4]);
                }
                if (room >= 3) builder.add(pxy, pyz, pzx, plus(pxy, z));
            }
        }
    }
}

}  // namespace

Solid sphere(const Vec3& centre, double radius, unsigned divisions) {
    const int n = static_cast<int>(divisions);
    Builder builder([&](const Node& node) -> Vec3 {
        const int level = levels(node);
        if (level == 0) return centre;
        // Sines make the arcs along the borders of the octants equal.
        Vec3 direction;
        for (std::size_t a = 0; a < 3; ++a) {
            direction[static_cast<Eigen::Index>(a)] =
                std::sin(quarter_turn * static_cast<double>(node[a]) / level);
        }
        return centre + radius * static_cast<double>(level) / n * direction.normalized();
    });
    for (unsigned octant = 0; octant < 8; ++octant) {
        fill_octant(builder, {octant & 1U ? 1 : -1, octant & 2U ? 1 : -1, octant & 4U ? 1 : -1}, n);
    }
    return builder.finish(n);
}

Solid box(const Vec3& centre, const Vec3& half_size, unsigned divisions) {
    const int n = static_cast<int>(divisions);
    Builder builder([&](const Node& node) -> Vec3 {
        return centre +
               Vec3(half_size.x() * node[0], half_size.y() * node[1], half_size.z() * node[2]) / n;
    });
    for (int k = -n; k < n; ++k) {
        for (int j = -n; j < n; ++j) {
            for (int i = -n; i < n; ++i) {
                // The corners of the cell whose coordinates have an even sum form the tet in the
                // middle.
                const auto corner = [&](int x, int y, int z) { return Node{i + x, j + y, k + z}; };
                const int flip = (i + j + k) & 1;
                const auto at = [&](int x, int y, int z) { return corner(x ^ flip, y, z); };
                const Node a = at(0, 0, 0), b = at(1, 1, 0), c = at(1, 0, 1), d = at(0, 1, 1);
                builder.add(a, b, c, d);
                builder.add(a, b, c, at(1, 0, 0));
                builder.add(a, b, d, at(0, 1, 0));
                builder.add(a, c, d, at(0, 0, 1));
                builder.add(b, c, d, at(1, 1, 1));
            }
        }
    }
    return builder.finish(n);
}

}  // namespace dsc::corner_box
