// Packs surfaces, cloud and tets for the viewer of the report.
#include "scene.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include <dsc/base/error.hpp>
#include <dsc/base/parallel_table.hpp>
#include <dsc/geometry/quality.hpp>
#include <dsc/io/picture.hpp>
#include <dsc/io/read.hpp>
#include <dsc/io/series.hpp>
#include <dsc/run/experiment.hpp>
#include <dsc/run/input.hpp>
#include <dsc/run/kept_states.hpp>
#include <dsc/surface/decimate.hpp>
#include <dsc/surface/distance.hpp>
#include <dsc/surface/measure.hpp>

#include "attributes.hpp"
#include "html.hpp"

namespace dsc::report {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

template <class Integer>
void append_little_endian(std::string& out, Integer value) {
    for (std::size_t i = 0; i < sizeof(Integer); ++i)
        out += static_cast<char>((value >> (8 * i)) & 0xFFU);
}

/// Points as 16-bit numbers in their box.
ordered_json pack_points(const std::vector<Vec3>& points) {
    const Box3 box = bounding_box(points);
    const Vec3 low = box.empty() ? Vec3(Vec3::Zero()) : box.low;
    const Vec3 step = box.empty() ? Vec3(Vec3::Zero()) : Vec3(box.size() / 65535.0);
    std::string bytes;
    bytes.reserve(6 * points.size());
    for (const Vec3& p : points) {
        for (int k = 0; k < 3; ++k) {
            const double at = step[k] > 0.0 ? std::round((p[k] - low[k]) / step[k]) : 0.0;
            append_little_endian(bytes, static_cast<std::uint16_t>(std::clamp(at, 0.0, 65535.0)));
        }
    }
    return {{"count", points.size()},
            {"low", {low.x(), low.y(), low.z()}},
            {"step", {step.x(), step.y(), step.z()}},
            {"data", html::base64(bytes)}};
}

/// Indices in 16 bits if that is enough.
template <class Corners>
ordered_json pack_cells(const std::vector<Corners>& cells, std::size_t points) {
    const bool wide = points > 65536;
    std::string bytes;
    for (const Corners& cell : cells) {
        for (const std::uint32_t v : cell) {
            if (wide) {
                append_little_endian(bytes, v);
            } else {
                append_little_endian(bytes, static_cast<std::uint16_t>(v));
            }
        }
    }
    return {{"count", cells.size()}, {"wide", wide}, {"data", html::base64(bytes)}};
}

ordered_json pack_mesh(const surface::TriangleMesh& mesh) {
    return {{"points", pack_points(mesh.points)},
            {"faces", pack_cells(mesh.faces, mesh.points.size())}};
}

/// Numbers from 0 to `top` in 8 bits.
std::string pack_levels(const std::vector<double>& values, double top) {
    std::string bytes;
    for (const double value : values) {
        const double part = top > 0.0 ? std::clamp(value / top, 0.0, 1.0) : 0.0;
        bytes += static_cast<char>(static_cast<unsigned char>(std::lround(255.0 * part)));
    }
    return html::base64(bytes);
}

class SceneMaker {
public:
    SceneMaker(const RunRecord& record, const SceneLimits& limits, const SceneInput& input,
               Workers* workers)
        : record_(record), limits_(limits), input_(input), workers_(workers) {}

    Scene make() {
        json_["name"] = record_.name();
        json_["up"] = "y";
        json_["units"] = "normalised units";
        read_result();
        json_["frames"] = ordered_json::array();
        if (limits_.frames > 0)
            attempt("the intermediate steps are not shown", [&] { add_frames(); });
        if (!surface_.faces.empty()) {
            attempt("the surface is not shown", [&] {
                add_frame("result", thinned(surface_, limits_.faces, "the surface"), attributes_);
                scene_.empty = false;
            });
        }
        scene_.empty = scene_.empty && json_["frames"].empty();
        attempt("the cloud is not shown", [&] { add_cloud(); });
        if (limits_.tets > 0) attempt("the cut is not shown", [&] { add_tets(); });
        scene_.json = json_.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
        return std::move(scene_);
    }

private:
    void note(const std::string& text) { scene_.notes.push_back(text); }

    /// A page without one of its parts is better than no page.
    template <class Action>
    void attempt(const std::string& otherwise, const Action& action) {
        try {
            action();
        } catch (const Error& error) {
            note(otherwise + ": " + error.what());
        }
    }

