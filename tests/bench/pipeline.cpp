#include "pipeline.hpp"

#include <dsc/base/error.hpp>
#include <dsc/config/overrides.hpp>
#include <dsc/host/search_path.hpp>
#include <dsc/mesh/adopt.hpp>
#include <dsc/run/input.hpp>

#include "resources.hpp"

namespace dsc::bench {

Plugins::Plugins() {
    const std::vector<host::SearchEntry> folder = {{host::installed_folder(), "the build", true}};
    host_.load_all(folder);
}

run::LoadedExperiment Plugins::load(const std::string& file,
                                    const std::vector<std::string>& overrides) const {
    config::YamlOptions options;
    options.environment = [](const std::string& name) {
        const auto value = config::process_environment(name);
        return name == "DSC_DATA" && !value ? std::optional<std::string>(".") : value;
    };
    return run::load_experiment(
        file, overrides, [this](const auto&) -> const config::StrategyLookup& { return host_; },
        options);
}

config::StrategyConfig strategy(const std::string& type, std::span<const std::string> parameters) {
    return {type, config::apply_overrides(config::ConfigNode::map(), parameters)};
}

mesh::Complex initial_complex(const Plugins& plugins, const config::StrategyConfig& initial_mesh,
                              const cloud::TargetCloud* cloud) {
    const auto builder = plugins.host().create<hooks::InitialMesh>(initial_mesh, "initial_mesh");
    hooks::InitialMeshContext context;
    context.cloud = cloud;
    context.seed = 1;
    return mesh::adopt(builder->build(context), "initial mesh '" + initial_mesh.type + "'");
}

Phases& Phases::operator+=(const Phases& other) {
    velocity += other.velocity;
    move += other.move;
    improve += other.improve;
    refine += other.refine;
    return *this;
}

Body::Body(mesh::Complex complex, std::unique_ptr<hooks::Improvement> improvement,
           const cloud::TargetCloud* cloud, Workers* workers)
    : improvement_(std::move(improvement)),
      cloud_(cloud),
      workers_(workers),
      deformer_(std::move(complex), {}, workers) {
    policy_.propose = [this](const repair::RepairRound& round, std::vector<repair::Request>& out) {
        improvement_->propose(*context_, round, out);
    };
    policy_.select = [this](std::span<const repair::TopologyCandidate> candidates,
                            std::span<std::uint8_t> accept) {
        improvement_->select(*context_, candidates, accept);
    };
    policy_.topology = improvement_->topology_limits();
    policy_.flatness = improvement_->flatness();
    refresh();
}

void Body::refresh() { surface::build_view(deformer_.complex(), view_, workers_, &view_memory_); }

hooks::StepContext Body::context() const {
    return {.step = deformer_.step_count() + 1,
            .surface = view_,
            .cloud = cloud_,
            .target_length = deformer_.target_length(),
            .box = deformer_.complex().box(),
            .to_normalised = cloud_ != nullptr ? cloud_->transform() : cloud::Transform{},
            .seed = 1,
            .workers = workers_};
}

StepCost Body::step(const Displacement& displace) {
    StepCost cost;
    cost.interface_vertices = view_.vertex_count();
    const hooks::StepContext now = context();
    cost.seconds.velocity = cpu_of([&] {
        displacements_.assign(view_.vertex_count(), Vec3::Zero());
        displace(now, displacements_);
    });
    context_ = &now;
    kernel::StepReport report;
    const auto advance = [&] {
        report = deformer_.step(view_.vertex_ids, displacements_, policy_);
    };
    const double seconds = cpu_of([&] {
        if (counting_) {
            measured(advance);
        } else {
            advance();
        }
    });
    context_ = nullptr;
    cost.seconds.move = std::min(seconds, report.move_time.cpu);
    cost.seconds.improve = seconds - cost.seconds.move;
    cost.seconds.velocity += cpu_of([this] { refresh(); });
    cost.tets = deformer_.complex().tet_count();
    cost.rounds = report.rounds;
    cost.events = report.events.size();
    cost.dropped_motion = report.dropped_motion;
    for (const kernel::OperationCounts& counts : report.operations) {
        cost.tried += counts.tried;
        cost.committed += counts.committed;
    }
    return cost;
}

StepCost Body::idle() {
    return step([](const hooks::StepContext&, std::span<Vec3>) {});
}

double Body::refine(hooks::RefinementPolicy& policy, hooks::VelocityField* velocity) {
    return cpu_of([&] {
        const hooks::StepContext now = context();
        if (velocity != nullptr) velocity->prepare(now);
        hooks::RefinementRequests requests;
        policy.refine({now, velocity}, requests);
        if (!requests.sizing.empty() || !requests.relabel.empty()) {
            throw UsageError("bench.refinement",
                             "the benchmarks drive refinements that split faces or edges only");
        }
        std::vector<std::array<mesh::VertexId, 3>> faces;
        for (const std::uint32_t f : requests.split_faces) {
            const auto& [a, b, c] = view_.faces[f];
            faces.push_back({view_.vertex_ids[a], view_.vertex_ids[b], view_.vertex_ids[c]});
        }
        std::vector<std::array<mesh::VertexId, 2>> edges;
        for (const auto& [a, b] : requests.split_edges)
            edges.push_back({view_.vertex_ids[a], view_.vertex_ids[b]});
        deformer_.refine(faces, edges);
        refresh();
    });
}

Protocol::Protocol(const Plugins& plugins, const run::LoadedExperiment& loaded)
    : experiment_(loaded.experiment),
      cloud_(run::load_input(experiment_.input.value(), experiment_.seed, plugins.host(),
                             *loaded.files)
                 .target),
      strategies_(run::make_strategies(experiment_, plugins.host())),
      steps_(run::planned_steps(experiment_)) {
    body_ = std::make_unique<Body>(initial_complex(plugins, experiment_.initial_mesh, &*cloud_),
                                   std::move(strategies_.improvement), &*cloud_);
}

StepCost Protocol::step() {
    constexpr std::size_t block = 256;  // as `dsc run` does
    hooks::VelocityField& velocity = *strategies_.velocity;
    return body_->step([&](const hooks::StepContext& context, std::span<Vec3> out) {
        velocity.prepare(context);
        for (std::size_t first = 0; first < out.size(); first += block) {
            const std::size_t last = std::min(out.size(), first + block);
            velocity.evaluate({first, last}, out.subspan(first, last - first));
        }
    });
}

void Protocol::run_to(std::uint64_t last, const OnStep& on_step) {
    double refining = 0.0;
    while (done_ < last && item_ < experiment_.schedule.size()) {
        const run::Series& series = experiment_.schedule[item_];
        hooks::RefinementPolicy* refinement = strategies_.refinements[item_].get();
        if (!series.steps || in_item_ == *series.steps) {
            if (!series.steps) refining += refine(*refinement);
            ++item_;
            in_item_ = 0;
            continue;
        }
        StepCost cost = step();
        ++done_;
        ++in_item_;
        if (series.every && in_item_ % *series.every == 0) refining += refine(*refinement);
        cost.seconds.refine = refining;
        refining = 0.0;
        if (on_step) on_step(done_, cost);
    }
}

double Protocol::refine_again() {
    for (const auto& refinement : strategies_.refinements) {
        if (refinement) return refine(*refinement);
    }
    throw UsageError("bench.refinement", "the experiment has no refinement");
}

std::string thesis_file(const std::string& name) {
    return DSC_SOURCE_DIR "/configs/thesis/" + name + ".yaml";
}

run::LoadedExperiment thesis(const Plugins& plugins, const std::string& name, bool data) {
    const std::string file = thesis_file(name);
    if (data) return plugins.load(file, {});
    return plugins.load(file, {"input.cloud={sample: {shape: teapot, n: 5000}}"});
}

}  // namespace dsc::bench
