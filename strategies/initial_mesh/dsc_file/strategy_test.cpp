// Tests of the mesh; the plugin is loaded as in a run.
#include <algorithm>
#include <filesystem>
#include <sstream>

#include <unistd.h>

#include <doctest/doctest.h>

#include <dsc/base/error.hpp>
#include <dsc/base/read_file.hpp>
#include <dsc/generate/lattice.hpp>
#include <dsc/host/host.hpp>
#include <dsc/io/atomic_file.hpp>
#include <dsc/io/write.hpp>
#include <dsc/mesh/adopt.hpp>
#include <dsc/mesh/validate.hpp>
#include <dsc/run/mesh_files.hpp>

namespace {

using dsc::Vec3;
using dsc::config::ConfigNode;
using dsc::mesh::TetMesh;

/// A temporary file.
class File {
public:
    explicit File(const std::string& name)
        : path_(std::filesystem::temp_directory_path() /
                ("dsc_file_test_" + std::to_string(::getpid()) + "_" + name)) {}
    ~File() {
        std::error_code ignored;
        std::filesystem::remove(path_, ignored);
    }
    File(const File&) = delete;
    File& operator=(const File&) = delete;
    std::string name() const { return path_.string(); }

private:
    std::filesystem::path path_;
};

TetMesh load(const std::string& file, const dsc::cloud::TargetCloud* cloud = nullptr) {
    dsc::host::Host host;
    host.load(DSC_TEST_PLUGIN);
    ConfigNode params = ConfigNode::map({{"file", file}});
    if (cloud != nullptr) params = params.with("coordinates", "of_input");
    const dsc::run::MeshFiles files;
    dsc::hooks::InitialMeshContext context;
    context.files = &files;
    context.cloud = cloud;
    return host.create<dsc::hooks::InitialMesh>({"dsc_file", params}, "initial_mesh")
        ->build(context);
}

/// A box of equal cells that contains a cube of three slabs.
TetMesh slabs() {
    dsc::generate::LatticeOptions options;
    options.cells = 18;
    options.growth = 1;
    TetMesh mesh = dsc::generate::make_lattice(
        options, [](const Vec3&, double) { return false; }, "test");
    for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
        Vec3 p = Vec3::Zero();
        for (const std::uint32_t v : mesh.tets[t]) p += mesh.points[v] / 4;
        if (p.cwiseAbs().maxCoeff() < 1)
            mesh.labels[t] = p.z() < -1.0 / 3 ? 1 : p.z() < 1.0 / 3 ? 2 : 3;
    }
    return mesh;
}

double volume_of(const dsc::mesh::Complex& c, dsc::mesh::Label label) {
    double sum = 0;
    for (dsc::mesh::TetId t = 0; t < c.tet_slots(); ++t)
        sum += c.tet_alive(t) && c.label(t) == label ? c.volume(t) : 0;
    return sum;
}

/// The text of a .dsc with its lines in another order and every third tet in negative orientation.
std::string shuffled(const std::string& text) {
    std::istringstream lines(text);
    std::string line, vertices, tets;
    for (std::size_t n = 0; std::getline(lines, line); ++n) {
        if (line[0] == 'v') {
            vertices += line + "\r\n";
            continue;
        }
        std::istringstream fields(line);
        std::string tag, a, b, c, d, label;
        fields >> tag >> a >> b >> c >> d >> label;
        if (n % 3 == 0) std::swap(a, b);
        tets = "t\t" + a + " " + b + "  " + c + " " + d + " " + label + "\n" + tets;
    }
    return tets + "\n" + vertices.substr(0, vertices.size() - 2);  // no line feed at the end
}

}  // namespace

TEST_CASE("bit for bit: what is written, read and adopted is written the same again") {
    const File one("one.dsc"), two("two.dsc");
    const TetMesh start = dsc::mesh::adopt(slabs(), "slabs").to_mesh();
    dsc::io::write_volume(one.name(), start);
    const TetMesh back = load(one.name());
    CHECK(back.points == start.points);
    CHECK(back.tets == start.tets);
    CHECK(back.labels == start.labels);
    dsc::mesh::AdoptReport report;
    dsc::io::write_volume(two.name(), dsc::mesh::adopt(back, "again", &report).to_mesh());
    CHECK(report.reoriented_tets == 0);
    CHECK(dsc::read_file(one.name()) == dsc::read_file(two.name()));
}

