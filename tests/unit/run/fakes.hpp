#pragma once
// Small strategies for experiments in tests, and a folder that cleans up after itself.

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include <stdlib.h>

#include <dsc/cloud/filter.hpp>
#include <dsc/geometry/quality.hpp>
#include <dsc/hooks/cloud_filter.hpp>
#include <dsc/plugin/catalogue.hpp>
#include <dsc/run/experiment.hpp>

#include "../plugin/fake_catalogue.hpp"

namespace dsc::test {

namespace fs = std::filesystem;

class Folder {
public:
    Folder() {
        std::string pattern = (fs::temp_directory_path() / "dsc-run-XXXXXX").string();
        path_ = mkdtemp(pattern.data());
    }
    ~Folder() {
        std::error_code error;
        fs::remove_all(path_, error);
    }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;
    const fs::path& path() const { return path_; }
    std::string write(const std::string& name, const std::string& text) const {
        fs::create_directories((path_ / name).parent_path());
        std::ofstream(path_ / name, std::ios::binary) << text;
        return (path_ / name).string();
    }
    std::string read(const std::string& name) const {
        std::ifstream file(path_ / name, std::ios::binary);
        std::ostringstream text;
        text << file.rdbuf();
        return text.str();
    }

private:
    fs::path path_;
};

/// A box [-1.5, 1.5]^3 of N^3 five-tet cells; tets with their barycentre in [-half, half]^3 have
/// label 1.
class BoxMesh final : public hooks::InitialMesh {
public:
    struct Params {
        int cells = 12;
        double half = 0.5;
        std::optional<std::string> file;
    };
    static void declare(config::ParamSchema<Params>& s) {
        s.integer("cells", &Params::cells)
            .range(1, 100)
            .unit("dimensionless")
            .doc("Cells along an edge.");
        s.real("half", &Params::half)
            .range(0, 2)
            .unit("length")
            .doc("Half the edge of the cube inside.");
        s.file("file", &Params::file).doc("A file that nobody reads.");
    }
    BoxMesh(const Params& params, const plugin::Setup&) : params_(params) {}
    mesh::TetMesh build(const hooks::InitialMeshContext&) override {
        mesh::TetMesh mesh;
        const int n = params_.cells;
        const auto id = [n](int i, int j, int k) {
            return static_cast<std::uint32_t>(i + (n + 1) * (j + (n + 1) * k));
        };
        for (int k = 0; k <= n; ++k)
            for (int j = 0; j <= n; ++j)
                for (int i = 0; i <= n; ++i)
                    mesh.points.emplace_back(Vec3(i, j, k) * (3.0 / n) - Vec3::Constant(1.5));
        for (int k = 0; k < n; ++k)
            for (int j = 0; j < n; ++j)
                for (int i = 0; i < n; ++i) cell(mesh, id, i, j, k);
        for (auto& tet : mesh.tets) {
            if (geometry::tet_volume(mesh.points[tet[0]], mesh.points[tet[1]], mesh.points[tet[2]],
                                     mesh.points[tet[3]]) < 0) {
                std::swap(tet[0], tet[1]);
            }
            Vec3 centre = Vec3::Zero();
            for (const std::uint32_t v : tet) centre += 0.25 * mesh.points[v];
            mesh.labels.push_back(centre.cwiseAbs().maxCoeff() < params_.half ? 1 : 0);
        }
        return mesh;
    }

private:
    template <class Id>
    static void cell(mesh::TetMesh& mesh, const Id& id, int i, int j, int k) {
        std::array<std::uint32_t, 8> c{};
        for (int b = 0; b < 8; ++b)
            c[static_cast<std::size_t>(b)] = id(i + (b & 1), j + ((b >> 1) & 1), k + (b >> 2));
        // The regular tet of even cells has the corners with an even number of ones, that of odd
        // cells the others.
        const bool odd = ((i + j + k) & 1) != 0;
        const std::array<std::uint32_t, 4> in =
            odd ? std::array{c[1], c[2], c[4], c[7]} : std::array{c[0], c[3], c[5], c[6]};
        const std::array<std::uint32_t, 4> out =
            odd ? std::array{c[6], c[5], c[3], c[0]} : std::array{c[7], c[4], c[2], c[1]};
        mesh.tets.push_back(in);
        for (std::size_t corner = 0; corner < 4; ++corner) {
            std::array<std::uint32_t, 4> tet{};
            std::size_t next = 0;
            for (std::size_t other = 0; other < 4; ++other) {
                if (other != corner) tet[next++] = in[other];
            }
            tet[3] = out[corner];
            mesh.tets.push_back(tet);
        }
    }
    Params params_;
};

/// Every vertex moves by `factor` times its position plus `shift`.
class Linear final : public hooks::VelocityField {
public:
    struct Params {
        double factor = -0.05;
        Vec3 shift = Vec3::Zero();
        bool sampled = false;
        config::StrategyConfig curvature;
    };
    static void declare(config::ParamSchema<Params>& s) {
        s.real("factor", &Params::factor)
            .range(-1, 1)
            .unit("dimensionless")
            .doc("Part of the position.");
        s.vec3("shift", &Params::shift).unit("length").doc("Added to it.");
        s.boolean("sampled", &Params::sampled).doc("Whether it can be sampled.");
        s.strategy("curvature", &Params::curvature, "curvature").optional().doc("Never asked.");
    }
    Linear(const Params& params, const plugin::Setup&) : params_(params) {}
    void prepare(const hooks::StepContext& context) override { surface_ = &context.surface; }
    void evaluate(hooks::Range range, std::span<Vec3> out) const override {
        for (std::size_t i = 0; i < out.size(); ++i)
            out[i] = at(surface_->positions[range.begin + i]);
    }
    bool can_sample() const override { return params_.sampled; }
    void sample(std::span<const Vec3> points, std::span<const Vec3>,
                std::span<Vec3> out) const override {
        for (std::size_t i = 0; i < out.size(); ++i) out[i] = at(points[i]);
    }

private:
    Vec3 at(const Vec3& p) const { return params_.factor * p + params_.shift; }
    Params params_;
    const surface::SurfaceView* surface_ = nullptr;
};

/// Asks for nothing.
class NoRepair final : public hooks::Improvement {
public:
    struct Params {};
    static void declare(config::ParamSchema<Params>&) {}
    NoRepair(const Params&, const plugin::Setup&) {}
    void propose(const hooks::StepContext&, const repair::RepairRound&,
                 std::vector<repair::Request>&) override {}
    repair::TopologyLimits topology_limits() const override {
        return {.thickness = 0.0, .min_component = 0.0};
    }
};

/// Asks every round for two Laplacian smoothings, of a class each: the second, of an interface
/// vertex, is never granted.
class Counted final : public hooks::Improvement {
public:
    struct Params {};
    static void declare(config::ParamSchema<Params>&) {}
    Counted(const Params&, const plugin::Setup&) {}
    void propose(const hooks::StepContext&, const repair::RepairRound& round,
                 std::vector<repair::Request>& out) override {
        const mesh::Complex& c = round.complex;
        ask(c, out, 1, [&c](mesh::VertexId v) { return !c.on_interface(v) && !c.on_box(v); });
        ask(c, out, 2, [&c](mesh::VertexId v) { return c.on_interface(v); });
    }
    repair::TopologyLimits topology_limits() const override {
        return {.thickness = 0.0, .min_component = 0.0};
    }
    std::vector<std::string> repair_classes() const override {
        return {"never", "inside", "surface"};
    }

private:
    template <class Wanted>
    static void ask(const mesh::Complex& c, std::vector<repair::Request>& out,
                    std::uint8_t repair_class, const Wanted& wanted) {
        mesh::VertexId v = 0;
        while (!c.vertex_alive(v) || !wanted(v)) ++v;
        repair::Request& request = out.emplace_back();
        request.operation = repair::Operation::smooth_laplacian;
        request.vertices[0] = v;
        request.repair_class = repair_class;
    }
};

/// Splits every face; may ask for sampling or relabel the tet with the given id.
class SplitAll final : public hooks::RefinementPolicy {
public:
    struct Params {
        bool sampling = false;
        double sizing = 0.0;
    };
    static void declare(config::ParamSchema<Params>& s) {
        s.boolean("sampling", &Params::sampling).doc("Whether it needs to sample the velocity.");
        s.real("sizing", &Params::sizing)
            .range(0, 10)
            .unit("length")
            .doc("Wanted length everywhere; 0 splits all faces.");
    }
    SplitAll(const Params& params, const plugin::Setup&) : params_(params) {}
    bool needs_sampling() const override { return params_.sampling; }
    void refine(const hooks::RefinementContext& context, hooks::RefinementRequests& out) override {
        const surface::SurfaceView& view = context.step.surface;
        if (params_.sizing > 0) {
            out.sizing.assign(view.vertex_count(), params_.sizing);
            return;
        }
        for (std::uint32_t f = 0; f < view.face_count(); ++f) out.split_faces.push_back(f);
    }

private:
    Params params_;
};

/// Counts the steps.
class Counter final : public hooks::Observer {
public:
    struct Params {};
    static void declare(config::ParamSchema<Params>&) {}
    Counter(const Params&, const plugin::Setup&) {}
    void begin(const hooks::StepContext&) override { count_ = 0; }
    hooks::Figures step(const hooks::StepContext&, const hooks::StepFigures&) override {
        return {{"count", static_cast<double>(++count_)}};
    }
    hooks::Figures end(const hooks::StepContext&) override {
        return {{"total", static_cast<double>(count_)}};
    }

private:
    int count_ = 0;
};

/// Keeps every n-th point, beginning with the first, and reports why the others are removed.
class EveryNth final : public hooks::CloudFilter {
public:
    struct Params {
        std::size_t nth = 2;
    };
    static void declare(config::ParamSchema<Params>& s) {
        s.integer("nth", &Params::nth)
            .range(1, 1000)
            .unit("points")
            .doc("One of n points is kept.");
    }
    EveryNth(const Params& params, const plugin::Setup&) : params_(params) {}
    cloud::Filtered apply(const cloud::Cloud& cloud, const hooks::FilterContext&) override {
        std::vector<std::size_t> kept;
        for (std::size_t i = 0; i < cloud.points.size(); i += params_.nth) kept.push_back(i);
        cloud::Filtered result{cloud::pick(cloud, kept), {}};
        result.report.kept = kept.size();
        result.report.removed = cloud.points.size() - kept.size();
        result.report.reasons = {{"in between", result.report.removed}};
        result.report.figures = {{"part_kept", static_cast<double>(kept.size()) /
                                                   static_cast<double>(cloud.points.size())}};
        return result;
    }

private:
    Params params_;
};

/// cloud::remove_duplicates.
class Distinct final : public hooks::CloudFilter {
public:
    using Params = cloud::DuplicatesOptions;
    static void declare(config::ParamSchema<Params>& s) {
        s.boolean("sort", &Params::sort).doc("Whether the points are sorted.");
    }
    Distinct(const Params& params, const plugin::Setup&) : params_(params) {}
    cloud::Filtered apply(const cloud::Cloud& cloud, const hooks::FilterContext&) override {
        return cloud::remove_duplicates(cloud, params_);
    }

private:
    Params params_;
};

class Strategies : public FakeCatalogue {
public:
    Strategies() {
        plugin::Registrar& registrar = *this;
        registrar.add<BoxMesh>("box", "a box");
        registrar.add<Linear>("linear", "a linear field");
        registrar.add<NoRepair>("none", "no repair");
        registrar.add<Counted>("counted", "counts its requests");
        registrar.add<SplitAll>("all", "splits all");
        registrar.add<Counter>("counter", "counts");
        registrar.add<EveryNth>("every_nth", "keeps every n-th point");
        registrar.add<Distinct>("distinct", "removes repeated points");
    }
    run::PluginLoader loader() const {
        return [this](const std::vector<std::string>& paths) -> const config::StrategyLookup& {
            asked = paths;
            return *this;
        };
    }
    mutable std::vector<std::string> asked;
};

inline const std::string minimal = "dsc: 1\ninitial_mesh: {type: box}\nvelocity: {type: "
                                   "linear}\nimprovement: {type: none}\nschedule: [{steps: 2}]\n";

/// The experiment `text`, with overrides.
inline run::LoadedExperiment load_text(const std::string& text,
                                       const std::vector<std::string>& overrides = {}) {
    static const Strategies strategies;
    const Folder folder;
    return run::load_experiment(folder.write("test.yaml", text), overrides, strategies.loader());
}

}  // namespace dsc::test
