#pragma once
// Lattices round the zero sets of functions, and their interface built and counted triangle by
// triangle.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <numeric>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include <dsc/generate/graded_lattice.hpp>

namespace dsc::generate::implicit {

using Function = std::function<double(const Vec3&)>;
using Tets = std::vector<std::array<std::uint32_t, 4>>;

/// A lattice whose finest cells are where the distance function is small.
struct Sampled {
    GradedLattice lattice;
    Tets tets;
    std::vector<double> values;
    std::vector<double> volumes;
};

inline double clipped(double x) { return std::clamp(x, -0.5, 0.5); }

/// `near` is small where the finest cells shall be, in units of length; `value` gives the values of
/// the vertices.
inline Sampled sample(double cell, const Function& near, const Function& value) {
    LatticeOptions options;
    options.cell = cell;
    options.box = 1.5;
    GradedLattice lattice(options, {}, "test");
    const auto chosen = [&](const GradedLattice::Leaf& leaf) {
        return leaf.edge > 1.01 * cell &&
               std::abs(near(lattice.points()[leaf.vertices[8]])) < 1.5 * leaf.edge;
    };
    while (lattice.split_where(chosen) < lattice.points().size()) {
    }
    Sampled out{std::move(lattice), {}, {}, {}};
    out.tets = out.lattice.tets();
    out.volumes = out.lattice.volumes();
    for (const Vec3& x : out.lattice.points()) out.values.push_back(value(x));
    return out;
}

struct Counted {
    long shells = 0, euler = 0;
    long genus() const { return shells - euler / 2; }
};

/// Marching tets: a vertex per cut edge, one or two triangles per cut tet; every edge must have two
/// triangles.
inline Counted march(const Tets& tets, const std::vector<double>& values, bool* closed = nullptr) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> vertices;
    std::map<std::pair<std::size_t, std::size_t>, int> edges;
    std::vector<std::array<std::size_t, 3>> triangles;
    for (const auto& tet : tets) {
        std::vector<std::uint32_t> in, out;
        for (const std::uint32_t v : tet) (values[v] > 0 ? in : out).push_back(v);
        if (in.empty() || out.empty()) continue;
        const auto cut = [&](std::uint32_t a, std::uint32_t b) {
            return vertices.emplace(std::minmax(a, b), vertices.size()).first->second;
        };
        if (in.size() == 2) {
            const std::array<std::size_t, 4> q = {cut(in[0], out[0]), cut(in[0], out[1]),
                                                  cut(in[1], out[1]), cut(in[1], out[0])};
            triangles.push_back({q[0], q[1], q[2]});
            triangles.push_back({q[0], q[2], q[3]});
        } else {
            const auto& one = in.size() == 1 ? in : out;
            const auto& three = in.size() == 1 ? out : in;
            triangles.push_back(
                {cut(one[0], three[0]), cut(one[0], three[1]), cut(one[0], three[2])});
        }
    }
    std::vector<std::size_t> parent(vertices.size());
    std::iota(parent.begin(), parent.end(), std::size_t{0});
    const auto find = [&](std::size_t i) {
        while (parent[i] != i) i = parent[i] = parent[parent[i]];
        return i;
    };
    for (const auto& t : triangles) {
        for (std::size_t i = 0; i < 3; ++i) {
            ++edges[std::minmax(t[i], t[(i + 1) % 3])];
            parent[find(t[i])] = find(t[(i + 1) % 3]);
        }
    }
    if (closed != nullptr) {
        *closed =
            std::all_of(edges.begin(), edges.end(), [](const auto& e) { return e.second == 2; });
    }
    Counted counted;
    for (std::size_t i = 0; i < parent.size(); ++i) counted.shells += find(i) == i ? 1 : 0;
    counted.euler = static_cast<long>(vertices.size()) - static_cast<long>(edges.size()) +
                    static_cast<long>(triangles.size());
    return counted;
}

inline double ball(const Vec3& x, const Vec3& centre, double radius) {
    return radius - (x - centre).norm();
}
inline double torus(const Vec3& x, double ring, double tube) {
    return tube - std::hypot(std::hypot(x[0], x[1]) - ring, x[2]);
}

}  // namespace dsc::generate::implicit
