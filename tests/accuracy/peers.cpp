// Other reconstructions, all of CGAL (GPL, so in tests only), for tests/accuracy/compare.py. They
// get positions alone, as dsc does.
//
//     dsc_peers advancing_front|scale_space|poisson CLOUD.obj OUT.off
//     dsc_peers crossings MESH.off          prints the number of pairs of faces that cross
//
// Exits 1 where a method gives no surface, 2 for a wrong call.
#include <algorithm>
#include <array>
#include <cstddef>
#include <exception>
#include <fstream>
#include <iostream>
#include <iterator>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <CGAL/Advancing_front_surface_reconstruction.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Random.h>
#include <CGAL/Scale_space_reconstruction_3/Advancing_front_mesher.h>
#include <CGAL/Scale_space_surface_reconstruction_3.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/compute_average_spacing.h>
#include <CGAL/mst_orient_normals.h>
#include <CGAL/pca_estimate_normals.h>
#include <CGAL/poisson_surface_reconstruction.h>
#include <CGAL/property_map.h>

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Points = std::vector<Point>;
using Face = std::array<std::size_t, 3>;
using Mesh = CGAL::Surface_mesh<Point>;

constexpr unsigned neighbours = 16;
constexpr unsigned smoothing_rounds = 4;
// Of Poisson's triangles, in average spacings and degrees. CGAL's own 30 and 0.375 are far coarser
// than the points, and less accurate.
constexpr double least_angle = 20.0;
constexpr double largest_radius = 1.0;
constexpr double largest_distance = 0.1;

struct Soup {
    Points points;
    std::vector<Face> faces;
};

Points read_cloud(const std::string& path) {
    std::ifstream in(path);
    Points points;
    std::string line, key;
    while (std::getline(in, line)) {
        std::istringstream words(line);
        double x = 0, y = 0, z = 0;
        if (words >> key >> x >> y >> z && key == "v") points.emplace_back(x, y, z);
    }
    if (points.empty()) throw std::runtime_error(path + ": has no points");
    return points;
}

Soup read_soup(const std::string& path) {
    std::ifstream in(path);
    std::string off;
    std::size_t points = 0, faces = 0, edges = 0, corners = 0;
    if (!(in >> off >> points >> faces >> edges) || off != "OFF")
        throw std::runtime_error(path + ": is not an OFF file");
    Soup soup;
    for (double x = 0, y = 0, z = 0; soup.points.size() < points && in >> x >> y >> z;)
        soup.points.emplace_back(x, y, z);
    for (Face f{}; soup.faces.size() < faces && in >> corners >> f[0] >> f[1] >> f[2];) {
        if (corners != 3) throw std::runtime_error(path + ": must have triangles only");
        soup.faces.push_back(f);
    }
    if (soup.points.size() != points || soup.faces.size() != faces)
        throw std::runtime_error(path + ": ends too early");
    return soup;
}

/// Without the points that no face uses.
void write(const Soup& soup, const std::string& path) {
    if (soup.faces.empty()) throw std::runtime_error("the method gives no surface");
    constexpr auto unused = static_cast<std::size_t>(-1);
    std::vector<std::size_t> number(soup.points.size(), unused);
    Points used;
    for (const Face& f : soup.faces) {
        for (const std::size_t v : f) {
            if (number[v] != unused) continue;
            number[v] = used.size();
            used.push_back(soup.points[v]);
        }
    }
    std::ofstream out(path);
    out.precision(17);
    out << "OFF\n" << used.size() << ' ' << soup.faces.size() << " 0\n";
    for (const Point& p : used) out << p << '\n';
    for (const Face& f : soup.faces)
        out << "3 " << number[f[0]] << ' ' << number[f[1]] << ' ' << number[f[2]] << '\n';
    if (!out.flush()) throw std::runtime_error(path + ": cannot be written");
}

Soup advancing_front(Points points) {
    Soup soup{std::move(points), {}};
    CGAL::advancing_front_surface_reconstruction(soup.points.begin(), soup.points.end(),
                                                 std::back_inserter(soup.faces));
    return soup;
}

