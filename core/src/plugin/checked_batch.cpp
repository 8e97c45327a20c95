// Velocity and curvature: checks batches of values per vertex, which are computed concurrently.
#include <cmath>
#include <limits>

#include <fmt/core.h>

#include <dsc/config/yaml.hpp>

#include "plugin/checked.hpp"
#include "plugin/fenced.hpp"

namespace dsc::plugin {
namespace {

constexpr double unset = std::numeric_limits<double>::quiet_NaN();
constexpr std::string_view values_remedy = "every entry of the output must be written with a "
                                           "finite number; report this to the plugin's authors";

std::string number(double value) {
    if (std::isfinite(value)) return config::real_text(value);
    if (std::isnan(value)) return "nan";  // never "-nan", whatever its sign bit
    return value > 0 ? "inf" : "-inf";
}

std::string vector_text(const Vec3& v) {
    return "(" + number(v.x()) + ", " + number(v.y()) + ", " + number(v.z()) + ")";
}

// "vertex 12 (birth id 40, at (0.1, 0.2, 0.3))"
std::string vertex_text(const hooks::StepContext& context, std::size_t vertex) {
    const surface::SurfaceView& view = context.surface;
    std::string text = fmt::format("vertex {} (", vertex);
    if (vertex < view.births.size()) text += fmt::format("birth id {}, ", view.births[vertex]);
    if (vertex < view.positions.size()) text += "at " + vector_text(view.positions[vertex]);
    return text + ")";
}

[[noreturn]] void wrote_outside(const Call& current, const std::string& whose,
                                std::size_t entries) {
    fail(current, "strategy.outside",
         fmt::format("wrote outside the {} entries of its output{}", entries, whose),
         "an output ends at the end of its span; report this to the plugin's authors");
}

std::string range_text(const hooks::StepContext& context, hooks::Range range) {
    return ", for the block that begins with " + vertex_text(context, range.begin);
}

// The context that evaluate() calls refer to until the next prepare().
class StepMemory {
public:
    const hooks::StepContext& keep(hooks::StepContext context) {
        return context_.emplace(std::move(context));
    }
    const hooks::StepContext& get(const Call& call) const {
        if (!context_)
            throw Error(ExitCode::internal, "plugin.not_prepared", call.who.describe(),
                        "it was called before it was prepared", "call prepare() first");
        return *context_;
    }

private:
    std::optional<hooks::StepContext> context_;
};

class CheckedVelocity final : public Checked<hooks::VelocityField> {
public:
    using Checked::Checked;

    bool needs_faces_of_points() const override {
        return guarded(call("needs_faces_of_points"),
                       [&] { return inner().needs_faces_of_points(); });
    }

    bool needs_support() const override {
        return guarded(call("needs_support"), [&] { return inner().needs_support(); });
    }

    void advance(const hooks::StepContext& context) override {
        const hooks::StepContext& kept = step_.keep(own(context));
        guarded(call("advance", kept.step), [&] { inner().advance(kept); });
    }

    void prepare(const hooks::StepContext& context) override {
        const hooks::StepContext& kept = step_.keep(own(context));
        guarded(call("prepare", kept.step), [&] { inner().prepare(kept); });
    }

    void evaluate(hooks::Range range, std::span<Vec3> out) const override {
        const hooks::StepContext& context = step_.get(call("evaluate"));
        const Call current = call("evaluate", context.step);
        Fenced<Vec3> fenced(out.size(), Vec3::Constant(unset));
        const std::span<Vec3> given = fenced.entries();
        guarded(current, [&] { inner().evaluate(range, given); });
        if (!fenced.intact()) wrote_outside(current, range_text(context, range), out.size());
        for (std::size_t i = 0; i < out.size(); ++i) {
            if (!given[i].allFinite()) {
                fail(current, "strategy.not_finite",
                     "gave the displacement " + vector_text(given[i]) + " to " +
                         vertex_text(context, range.begin + i),
                     values_remedy);
            }
            out[i] = given[i];
        }
    }

