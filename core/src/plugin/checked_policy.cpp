// Refinement, initial mesh, improvement and observer: called from one thread; checks answers of any
// size.
#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/core.h>

#include <dsc/base/workers.hpp>
#include <dsc/text/words.hpp>

#include "plugin/checked.hpp"

namespace dsc::plugin {
namespace {

constexpr std::string_view lengths_remedy =
    "lengths must be finite and above 0; report this to the plugin's authors";

class CheckedRefinement final : public Checked<hooks::RefinementPolicy> {
public:
    using Checked::Checked;

    bool needs_sampling() const override {
        return guarded(call("needs_sampling"), [&] { return inner().needs_sampling(); });
    }

    bool needs_faces_of_points() const override {
        return guarded(call("needs_faces_of_points"),
                       [&] { return inner().needs_faces_of_points(); });
    }

    bool needs_support() const override {
        return guarded(call("needs_support"), [&] { return inner().needs_support(); });
    }

    bool owns_sizing() const override {
        return guarded(call("owns_sizing"), [&] { return inner().owns_sizing(); });
    }

    std::optional<repair::CreaseRule> keep_creases() const override {
        return checked_answer("keep_creases", [&] { return inner().keep_creases(); });
    }

    unsigned passes() const override {
        const Call current = call("passes");
        const unsigned passes = guarded(current, [&] { return inner().passes(); });
        if (passes < 1 || passes > hooks::refinement_passes) {
            fail(current, "strategy.range", fmt::format("asked for {} passes", passes),
                 fmt::format("use 1 to {} passes; report this to the plugin's authors",
                             hooks::refinement_passes));
        }
        return passes;
    }

    void refine(const hooks::RefinementContext& context, hooks::RefinementRequests& out) override {
        const hooks::StepContext step = own(context.step);
        const Call current = call("refine", step.step);
        guarded(current, [&] { inner().refine({step, context.velocity, context.pass}, out); });
        check_changes(current, step, out);
        check_lengths(current, step.surface.vertex_count(), out);
        check_answer(current, out.attributes, step.surface.vertex_count());
    }

private:
    static void check_changes(const Call& current, const hooks::StepContext& step,
                              const hooks::RefinementRequests& out) {
        const surface::SurfaceView& view = step.surface;
        const std::size_t vertices = view.vertex_count();
        for (std::size_t i = 0; i < out.split_faces.size(); ++i) {
            if (out.split_faces[i] >= view.face_count())
                bad_index(current, entry("split_faces", i), out.split_faces[i]);
        }
        for (std::size_t i = 0; i < out.split_edges.size(); ++i) {
            for (const std::uint32_t v : out.split_edges[i]) {
                if (v >= vertices) bad_index(current, entry("split_edges", i), v);
            }
        }
        for (std::size_t i = 0; i < out.collapse_edges.size(); ++i) {
            const hooks::CollapseRequest& r = out.collapse_edges[i];
            for (const std::uint32_t v : {r.kept, r.removed}) {
                if (v >= vertices) bad_index(current, entry("collapse_edges", i), v);
            }
            if (!r.place.allFinite()) bad_number(current, entry("collapse_edges", i));
        }
        for (std::size_t i = 0; i < out.flip_edges.size(); ++i) {
            for (const std::uint32_t v : out.flip_edges[i].edge) {
                if (v >= vertices) bad_index(current, entry("flip_edges", i), v);
            }
            if (!std::isfinite(out.flip_edges[i].flatness))
                bad_number(current, entry("flip_edges", i));
        }
        for (std::size_t i = 0; i < out.move_vertices.size(); ++i) {
            const hooks::MoveRequest& r = out.move_vertices[i];
            if (r.vertex >= vertices) bad_index(current, entry("move_vertices", i), r.vertex);
            if (!r.place.allFinite()) bad_number(current, entry("move_vertices", i));
        }
        for (std::size_t i = 0; i < out.relabel.size(); ++i) {
            constexpr auto greatest =
                static_cast<std::uint32_t>(std::numeric_limits<mesh::Label>::max());
            if (out.relabel[i][1] > greatest)
                bad_index(current, entry("relabel", i), out.relabel[i][1]);
        }
    }

    static void check_lengths(const Call& current, std::size_t vertices,
                              const hooks::RefinementRequests& out) {
        for (const std::vector<double>* lengths : {&out.sizing, &out.target_lengths}) {
            if (!lengths->empty() && lengths->size() != vertices) {
                fail(current, "strategy.size",
                     fmt::format("gave a sizing field of {} entries for {} vertices",
                                 lengths->size(), vertices),
                     report_it);
            }
            for (std::size_t i = 0; i < lengths->size(); ++i) {
                const double length = (*lengths)[i];
                if (std::isfinite(length) && length > 0) continue;
                fail(current, "strategy.not_finite",
                     fmt::format("gave vertex {} the target length {:f}", i, length),
                     lengths_remedy);
            }
        }
        if (!std::isfinite(out.target_length) || out.target_length < 0) {
            fail(current, "strategy.not_finite",
                 "gave the target length " + std::to_string(out.target_length), lengths_remedy);
        }
        if (out.target_length > 0 && !out.target_lengths.empty()) {
            fail(current, "strategy.size",
                 "gave a target length for the whole surface and one per vertex",
                 "give only one of them; report this to the plugin's authors");
        }
    }

