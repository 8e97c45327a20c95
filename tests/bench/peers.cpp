// dsc_bench_peers: other programs beside dsc on the same work, as far as this build found them.
// Each runs once by one thread; the accuracy or the quality of each result is measured beside its
// time.
#include "peers.hpp"

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include <dsc/base/error.hpp>
#include <dsc/base/version.hpp>
#include <dsc/cloud/shapes.hpp>
#include <dsc/surface/analysis.hpp>
#include <dsc/surface/distance.hpp>

#include "peers_mesh.hpp"
#include "program.hpp"

namespace {

using namespace dsc;
using namespace dsc::bench;
using Json = nlohmann::ordered_json;

constexpr const char* usage = "dsc_bench_peers [--quick] [--json FILE]\n"
                              "  --quick  small inputs: shows that it works, measures nothing\n";

// Alpha and offset as parts of the diagonal: as in the example of CGAL's manual for points, and
// about as fine as 20,000 points permit. With 80 and 2400, both wraps get false handles.
[[maybe_unused]] constexpr double manual_alpha = 1.0 / 10.0, manual_offset = 1.0 / 300.0;
[[maybe_unused]] constexpr double fine_alpha = 1.0 / 60.0, fine_offset = 1.0 / 1800.0;

constexpr std::uint64_t seed = 1;

struct Arguments {
    bool quick = false;
    std::string json;
};

Arguments parse(int argc, char** argv) {
    Arguments arguments;
    for (int i = 1; i < argc; ++i) {
        const std::string word = argv[i];
        if (word == "--quick") {
            arguments.quick = true;
        } else if (word == "--json" && i + 1 < argc) {
            arguments.json = argv[++i];
        } else {
            throw UsageError("bench.usage",
                             "unknown or incomplete argument " + word + "\n" + usage);
        }
    }
    return arguments;
}

/// A program and what it does with the input; without a function it says what is missing.
template <class Input, class Result>
struct Peer {
    std::string program;
    std::string missing;
    std::function<Result(const Input&)> run;
};
using MeshPeer = Peer<mesh::TetMesh, Remeshed>;
using PointPeer = Peer<std::vector<Vec3>, Reconstructed>;

constexpr const char* needs_cgal = "left out: CGAL (libcgal-dev) was not found when dsc was built";
constexpr const char* needs_both =
    "left out: PCL (libpcl-dev), or CGAL (libcgal-dev) for the directions of the normals, was not "
    "found when dsc was built";

// CGAL flips and smooths everywhere, four times for one iteration. With these parameters dsc comes
// close to that.
const std::vector<std::string> thorough = {"smooth_below=1", "min_tet_quality=0.6"};
constexpr unsigned thorough_steps = 4;

std::vector<MeshPeer> mesh_peers(const Plugins& plugins, double edge) {
    std::vector<MeshPeer> peers = {
        {"dsc, one step", "",
         [&](const mesh::TetMesh& mesh) { return repair_with_dsc(plugins, mesh, {}, 1); }},
        {"dsc, four steps, all tets", "",
         [&](const mesh::TetMesh& mesh) {
             return repair_with_dsc(plugins, mesh, thorough, thorough_steps);
         }},
        {"CGAL, tetrahedral isotropic remeshing", needs_cgal, {}}};
#ifdef DSC_PEER_CGAL
    peers.back().run = [edge](const mesh::TetMesh& mesh) { return remesh_with_cgal(mesh, edge); };
#else
    static_cast<void>(edge);
#endif
    return peers;
}

std::vector<PointPeer> point_peers(const Plugins& plugins) {
    std::vector<PointPeer> peers = {
        {"dsc reconstruct", "",
         [&](const std::vector<Vec3>& points) { return reconstruct_with_dsc(plugins, points); }},
        {"PCL, Poisson", needs_both, {}},
        {"CGAL, alpha wrap, 10 and 300", needs_cgal, {}},
        {"CGAL, alpha wrap, 60 and 1800", needs_cgal, {}}};
#ifdef DSC_PEER_PCL
    peers[1].run = [](const std::vector<Vec3>& points) { return poisson_with_pcl(points); };
#endif
#ifdef DSC_PEER_CGAL
    peers[2].run = [](const std::vector<Vec3>& points) {
        return wrap_with_cgal(points, manual_alpha, manual_offset);
    };
    peers[3].run = [](const std::vector<Vec3>& points) {
        return wrap_with_cgal(points, fine_alpha, fine_offset);
    };
#endif
    return peers;
}

/// The versions of the programs; null for one that was not found.
Json versions() {
    Json found = {{"dsc", DSC_VERSION}, {"CGAL", nullptr}, {"PCL", nullptr}};
#ifdef DSC_PEER_CGAL
    found["CGAL"] = cgal_version();
#endif
#ifdef DSC_PEER_PCL
    found["PCL"] = pcl_version();
#endif
    return found;
}

Json to_json(const MeshFigures& figures) {
    return {{"vertices", figures.vertices},       {"tets", figures.tets},
            {"mean_edge", figures.mean_edge},     {"least_quality", figures.least_quality},
            {"low_quality", figures.low_quality}, {"least_dihedral", figures.least_dihedral}};
}

/// Throws for a mesh that does not fill the box, so that nothing else is compared.
Json figures_of(const mesh::TetMesh& mesh, const MeshFigures& before) {
    const MeshFigures figures = measure_mesh(mesh);
    if (!(figures.least_quality > 0.0) || std::abs(figures.volume / before.volume - 1.0) > 1e-3) {
        throw GeometryError("bench.result", "a mesh of the comparison",
                            "has inverted tets or does not fill its box", "please report it");
    }
    Json json = to_json(figures);
    json["ball_change_percent"] = 100.0 * (figures.ball_volume / before.ball_volume - 1.0);
    return json;
}

Json figures_of(const surface::TriangleMesh& surface, const surface::TriangleMesh& truth) {
    const surface::SurfaceReport report = surface::analyse(surface);
    const surface::Evaluation evaluation = surface::evaluate(surface, truth);
    return {{"vertices", report.vertices},
            {"boundary_edges", report.boundary_edges},
            {"shells", report.shells},
            {"genus", report.genus},
            {"chamfer_percent", 100.0 * evaluation.chamfer},
            {"hausdorff99_percent", 100.0 * evaluation.hausdorff99}};
}

/// One row per peer. `figures` are those of a result.
template <class Peers, class Input, class Figures>
Json rows_of(const Peers& peers, const Input& input, const Figures& figures) {
    Json rows = Json::array();
    for (const auto& peer : peers) {
        Json row = {{"program", peer.program}};
        if (peer.run) {
            const auto result = peer.run(input);
            row["cpu_s"] = result.cost.cpu_s;
            row["wall_s"] = result.cost.wall_s;
            row.update(figures(result));
            std::printf("%-40s %8.2f s CPU %8.2f s wall\n", peer.program.c_str(), result.cost.cpu_s,
                        result.cost.wall_s);
        } else {
            row["missing"] = peer.missing;
            std::printf("%-40s %s\n", peer.program.c_str(), peer.missing.c_str());
        }
        std::fflush(stdout);
        rows.push_back(row);
    }
    return rows;
}

Json compare_remeshing(const Plugins& plugins, bool quick) {
    const mesh::TetMesh mesh = rough_ball(plugins, quick ? 10 : 34);
    const MeshFigures before = measure_mesh(mesh);
    std::printf("remeshing %zu tets\n", mesh.tets.size());
    Json rows = rows_of(mesh_peers(plugins, before.mean_edge), mesh,
                        [&](const Remeshed& result) { return figures_of(result.mesh, before); });
    for (Json& row : rows) {
        if (row.contains("cpu_s")) {
            row["us_per_vertex"] =
                1e6 * row["cpu_s"].get<double>() / static_cast<double>(mesh.points.size());
        }
    }
    return {{"before", to_json(before)}, {"rows", rows}};
}

Json compare_reconstruction(const Plugins& plugins, const std::string& shape, bool quick) {
    const std::vector<Vec3> points = cloud::sample_shape(shape, quick ? 1500 : 20000, seed).points;
    cloud::ShapeMesh shape_mesh = cloud::shape_mesh(shape);
    const surface::TriangleMesh truth = {std::move(shape_mesh.points), std::move(shape_mesh.faces)};
    std::printf("%zu points of the %s\n", points.size(), shape.c_str());
    return {{"shape", shape},
            {"points", points.size()},
            {"rows", rows_of(point_peers(plugins), points, [&](const Reconstructed& result) {
                 return figures_of(result.surface, truth);
             })}};
}

int work(const Arguments& arguments) {
    const Plugins plugins;
    Json out = {{"versions", versions()},
                {"remeshing", compare_remeshing(plugins, arguments.quick)},
                {"reconstruction", Json::array()}};
    for (const char* shape : {"torus", "teapot"})
        out["reconstruction"].push_back(compare_reconstruction(plugins, shape, arguments.quick));
    write_report(arguments.json, out);
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    return dsc::bench::run_program("dsc_bench_peers", [&] { return work(parse(argc, argv)); });
}