    bool can_sample() const override {
        return guarded(call("can_sample"), [&] { return inner().can_sample(); });
    }

    void sample(std::span<const Vec3> points, std::span<const Vec3> unit_normals,
                std::span<Vec3> out) const override {
        const Call current = call("sample", step_.get(call("sample")).step);
        Fenced<Vec3> fenced(out.size(), Vec3::Constant(unset));
        const std::span<Vec3> given = fenced.entries();
        guarded(current, [&] { inner().sample(points, unit_normals, given); });
        if (!fenced.intact()) wrote_outside(current, "", out.size());
        for (std::size_t i = 0; i < out.size(); ++i) {
            if (!given[i].allFinite()) {
                fail(current, "strategy.not_finite",
                     fmt::format("gave the displacement {} to point {} at {}",
                                 vector_text(given[i]), i, vector_text(points[i])),
                     values_remedy);
            }
            out[i] = given[i];
        }
    }

    void publish(hooks::Attributes& out) const override {
        const hooks::StepContext& context = step_.get(call("publish"));
        const Call current = call("publish", context.step);
        hooks::Attributes given;
        guarded(current, [&] { inner().publish(given); });
        check_answer(current, given, context.surface.vertex_count());
        for (hooks::Attribute& a : given) out.push_back(std::move(a));
    }

    bool finished() const override {
        return guarded(call("finished"), [&] { return inner().finished(); });
    }

    std::optional<repair::CreaseRule> keep_creases() const override {
        return checked_answer("keep_creases", [&] { return inner().keep_creases(); });
    }

    std::uint64_t planned_steps() const override {
        return guarded(call("planned_steps"), [&] { return inner().planned_steps(); });
    }

private:
    StepMemory step_;
};

class CheckedCurvature final : public Checked<hooks::CurvatureEstimator> {
public:
    using Checked::Checked;

    void prepare(const hooks::StepContext& context) override {
        const hooks::StepContext& kept = step_.keep(own(context));
        guarded(call("prepare", kept.step), [&] { inner().prepare(kept); });
    }

    void evaluate(hooks::Range range, std::span<double> scalar,
                  std::span<Vec3> vector) const override {
        const hooks::StepContext& context = step_.get(call("evaluate"));
        const Call current = call("evaluate", context.step);
        Fenced<double> scalars(scalar.size(), unset);
        Fenced<Vec3> vectors(vector.size(), Vec3::Constant(unset));
        const std::span<double> s = scalars.entries();
        const std::span<Vec3> v = vectors.entries();
        guarded(current, [&] { inner().evaluate(range, s, v); });
        if (!scalars.intact() || !vectors.intact()) {
            wrote_outside(current, range_text(context, range), scalar.size());
        }
        for (std::size_t i = 0; i < s.size(); ++i) {
            if (!std::isfinite(s[i]) || !v[i].allFinite()) {
                fail(current, "strategy.not_finite",
                     "gave the curvature " + number(s[i]) + " and the vector " + vector_text(v[i]) +
                         " to " + vertex_text(context, range.begin + i),
                     values_remedy);
            }
            scalar[i] = s[i];
            vector[i] = v[i];
        }
    }

private:
    StepMemory step_;
};

}  // namespace

std::unique_ptr<hooks::Strategy> check_velocity(std::unique_ptr<hooks::VelocityField> inner,
                                                Attribution attribution) {
    return std::make_unique<CheckedVelocity>(std::move(inner), std::move(attribution));
}

std::unique_ptr<hooks::Strategy> check_curvature(std::unique_ptr<hooks::CurvatureEstimator> inner,
                                                 Attribution attribution) {
    return std::make_unique<CheckedCurvature>(std::move(inner), std::move(attribution));
}

}  // namespace dsc::plugin