    void read_result() {
        const fs::path surface =
            result_file(record_.folder, "surface", {"obj", "ply", "off", "stl"});
        // Of the surface's files, .ply contains the attributes; of the volume's files, .vtu.
        const fs::path coloured = result_file(record_.folder, "surface", {"ply"});
        AttributeSource source;
        if (!surface.empty()) {
            attempt("the surface is not shown", [&] {
                surface_ = io::read_surface(surface, &source.arrays);
                source.points = surface_.points;
            });
        }
        if (coloured != surface && !coloured.empty()) {
            attempt("the surface has no attributes",
                    [&] { source.points = io::read_surface(coloured, &source.arrays).points; });
        }
        if (!coloured.empty()) take_attributes(std::move(source));
        const auto order = coloured.empty() ? std::vector<std::string>{"vtu", "dsc"}
                                            : std::vector<std::string>{"dsc", "vtu"};
        const fs::path volume = result_file(record_.folder, "volume", order);
        if (volume.empty()) return;
        attempt("the volume is not shown", [&] {
            AttributeSource everywhere;
            volume_ = io::read_volume(volume, &everywhere.arrays);
            if (!coloured.empty() || surface_.faces.empty()) return;
            everywhere.points = volume_.points;
            take_attributes(with_values(everywhere));
        });
        for (const auto& [a, b, c, d] : volume_.tets) {
            const auto& p = volume_.points;
            scene_.qualities.push_back(geometry::tet_quality(p[a], p[b], p[c], p[d]));
        }
    }

    void take_attributes(AttributeSource source) {
        attributes_ = std::move(source);
        std::vector<io::DataArray>& arrays = attributes_.arrays;
        arrays = attributes_among(std::move(arrays));
        if (arrays.size() <= limits_.attributes) return;
        note("of the surface's " + html::integer(static_cast<double>(arrays.size())) +
             " attributes only these can be used as colours: the first " +
             html::integer(static_cast<double>(limits_.attributes)));
        arrays.resize(limits_.attributes);
    }

    /// Attributes that the result does not have are left out, so that all frames offer the same
    /// choice.
    void add_frame(const std::string& label, const surface::TriangleMesh& mesh,
                   AttributeSource source) {
        std::vector<io::DataArray> arrays;
        for (const io::DataArray& known : attributes_.arrays) {
            for (io::DataArray& array : source.arrays) {
                if (array.name == known.name) arrays.push_back(std::move(array));
            }
        }
        source.arrays = std::move(arrays);
        ordered_json frame = {{"label", label}, {"mesh", pack_mesh(mesh)}};
        ordered_json attributes = pack_attributes(source, mesh.points, workers_);
        if (!attributes.empty()) frame["attributes"] = std::move(attributes);
        json_["frames"].push_back(std::move(frame));
    }

    surface::TriangleMesh thinned(const surface::TriangleMesh& mesh, std::size_t faces,
                                  const std::string& what) {
        if (mesh.faces.size() <= faces) return mesh;
        try {
            const surface::TriangleMesh few = surface::decimate(mesh, faces);
            if (!what.empty())
                note(what + " is drawn with " +
                     html::integer(static_cast<double>(few.faces.size())) + " of its " +
                     html::integer(static_cast<double>(mesh.faces.size())) + " triangles");
            return few;
        } catch (const GeometryError&) {
            // Where three labels meet, the interface is not a manifold and cannot be thinned.
            return mesh;
        }
    }

    void add_frames() {
        const std::vector<io::SeriesEntry> kept = run::kept_states(record_.folder, "surface");
        const std::size_t count = std::min(kept.size(), limits_.frames);
        const auto last = static_cast<std::uint64_t>(std::max(0.0, record_.number("steps")));
        for (std::size_t i = 0; i < count; ++i) {
            const io::SeriesEntry& entry =
                kept[count == kept.size()
                         ? i
                         : i * (kept.size() - 1) / std::max<std::size_t>(1, count - 1)];
            // The state after the last step equals the result, unless a refinement followed.
            if (entry.step >= last && last > 0) continue;
            io::SurfaceData data;
            const surface::TriangleMesh mesh =
                io::read_vtp(record_.folder / "series" / entry.file, &data);
            if (mesh.faces.empty()) continue;
            add_frame("step " + std::to_string(entry.step), thinned(mesh, limits_.frame_faces, ""),
                      {mesh.points, std::move(data.points)});
        }
    }

    /// The cloud of the configuration, as the run saw it: filtered, in the input's coordinates.
    void add_cloud() {
        const std::optional<run::Input> input = run::input_of(record_.resolved, input_.catalogue);
        if (!input) return;
        if (input->cloud.sample) json_["up"] = "z";  // the up axis of the built-in shapes is z
        std::optional<run::LoadedInput> again;
        if (input_.loaded == nullptr) {
            require_same_file(*input);
            again = load(*input);
        }
        const run::LoadedInput& loaded = again ? *again : *input_.loaded;
        std::vector<Vec3> points = loaded.cloud.points;
        if (points.size() > limits_.points) {
            note("of the cloud's " + html::integer(static_cast<double>(points.size())) +
                 " points " + html::integer(static_cast<double>(limits_.points)) + " are drawn");
            for (std::size_t i = 0; i < limits_.points; ++i)
                points[i] = points[i * points.size() / limits_.points];
            points.resize(limits_.points);
        }
        ordered_json cloud = {{"points", pack_points(points)}};
        if (!surface_.faces.empty()) {
            scene_.distances = distances(points, loaded.target.transform().scale);
            // With the maximum as bound, a few distant points would give all others the same
            // colour.
            const double top = io::colour_bounds(scene_.distances).high;
            cloud["top"] = top;
            cloud["distance"] = pack_levels(scene_.distances, top);
        }
        json_["cloud"] = std::move(cloud);
        scene_.empty = false;
    }