TEST_CASE("tets of either orientation, in any order, the last line once: three labels and their "
          "volumes") {
    const File file("shuffled.dsc");
    const TetMesh start = slabs();
    dsc::io::write_volume(file.name(), start);
    dsc::io::write_file(file.name(), shuffled(dsc::read_file(file.name())));
    dsc::mesh::AdoptReport report;
    const dsc::mesh::Complex complex = dsc::mesh::adopt(load(file.name()), "file", &report);
    CHECK(complex.tet_count() == start.tets.size());
    CHECK(report.reoriented_tets == start.tets.size() / 3);
    CHECK(report.unpinched_vertices == 0);
    CHECK(dsc::mesh::validate(complex).faults == std::vector<std::string>{});
    for (const dsc::mesh::Label label : {1, 2, 3})
        CHECK(volume_of(complex, label) == doctest::Approx(8.0 / 3).epsilon(1e-12));
    // Two rims of 48 vertices where a slab, its neighbour and the outside meet.
    const auto vertices = complex.interface_vertices();
    CHECK(std::count_if(vertices.begin(), vertices.end(),
                        [&](auto v) { return complex.phases(v) == 3; }) == 96);
    CHECK(std::none_of(vertices.begin(), vertices.end(),
                       [&](auto v) { return complex.phases(v) == 3 && complex.movable(v); }));
}

TEST_CASE("coordinates of the input move with the cloud") {
    const File file("far.dsc");
    TetMesh start = slabs();
    const Vec3 centre(100, -40, 7);
    for (Vec3& p : start.points) p = centre + 20.0 * p;
    dsc::io::write_volume(file.name(), start);
    dsc::cloud::Cloud cloud;
    for (int i = 0; i < 8; ++i)
        cloud.points.push_back(centre + 18.0 * Vec3((i & 1) != 0 ? 1 : -1, (i & 2) != 0 ? 1 : -1,
                                                    (i & 4) != 0 ? 1 : -1));
    const dsc::cloud::TargetCloud target(dsc::cloud::normalize(cloud, 0.9));
    const auto complex = dsc::mesh::adopt(load(file.name(), &target), "file");
    CHECK((complex.box().high - Vec3::Constant(1.5)).norm() < 1e-12);
    CHECK(volume_of(complex, 2) == doctest::Approx(8.0 / 3));
    // Without the parameter the mesh is not moved.
    CHECK(dsc::mesh::adopt(load(file.name()), "file").box().high ==
          Vec3(centre + 20.0 * Vec3::Constant(1.5)));
}

TEST_CASE("hostile files end in one message with place, cause and remedy") {
    const File file("bad.dsc");
    const auto refused = [&](const std::string& content, const std::string& code,
                             const std::string& text) {
        dsc::io::write_file(file.name(), content);
        CAPTURE(content.substr(0, 60));
        try {
            dsc::mesh::adopt(load(file.name()), file.name());
            FAIL("accepted");
        } catch (const dsc::Error& error) {
            CHECK(error.code() == code);
            const std::string message = error.what();
            CHECK(message.find(file.name()) == 0);
            CHECK(message.find(text) != std::string::npos);
            CHECK(message.find("; ") != std::string::npos);
        }
    };
    const std::string v4 = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n";
    refused(v4 + "t 0 1 2 3 1\nt 0 1 2 9 1\n", "io.index", ":6: vertex index 9 of 4");
    refused(v4 + "t 0 1 2 3", "io.truncated", ":5: the file ends where an integer should be");
    refused(v4 + "t 0 1 2 3 -4\n", "io.syntax", ":5: label -4 is out of range");
    refused(v4 + "t 0 1 2 3 1\n", "mesh.volume", "bounding box");
    refused(v4 + "t 0 1 2 2 1\n", "mesh.flat_tet", "zero volume");
    // The readers of the original program read the last line twice, so its results contain this
    // line twice.
    const File good("good.dsc");
    dsc::io::write_volume(good.name(), slabs());
    const std::string text = dsc::read_file(good.name());
    refused(text + text.substr(text.rfind('t')), "mesh.crowded_face",
            "some writers repeat the last line");
}