/// The smoothed points decide how the given ones are joined. The smoothed points themselves lose
/// far more at creases than they gain in noise.
Soup scale_space(const Points& points) {
    namespace scale = CGAL::Scale_space_reconstruction_3;
    CGAL::Scale_space_surface_reconstruction_3<Kernel> method(points.begin(), points.end());
    method.increase_scale(smoothing_rounds);
    method.reconstruct_surface(scale::Advancing_front_mesher<Kernel>());
    Soup soup{points, {}};
    for (auto f = method.facets_begin(); f != method.facets_end(); ++f)
        soup.faces.push_back({(*f)[0], (*f)[1], (*f)[2]});
    return soup;
}

Soup poisson(const Points& points) {
    using Oriented = std::pair<Point, Kernel::Vector_3>;
    std::vector<Oriented> cloud;
    for (const Point& p : points) cloud.emplace_back(p, CGAL::NULL_VECTOR);
    const auto place = CGAL::First_of_pair_property_map<Oriented>();
    const auto normal = CGAL::Second_of_pair_property_map<Oriented>();
    const auto maps = CGAL::parameters::point_map(place).normal_map(normal);
    CGAL::pca_estimate_normals<CGAL::Sequential_tag>(cloud, neighbours, maps);
    cloud.erase(CGAL::mst_orient_normals(cloud, neighbours, maps), cloud.end());
    const double spacing = CGAL::compute_average_spacing<CGAL::Sequential_tag>(
        cloud, 6, CGAL::parameters::point_map(place));
    Mesh mesh;
    if (!CGAL::poisson_surface_reconstruction_delaunay(cloud.begin(), cloud.end(), place, normal,
                                                       mesh, spacing, least_angle, largest_radius,
                                                       largest_distance)) {
        return {};
    }
    Soup soup;
    for (const Mesh::Vertex_index v : mesh.vertices()) soup.points.push_back(mesh.point(v));
    for (const Mesh::Face_index f : mesh.faces()) {
        Face corners{};
        std::size_t i = 0;
        for (const Mesh::Vertex_index v : mesh.vertices_around_face(mesh.halfedge(f)))
            corners.at(i++) = v;
        soup.faces.push_back(corners);
    }
    return soup;
}

/// Points that would make the mesh non-manifold are doubled first, so that any surface can be
/// judged.
std::size_t crossings(Soup soup) {
    namespace pmp = CGAL::Polygon_mesh_processing;
    pmp::orient_polygon_soup(soup.points, soup.faces);
    Mesh mesh;
    pmp::polygon_soup_to_polygon_mesh(soup.points, soup.faces, mesh);
    std::vector<std::pair<Mesh::Face_index, Mesh::Face_index>> found;
    pmp::self_intersections(mesh, std::back_inserter(found));
    return static_cast<std::size_t>(std::count_if(
        found.begin(), found.end(), [](const auto& pair) { return pair.first != pair.second; }));
}

int run(const std::vector<std::string>& words) {
    if (words.size() == 2 && words[0] == "crossings") {
        std::cout << crossings(read_soup(words[1])) << '\n';
        return 0;
    }
    if (words.size() == 3 && words[0] == "advancing_front") {
        write(advancing_front(read_cloud(words[1])), words[2]);
    } else if (words.size() == 3 && words[0] == "scale_space") {
        write(scale_space(read_cloud(words[1])), words[2]);
    } else if (words.size() == 3 && words[0] == "poisson") {
        write(poisson(read_cloud(words[1])), words[2]);
    } else {
        std::cerr << "usage: dsc_peers advancing_front|scale_space|poisson CLOUD.obj OUT.off, or "
                     "dsc_peers crossings MESH.off\n";
        return 2;
    }
    return 0;
}

}  // namespace

int main(int count, char** words) {
    try {
        CGAL::get_default_random() = CGAL::Random(1);  // so that Poisson, which starts from random
                                                       // places, can be repeated
        return run({words + 1, words + count});
    } catch (const std::exception& error) {
        std::cerr << "dsc_peers: " << error.what() << '\n';
        return 1;
    }
}
