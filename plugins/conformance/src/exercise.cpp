#include "exercise.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include <fmt/core.h>

#include <dsc/run/mesh_files.hpp>
#include <dsc/surface/surface_view.hpp>

#include "asked_data.hpp"
#include "call_note.hpp"
#include "exercise_parts.hpp"
#include "guarded_input.hpp"
#include "requests.hpp"

namespace dsc::conformance {
namespace {

// The part of the input that differs; empty: none.
std::string difference(const Fixture& before, const Fixture& after) {
    const surface::SurfaceView& a = before.view;
    const surface::SurfaceView& b = after.view;
    if (!same_bytes(a.positions, b.positions)) return "the positions of the surface";
    if (!same_bytes(a.normals, b.normals) || !same_bytes(a.face_normals, b.face_normals))
        return "the surface's normals";
    if (!same_bytes(a.faces, b.faces) || !same_bytes(a.vertex_faces, b.vertex_faces))
        return "the surface's faces";
    if (!same_bytes(a.face_areas, b.face_areas)) return "the areas of the faces";
    if (!same_bytes(a.births, b.births) || !same_bytes(a.movable, b.movable))
        return "the ids of the vertices";
    if (!same_bytes(a.previous_positions, b.previous_positions) ||
        !same_bytes(a.arrived, b.arrived) || !same_bytes(a.age, b.age))
        return "what the vertices did before";
    if (!same_bytes(a.face_labels, b.face_labels)) return "the labels of the faces";
    return {};
}

bool same_cloud(const cloud::Cloud& a, const cloud::Cloud& b) {
    return same_bytes(a.points, b.points) && same_bytes(a.colours, b.colours) &&
           same_bytes(a.normals, b.normals) && same_bytes(a.areas, b.areas) &&
           same_bytes(a.confidence, b.confidence) &&
           same_bytes(a.orientation.samples, b.orientation.samples) && a.source == b.source;
}

void name_parts(const surface::SurfaceView& view) {
    name_memory(view.vertex_ids.data(), "the vertex ids of the surface");
    name_memory(view.births.data(), "the birth ids of the surface");
    name_memory(view.positions.data(), "the positions of the surface");
    name_memory(view.normals.data(), "the normals of the surface");
    name_memory(view.movable.data(), "the movable vertices of the surface");
    name_memory(view.faces.data(), "the faces of the surface");
    name_memory(view.face_tets.data(), "the tets behind the faces of the surface");
    name_memory(view.face_normals.data(), "the face normals of the surface");
    name_memory(view.face_areas.data(), "the face areas of the surface");
    name_memory(view.face_offsets.data(), "the face offsets of the surface");
    name_memory(view.vertex_faces.data(), "the faces of the vertices of the surface");
}

class Exerciser {
public:
    Exerciser(const Fixture& fixture, const Exercise& how)
        : fixture_(fixture), how_(how), workers_(how.threads) {}

    Answers run(plugin::Kind kind, hooks::Strategy& strategy) {
        if (kind == plugin::Kind::initial_mesh) {
            build(static_cast<hooks::InitialMesh&>(strategy));
            return std::move(answers_);
        }
        if (kind == plugin::Kind::filter) {
            filter(static_cast<hooks::CloudFilter&>(strategy));
            return std::move(answers_);
        }
        for (std::uint64_t step = how_.first_step; step < how_.first_step + how_.steps; ++step) {
            const Fixture before = at_step(fixture_, step);
            const Fixture now = in_guarded_memory([&] { return before; });
            name_parts(now.view);
            const hooks::StepContext context = context_of(now, step, how_, &workers_);
            at_ = " at step " + std::to_string(step);
            one_step(kind, strategy, now, context);
            if (answers_.changed.empty()) answers_.changed = difference(before, now);
        }
        return std::move(answers_);
    }

private:
    void one_step(plugin::Kind kind, hooks::Strategy& strategy, const Fixture& now,
                  const hooks::StepContext& context) {
        switch (kind) {
            case plugin::Kind::velocity:
                return velocity(static_cast<hooks::VelocityField&>(strategy), context);
            case plugin::Kind::curvature:
                return curvature(static_cast<hooks::CurvatureEstimator&>(strategy), context);
            case plugin::Kind::refinement:
                return refinement(static_cast<hooks::RefinementPolicy&>(strategy), context);
            case plugin::Kind::improvement:
                return improvement(static_cast<hooks::Improvement&>(strategy), now, context);
            case plugin::Kind::observer:
                return observer(static_cast<hooks::Observer&>(strategy), context);
            case plugin::Kind::initial_mesh:
            case plugin::Kind::filter: return;
        }
    }