    run::LoadedInput load(const run::Input& input) {
        const config::ConfigNode* seed = record_.resolved.find("seed");
        return run::load_input(input,
                               seed != nullptr ? static_cast<std::uint64_t>(seed->as_integer()) : 1,
                               input_.catalogue, files_, workers_);
    }

    /// The report of an old run must not show a changed file. The provenance contains paths as they
    /// were typed, so files of the same name are compared.
    void require_same_file(const run::Input& input) {
        const ordered_json* inputs = find(record_.provenance, "inputs");
        if (!input.cloud.file || inputs == nullptr || !inputs->is_array()) return;
        const std::filesystem::path name = std::filesystem::path(*input.cloud.file).filename();
        bool known = false;
        for (const ordered_json& read : *inputs) {
            if (!read.is_object() ||
                std::filesystem::path(read.value("file", "")).filename() != name)
                continue;
            if (read.value("sha256", "") == files_.sha256(*input.cloud.file)) return;
            known = true;
        }
        if (!known) return;
        throw IoError("report.changed", *input.cloud.file, "", "is not the file that the run read",
                      "restore the file to see the cloud");
    }

    std::vector<double> distances(const std::vector<Vec3>& points, double scale) const {
        const surface::TriangleTree tree(surface_);
        return parallel_table(workers_, points.size(), [&](std::size_t i) {
            return scale * tree.nearest(points[i]).distance;
        });
    }

    /// Tets near the surface: all inside ones, and those outside whose centre is near the surface's
    /// box.
    std::vector<std::size_t> near_tets() const {
        Box3 box = bounding_box(surface_.points);
        const Vec3 margin = Vec3::Constant(0.12 * box.diagonal());
        box.low -= margin;
        box.high += margin;
        std::vector<std::size_t> chosen;
        for (std::size_t t = 0; t < volume_.tets.size(); ++t) {
            Vec3 centre = Vec3::Zero();
            for (const std::uint32_t v : volume_.tets[t]) centre += 0.25 * volume_.points[v];
            if (volume_.labels[t] > 0 || box.contains(centre)) chosen.push_back(t);
        }
        return chosen;
    }

    void add_tets() {
        if (volume_.tets.empty() || surface_.faces.empty()) return;
        const std::vector<std::size_t> chosen = near_tets();
        if (chosen.size() > limits_.tets) {
            note("the cut is not shown: " + html::integer(static_cast<double>(chosen.size())) +
                 " tets are too many for a page; ParaView can cut result/volume.vtu");
            return;
        }
        constexpr std::uint32_t unused = 0xFFFFFFFFU;
        std::vector<std::uint32_t> index(volume_.points.size(), unused);
        std::vector<Vec3> points;
        std::vector<std::array<std::uint32_t, 4>> tets;
        std::string labels;
        std::vector<double> qualities;
        for (const std::size_t t : chosen) {
            std::array<std::uint32_t, 4> tet = volume_.tets[t];
            for (std::uint32_t& v : tet) {
                if (index[v] == unused) {
                    index[v] = static_cast<std::uint32_t>(points.size());
                    points.push_back(volume_.points[v]);
                }
                v = index[v];
            }
            tets.push_back(tet);
            labels += static_cast<char>(
                static_cast<unsigned char>(std::min<mesh::Label>(volume_.labels[t], 255)));
            qualities.push_back(scene_.qualities[t]);
        }
        json_["tets"] = {{"points", pack_points(points)},
                         {"cells", pack_cells(tets, points.size())},
                         {"labels", html::base64(labels)},
                         {"quality", pack_levels(qualities, 1.0)}};
    }

    const RunRecord& record_;
    const SceneLimits& limits_;
    const SceneInput input_;
    Workers* workers_;
    run::InputFiles files_;
    Scene scene_;
    ordered_json json_;
    surface::TriangleMesh surface_;
    AttributeSource attributes_;  ///< of the result
    mesh::TetMesh volume_;
};

}  // namespace

Scene make_scene(const RunRecord& record, const SceneLimits& limits, const SceneInput& input,
                 Workers* workers) {
    return SceneMaker(record, limits, input, workers).make();
}

fs::path result_file(const fs::path& run_folder, const std::string& stem,
                     const std::vector<std::string>& extensions) {
    std::error_code error;
    for (const std::string& extension : extensions) {
        const fs::path file = run_folder / "result" / (stem + "." + extension);
        if (fs::exists(file, error)) return file;
    }
    return {};
}

}  // namespace dsc::report