    [[noreturn]] static void bad_number(const Call& current, const std::string& where) {
        fail(current, "strategy.not_finite", "gave a number that is not finite in " + where,
             report_it);
    }
    [[noreturn]] static void bad_index(const Call& current, const std::string& where,
                                       std::uint32_t value) {
        fail(current, "strategy.range",
             fmt::format("asked in {} for {}, which does not exist", where, value), report_it);
    }
};

class CheckedInitialMesh final : public Checked<hooks::InitialMesh> {
public:
    using Checked::Checked;

    mesh::TetMesh build(const hooks::InitialMeshContext& context) override {
        hooks::InitialMeshContext own_context = context;
        own_context.instance = instance();
        const Call current = call("build");
        mesh::TetMesh mesh = guarded(current, [&] { return inner().build(own_context); });
        if (mesh.tets.empty())
            fail(current, "strategy.size", "gave a mesh without tets", report_it);
        if (mesh.labels.size() != mesh.tets.size()) {
            fail(current, "strategy.size",
                 fmt::format("gave {} labels for {} tets", mesh.labels.size(), mesh.tets.size()),
                 report_it);
        }
        for (std::size_t i = 0; i < mesh.points.size(); ++i) {
            if (!mesh.points[i].allFinite()) {
                fail(current, "strategy.not_finite",
                     "gave " + entry("point", i) + " a coordinate that is not finite", report_it);
            }
        }
        for (std::size_t i = 0; i < mesh.tets.size(); ++i) {
            for (const std::uint32_t v : mesh.tets[i]) {
                if (v < mesh.points.size()) continue;
                fail(current, "strategy.range",
                     fmt::format("gave {} the point {} of {}", entry("tet", i), v,
                                 mesh.points.size()),
                     report_it);
            }
            if (mesh.labels[i] < 0) {
                fail(current, "strategy.range",
                     fmt::format("gave {} the label {} below 0", entry("tet", i), mesh.labels[i]),
                     report_it);
            }
        }
        return mesh;
    }

    hooks::Figures figures() const override {
        return checked_answer("figures", [&] { return inner().figures(); });
    }

    hooks::Warnings warnings() const override {
        return checked_answer("warnings", [&] { return inner().warnings(); });
    }

    hooks::Figures seconds() const override {
        return checked_answer("seconds", [&] { return inner().seconds(); });
    }
};

class CheckedImprovement final : public Checked<hooks::Improvement> {
public:
    using Checked::Checked;

    void propose(const hooks::StepContext& context, const repair::RepairRound& round,
                 std::vector<repair::Request>& out) override {
        const hooks::StepContext step = own(context);
        const Call current = call("propose", step.step);
        const std::size_t before = out.size();
        if (!class_count_) class_count_ = std::max<std::size_t>(1, repair_classes().size());
        guarded(current, [&] { inner().propose(step, round, out); });
        if (out.size() < before)
            fail(current, "strategy.size", "removed requests that were there before", report_it);
        const std::span<const repair::Request> added = std::span(out).subspan(before);
        constexpr std::size_t block = 4096;  // requests
        for_blocks(step.workers, added.size(), block, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i)
                check_answer(current, round.complex, *class_count_, added[i], i);
        });
    }

    std::vector<std::string> repair_classes() const override {
        const Call current = call("repair_classes");
        std::vector<std::string> names = guarded(current, [&] { return inner().repair_classes(); });
        if (names.size() > repair::repair_class_limit) {
            fail(current, "strategy.size",
                 fmt::format("named {} classes of requests; {} is the limit", names.size(),
                             repair::repair_class_limit),
                 report_it);
        }
        for (std::size_t i = 0; i < names.size(); ++i) {
            if (text::is_snake_case(names[i]) &&
                std::find(names.begin(), names.begin() + static_cast<std::ptrdiff_t>(i),
                          names[i]) == names.begin() + static_cast<std::ptrdiff_t>(i)) {
                continue;
            }
            fail(current, "strategy.range", "gave a class of requests the name '" + names[i] + "'",
                 "names are snake_case and differ; report this to the plugin's authors");
        }
        return names;
    }

    double flatness() const override {
        const Call current = call("flatness");
        const double cosine = guarded(current, [&] { return inner().flatness(); });
        if (!(cosine >= -1 && cosine <= 1)) {
            fail(current, "strategy.range", fmt::format("gave {:f}, which is not a cosine", cosine),
                 report_it);
        }
        return cosine;
    }