    template <class T>
    void check_output(const Output<T>& output, const std::string& what) {
        const std::string touched = output.touched();
        if (!touched.empty() && answers_.outside.empty())
            answers_.outside = what + at_ + ": " + touched;
    }

    void velocity(hooks::VelocityField& field, const hooks::StepContext& given) {
        const hooks::StepContext context = asked_.complete(field, given);
        noted("advance", context.step, [&] { field.advance(context); });
        for (unsigned i = 0; i < how_.prepares; ++i)
            noted("prepare", context.step, [&] { field.prepare(context); });
        const std::size_t count = context.surface.vertex_count();
        std::vector<Vec3> all(count);
        std::vector<std::string> touched((count + how_.block - 1) / how_.block);
        const auto evaluate = [&](std::size_t begin, std::size_t end) {
            Output<Vec3> out(end - begin, Vec3::Constant(unwritten()));
            field.evaluate({begin, end}, out.entries());
            std::copy(out.entries().begin(), out.entries().end(),
                      all.begin() + static_cast<std::ptrdiff_t>(begin));
            touched[begin / how_.block] = out.touched();
        };
        noted("evaluate", context.step, [&] { workers_.for_blocks(count, how_.block, evaluate); });
        note_touched(touched, "displacements");
        record("displacements", std::span<const Vec3>(all), 3);
        if (field.can_sample()) sample(field, context);
        hooks::Attributes attributes;
        noted("publish", context.step, [&] { field.publish(attributes); });
        record(attributes, context);
        part("end of the motion", 1);
        const bool finished = noted("finished", context.step, [&] { return field.finished(); });
        answers_.trace.add(finished ? 1.0 : 0.0);
        answers_.trace.add(static_cast<double>(field.planned_steps()));
    }

    void record(const hooks::Attributes& attributes, const hooks::StepContext& context) {
        if (answers_.unfit.empty())
            answers_.unfit = unfit(attributes, context.surface.vertex_count());
        for (const hooks::Attribute& a : attributes)
            record("attribute " + a.name, std::span<const double>(a.values), 1);
    }

    void sample(hooks::VelocityField& field, const hooks::StepContext& context) {
        const surface::SurfaceView& view = context.surface;
        std::vector<Vec3> points;
        for (const auto& [a, b, c] : view.faces)
            points.push_back((view.positions[a] + view.positions[b] + view.positions[c]) / 3.0);
        Output<Vec3> out(points.size(), Vec3::Constant(unwritten()));
        noted("sample", context.step,
              [&] { field.sample(points, view.face_normals, out.entries()); });
        check_output(out, "sampled displacements");
        record("sampled displacements", std::span<const Vec3>(out.entries()), 3);
    }

    void curvature(hooks::CurvatureEstimator& estimator, const hooks::StepContext& context) {
        for (unsigned i = 0; i < how_.prepares; ++i)
            noted("prepare", context.step, [&] { estimator.prepare(context); });
        const std::size_t count = context.surface.vertex_count();
        std::vector<double> scalars(count);
        std::vector<Vec3> vectors(count);
        std::vector<std::string> touched((count + how_.block - 1) / how_.block);
        const auto evaluate = [&](std::size_t begin, std::size_t end) {
            Output<double> scalar(end - begin, unwritten());
            Output<Vec3> vector(end - begin, Vec3::Constant(unwritten()));
            estimator.evaluate({begin, end}, scalar.entries(), vector.entries());
            const auto to = static_cast<std::ptrdiff_t>(begin);
            std::copy(scalar.entries().begin(), scalar.entries().end(), scalars.begin() + to);
            std::copy(vector.entries().begin(), vector.entries().end(), vectors.begin() + to);
            touched[begin / how_.block] = scalar.touched() + vector.touched();
        };
        noted("evaluate", context.step, [&] { workers_.for_blocks(count, how_.block, evaluate); });
        note_touched(touched, "curvatures");
        record("curvatures", std::span<const double>(scalars), 1);
        record("curvature vectors", std::span<const Vec3>(vectors), 3);
    }

    void note_touched(const std::vector<std::string>& blocks, const std::string& what) {
        for (std::size_t i = 0; i < blocks.size(); ++i) {
            if (blocks[i].empty() || !answers_.outside.empty()) continue;
            answers_.outside = fmt::format("{} of the block that begins with vertex {}{}: {}", what,
                                           i * how_.block, at_, blocks[i]);
        }
    }

