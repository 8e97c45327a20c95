#include "peers_mesh.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <dsc/base/random.hpp>
#include <dsc/geometry/quality.hpp>

#include "resources.hpp"

namespace dsc::bench {
namespace {

constexpr double displacement = 0.45;  // of the cells' edge, the largest
constexpr double least_rough_quality = 0.02;
constexpr double box = 1.5;
constexpr double degrees = 180.0 / 3.14159265358979323846;

using Corners = std::array<std::uint32_t, 4>;

double quality(const mesh::TetMesh& mesh, const Corners& tet) {
    const auto& p = mesh.points;
    return geometry::tet_quality(p[tet[0]], p[tet[1]], p[tet[2]], p[tet[3]]);
}

double volume(const mesh::TetMesh& mesh, const Corners& tet) {
    const auto& p = mesh.points;
    return geometry::tet_volume(p[tet[0]], p[tet[1]], p[tet[2]], p[tet[3]]);
}

std::vector<std::vector<std::uint32_t>> stars(const mesh::TetMesh& mesh) {
    std::vector<std::vector<std::uint32_t>> stars(mesh.points.size());
    for (std::uint32_t t = 0; t < mesh.tets.size(); ++t) {
        for (const std::uint32_t v : mesh.tets[t]) stars[v].push_back(t);
    }
    return stars;
}

bool is_free(const mesh::TetMesh& mesh, std::uint32_t v, const std::vector<std::uint32_t>& star) {
    return mesh.points[v].cwiseAbs().maxCoeff() < box &&
           std::all_of(star.begin(), star.end(), [&](std::uint32_t t) {
               return mesh.labels[t] == mesh.labels[star.front()];
           });
}

void displace(mesh::TetMesh& mesh, double largest) {
    const auto all_stars = stars(mesh);
    for (std::uint32_t v = 0; v < mesh.points.size(); ++v) {
        const auto& star = all_stars[v];
        if (!is_free(mesh, v, star)) continue;
        RandomStream random({.seed = 1, .instance = stream_id("bench.peers"), .element = v});
        const Vec3 before = mesh.points[v];
        for (double& x : mesh.points[v]) x += random.uniform(-largest, largest);
        const bool good = std::all_of(star.begin(), star.end(), [&](std::uint32_t t) {
            return quality(mesh, mesh.tets[t]) > least_rough_quality;
        });
        if (!good) mesh.points[v] = before;
    }
}

/// The six edges of a tet, each with the two other corners.
constexpr std::array<Corners, 6> edges = {
    {{0, 1, 2, 3}, {0, 2, 1, 3}, {0, 3, 1, 2}, {1, 2, 0, 3}, {1, 3, 0, 2}, {2, 3, 0, 1}}};

double least_dihedral(const mesh::TetMesh& mesh, const Corners& tet) {
    double least = std::numeric_limits<double>::infinity();
    for (const Corners& edge : edges) {
        const auto corner = [&](std::size_t i) { return mesh.points[tet[edge[i]]]; };
        const Vec3 along = corner(1) - corner(0);
        const Vec3 first = along.cross(corner(2) - corner(0));
        const Vec3 second = along.cross(corner(3) - corner(0));
        least = std::min(least, std::atan2(first.cross(second).norm(), first.dot(second)));
    }
    return degrees * least;
}

double mean_edge(const mesh::TetMesh& mesh) {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> all;
    all.reserve(6 * mesh.tets.size());
    for (const Corners& tet : mesh.tets) {
        for (const Corners& edge : edges) all.push_back(std::minmax(tet[edge[0]], tet[edge[1]]));
    }
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    double sum = 0.0;
    for (const auto& [a, b] : all) sum += (mesh.points[b] - mesh.points[a]).norm();
    return all.empty() ? 0.0 : sum / static_cast<double>(all.size());
}

}  // namespace

mesh::TetMesh rough_ball(const Plugins& plugins, unsigned cells) {
    const std::vector<std::string> parameters = {"shape=sphere", "radius=1.0", "project=true",
                                                 "box=" + std::to_string(box),
                                                 "cells=" + std::to_string(cells)};
    mesh::TetMesh mesh = initial_complex(plugins, strategy("grid", parameters)).to_mesh();
    displace(mesh, displacement * 2.0 * box / cells);
    return mesh;
}

MeshFigures measure_mesh(const mesh::TetMesh& mesh) {
    MeshFigures figures{.vertices = mesh.points.size(),
                        .tets = mesh.tets.size(),
                        .mean_edge = mean_edge(mesh),
                        .least_dihedral = 180.0};
    std::vector<double> qualities;
    for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
        const Corners& tet = mesh.tets[t];
        qualities.push_back(quality(mesh, tet));
        figures.least_dihedral = std::min(figures.least_dihedral, least_dihedral(mesh, tet));
        figures.volume += volume(mesh, tet);
        if (mesh.labels[t] > 0) figures.ball_volume += volume(mesh, tet);
    }
    figures.least_quality = quantile(qualities, 0.0);
    figures.low_quality = quantile(qualities, 0.05);
    return figures;
}

}  // namespace dsc::bench