    repair::TopologyLimits topology_limits() const override {
        const Call current = call("topology_limits");
        const repair::TopologyLimits limits =
            guarded(current, [&] { return inner().topology_limits(); });
        for (const double value : {limits.thickness, limits.min_component}) {
            if (std::isfinite(value) && value >= 0) continue;
            fail(current, "strategy.range", "gave the limit " + std::to_string(value),
                 "limits must be finite and at least 0; report this to the plugin's authors");
        }
        return limits;
    }

    void select(const hooks::StepContext& context,
                std::span<const repair::TopologyCandidate> candidates,
                std::span<std::uint8_t> accept) override {
        const hooks::StepContext step = own(context);
        const Call current = call("select", step.step);
        constexpr std::uint8_t unset = 255;
        std::fill(accept.begin(), accept.end(), unset);
        guarded(current, [&] { inner().select(step, candidates, accept); });
        for (std::size_t i = 0; i < accept.size(); ++i) {
            if (accept[i] <= 1) continue;
            fail(current, "strategy.range",
                 fmt::format("gave {} the answer {} instead of 0 or 1", entry("candidate", i),
                             accept[i]),
                 report_it);
        }
    }

private:
    static void check_answer(const Call& current, const mesh::Complex& complex, std::size_t classes,
                             const repair::Request& request, std::size_t index) {
        // The text is made only for a fault, because there are many requests.
        const auto where = [index] { return "in " + entry("request", index); };
        if (static_cast<std::size_t>(request.operation) >= repair::operation_count) {
            fail(current, "strategy.range", "named an operation that does not exist " + where(),
                 report_it);
        }
        if (request.tet != mesh::none && request.tet >= complex.tet_slots()) {
            fail(current, "strategy.range",
                 fmt::format("named tet {}, which does not exist, {}", request.tet, where()),
                 report_it);
        }
        for (const mesh::VertexId v : request.vertices) {
            if (v == mesh::none || v < complex.vertex_slots()) continue;
            fail(current, "strategy.range",
                 fmt::format("named vertex {}, which does not exist, {}", v, where()), report_it);
        }
        if (request.repair_class >= classes) {
            fail(current, "strategy.range",
                 fmt::format("named the class {}, which does not exist, {}", request.repair_class,
                             where()),
                 report_it);
        }
        for (const float value : {request.parameter, request.only_below, request.accept_above,
                                  request.gain, request.least_edge}) {
            if (std::isnan(value))
                fail(current, "strategy.not_finite", "gave a number that is NaN " + where(),
                     report_it);
        }
    }

    std::optional<std::size_t> class_count_;  // 1 without names: class 0 then contains all requests
};

class CheckedObserver final : public Checked<hooks::Observer> {
public:
    using Checked::Checked;

    bool needs_faces_of_points() const override {
        return guarded(call("needs_faces_of_points"),
                       [&] { return inner().needs_faces_of_points(); });
    }

    bool needs_support() const override {
        return guarded(call("needs_support"), [&] { return inner().needs_support(); });
    }

    void begin(const hooks::StepContext& context) override {
        const hooks::StepContext step = own(context);
        guarded(call("begin", step.step), [&] { inner().begin(step); });
    }

    hooks::Figures step(const hooks::StepContext& context,
                        const hooks::StepFigures& figures) override {
        const hooks::StepContext own_context = own(context);
        const Call current = call("step", own_context.step);
        hooks::Figures result =
            guarded(current, [&] { return inner().step(own_context, figures); });
        check_answer(current, result);
        std::vector<std::string> names;
        for (const auto& figure : result) names.push_back(figure.first);
        if (names_ && *names_ != names) {
            fail(current, "strategy.size", "gave figures with other names than in its first step",
                 "the columns of metrics.csv must stay the same; report this to the plugin's "
                 "authors");
        }
        names_ = std::move(names);
        return result;
    }

    hooks::Figures end(const hooks::StepContext& context) override {
        const hooks::StepContext step = own(context);
        return checked_answer(
            "end", [&] { return inner().end(step); }, step.step);
    }

private:
    std::optional<std::vector<std::string>> names_;
};

}  // namespace

std::unique_ptr<hooks::Strategy> check_refinement(std::unique_ptr<hooks::RefinementPolicy> inner,
                                                  Attribution attribution) {
    return std::make_unique<CheckedRefinement>(std::move(inner), std::move(attribution));
}

std::unique_ptr<hooks::Strategy> check_initial_mesh(std::unique_ptr<hooks::InitialMesh> inner,
                                                    Attribution attribution) {
    return std::make_unique<CheckedInitialMesh>(std::move(inner), std::move(attribution));
}

std::unique_ptr<hooks::Strategy> check_improvement(std::unique_ptr<hooks::Improvement> inner,
                                                   Attribution attribution) {
    return std::make_unique<CheckedImprovement>(std::move(inner), std::move(attribution));
}

std::unique_ptr<hooks::Strategy> check_observer(std::unique_ptr<hooks::Observer> inner,
                                                Attribution attribution) {
    return std::make_unique<CheckedObserver>(std::move(inner), std::move(attribution));
}

}  // namespace dsc::plugin