    void refinement(hooks::RefinementPolicy& policy, const hooks::StepContext& given) {
        const hooks::StepContext context = asked_.complete(policy, given, fixture_);
        Breathing velocity;
        velocity.prepare(context);
        hooks::RefinementRequests requests;
        noted("refine", context.step, [&] {
            policy.refine({context, policy.needs_sampling() ? &velocity : nullptr, 0}, requests);
        });
        if (answers_.unfit_lengths.empty())
            answers_.unfit_lengths = unfit_lengths(requests, context.surface.vertex_count());
        add_requests(requests, at_, answers_.trace);
        record(requests.attributes, context);
    }

    // One repair round on a mesh whose worst tets are marked as dirty.
    void improvement(hooks::Improvement& policy, const Fixture& now,
                     const hooks::StepContext& context) {
        if (!now.complex) return;
        const mesh::Complex& complex = *now.complex;
        std::vector<mesh::TetId> dirty;
        for (mesh::TetId t = 0; t < complex.tet_slots(); ++t) {
            if (complex.tet_alive(t) && complex.quality(t) < 0.6F) dirty.push_back(t);
        }
        std::sort(dirty.begin(), dirty.end(), [&](mesh::TetId a, mesh::TetId b) {
            return std::pair(complex.quality(a), a) < std::pair(complex.quality(b), b);
        });
        std::vector<mesh::VertexId> blocked(now.view.vertex_ids.begin(),
                                            now.view.vertex_ids.begin() + 8);
        std::vector<repair::Request> requests;
        const repair::RepairRound round{
            complex,           dirty, blocked,        {}, {}, context.target_length,
            policy.flatness(), 0,     how_.steps == 1};
        noted("propose", context.step, [&] { policy.propose(context, round, requests); });
        part("requests", 10);
        for (const repair::Request& r : requests) add(r);
        select(policy, context);
    }

    void select(hooks::Improvement& policy, const hooks::StepContext& context) {
        std::vector<repair::TopologyCandidate> candidates(6);
        for (std::size_t i = 0; i < candidates.size(); ++i) {
            candidates[i].kind = static_cast<repair::TopologyCandidate::Kind>(i % 4);
            candidates[i].centroid = Vec3(0.1 * static_cast<double>(i), 0, 0);
            candidates[i].thickness = 0.2 * static_cast<double>(i);
            candidates[i].volume = 1.0;
        }
        std::vector<std::uint8_t> accept(candidates.size(), 0);
        noted("select", context.step, [&] { policy.select(context, candidates, accept); });
        part("accepted candidates", 1);
        for (const std::uint8_t a : accept) answers_.trace.add(a);
    }

    void add(const repair::Request& r) {
        Trace& t = answers_.trace;
        t.add(static_cast<double>(r.operation));
        t.add(static_cast<double>(r.mode) + 10.0 * r.repair_class);
        t.add(r.tet);
        for (const mesh::VertexId v : r.vertices) t.add(v);
        for (const float f : {r.parameter, r.only_below, r.accept_above, r.gain})
            t.add(static_cast<double>(f));
    }

    void observer(hooks::Observer& observer, const hooks::StepContext& given) {
        const hooks::StepContext context = asked_.complete(observer, given, fixture_);
        if (context.step == 1) noted("begin", context.step, [&] { observer.begin(context); });
        hooks::StepFigures figures;
        figures.step = context.step;
        figures.interface_vertices = context.surface.vertex_count();
        figures.tets = 1000;
        figures.volume = 3.0;
        figures.min_tet_quality = 0.2;
        add("figures of the step",
            noted("step", context.step, [&] { return observer.step(context, figures); }));
        add("figures of the end",
            noted("end", context.step, [&] { return observer.end(context); }));
    }

    void add(const std::string& what, const hooks::Figures& figures) {
        std::string name = what;
        for (const auto& figure : figures) name += " " + figure.first;
        part(name, 1);
        for (const auto& figure : figures) {
            answers_.trace.add(static_cast<double>(stream_id(figure.first) >> 12U));
            answers_.trace.add(figure.second);
        }
    }

    void build(hooks::InitialMesh& generator) {
        const run::MeshFiles files;
        hooks::InitialMeshContext context;
        context.cloud = fixture_.cloud ? &*fixture_.cloud : nullptr;
        context.seed = how_.seed;
        context.cancel = how_.cancel;
        context.files = &files;
        context.workers = &workers_;
        const mesh::TetMesh mesh =
            noted("build", std::nullopt, [&] { return generator.build(context); });
        record("points", std::span<const Vec3>(mesh.points), 3);
        part("tets", 4);
        for (const auto& tet : mesh.tets) {
            for (const std::uint32_t v : tet) answers_.trace.add(v);
        }
        part("labels", 1);
        for (const mesh::Label label : mesh.labels) answers_.trace.add(label);
    }

    void filter(hooks::CloudFilter& filter) {
        const cloud::Cloud before = cloud_of(fixture_);
        if (before.points.empty()) return;  // in a run there is at least one point
        const cloud::Cloud cloud = in_guarded_memory([&] { return before; });
        name_memory(cloud.points.data(), "the points of the cloud");
        const cloud::Filtered result = noted("apply", std::nullopt, [&] {
            return filter.apply(cloud, filter_context(how_, &workers_));
        });
        if (!same_cloud(before, cloud)) answers_.changed = "the cloud";
        record("points", std::span<const Vec3>(result.cloud.points), 3);
        part("colours", 3);
        for (const cloud::Colour& colour : result.cloud.colours) {
            for (const std::uint8_t value : colour) answers_.trace.add(value);
        }
        record("normals", std::span<const Vec3>(result.cloud.normals), 3);
        record("areas", std::span<const Vec3>(result.cloud.areas), 3);
        record("confidences", std::span<const double>(result.cloud.confidence), 1);
        part("orientation", 1);
        for (const cloud::SurfaceSample& sample : result.cloud.orientation.samples) {
            for (const Vec3& v : {sample.position, sample.area})
                answers_.trace.add(std::span<const double>(v.data(), 3));
            answers_.trace.add(sample.width);
        }
        add(result.report);
    }

    void add(const cloud::FilterReport& report) {
        part("counts", 1);
        answers_.trace.add(static_cast<double>(report.kept));
        answers_.trace.add(static_cast<double>(report.removed));
        for (const cloud::RemovedPoints& removed : report.reasons) {
            answers_.trace.add(static_cast<double>(stream_id(removed.reason) >> 12U));
            answers_.trace.add(static_cast<double>(removed.count));
        }
        for (const std::string& note : report.notes)
            answers_.trace.add(static_cast<double>(stream_id(note) >> 12U));
        add("figures", report.figures);
    }

    void part(const std::string& name, std::size_t width) {
        answers_.trace.part(name + at_, width);
    }
    template <class T>
    void record(const std::string& name, std::span<const T> values, std::size_t width) {
        part(name, width);
        answers_.trace.add(values);
    }

    const Fixture& fixture_;
    const Exercise& how_;
    Workers workers_;
    AskedData asked_;
    Answers answers_;
    std::string at_;
};

}  // namespace

cloud::Cloud cloud_of(const Fixture& fixture) {
    cloud::Cloud cloud;
    cloud.source = "the fixture's cloud";
    if (!fixture.cloud) return cloud;
    cloud.points.assign(fixture.cloud->points().begin(), fixture.cloud->points().end());
    const Vec3 middle = bounding_box(cloud.points).centre();
    for (std::size_t i = 0; i < cloud.points.size(); ++i) {
        const Vec3 outwards = cloud.points[i] - middle;
        cloud.colours.push_back(
            {static_cast<std::uint8_t>(i), static_cast<std::uint8_t>(i >> 8U), 0});
        cloud.normals.push_back(outwards.norm() > 0.0 ? Vec3(outwards.normalized())
                                                      : Vec3(Vec3::UnitZ()));
        cloud.areas.push_back(0.01 * cloud.normals.back());
        cloud.confidence.push_back(0.25 * static_cast<double>(i % 5));
    }
    return cloud;
}

hooks::FilterContext filter_context(const Exercise& how, Workers* workers) {
    hooks::FilterContext context;
    context.seed = how.seed;
    context.instance = stream_id("conformance");
    context.cancel = how.cancel;
    context.workers = workers;
    return context;
}

hooks::StepContext context_of(const Fixture& fixture, std::uint64_t step, const Exercise& how,
                              Workers* workers) {
    return {.step = step,
            .surface = fixture.view,
            .cloud = fixture.cloud ? &*fixture.cloud : nullptr,
            .target_length = fixture.view.mean_edge,
            .box = fixture.box,
            .to_normalised = {},
            .seed = how.seed,
            .instance = stream_id("conformance"),
            .cancel = how.cancel,
            .workers = workers};
}

Answers exercise(plugin::Kind kind, hooks::Strategy& strategy, const Fixture& fixture,
                 const Exercise& how) {
    return Exerciser(fixture, how).run(kind, strategy);
}

}  // namespace dsc::conformance
