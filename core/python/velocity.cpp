// A velocity and a curvature written in Python. Python is called once per step, when nothing else
// runs; evaluate() only copies, so the answers do not depend on the number of threads.
#include <algorithm>

#include <dsc/hooks/curvature_estimator.hpp>
#include <dsc/hooks/velocity_field.hpp>

#include "adapters.hpp"
#include "arrays.hpp"
#include "contexts.hpp"

namespace dsc::python {
namespace {

class PythonVelocity final : public hooks::VelocityField {
public:
    explicit PythonVelocity(Instance instance) : python_(std::move(instance)) {
        with_python([&] {
            advances_ = python_.has("advance");
            prepares_ = python_.has("prepare");
            samples_ = python_.has("sample");
            finishes_ = python_.has("finished");
            plans_ = python_.has("planned_steps");
            publishes_ = python_.has("publish");
        });
        needs_faces_ = python_.value("needs_faces_of_points", false);
        needs_support_ = python_.value("needs_support", false);
        creases_ = python_.creases();
    }

    bool needs_faces_of_points() const override { return needs_faces_; }
    bool needs_support() const override { return needs_support_; }
    bool can_sample() const override { return samples_; }
    std::optional<repair::CreaseRule> keep_creases() const override { return creases_; }

    void advance(const hooks::StepContext& context) override {
        if (!advances_) return;
        with_python([&] {
            with_view<StepView>(context, [&](const py::object& view) {
                python_.self().attr("advance")(view);
                return 0;
            });
        });
    }

    void prepare(const hooks::StepContext& context) override {
        displacements_ = with_python([&] {
            return with_view<StepView>(context, [&](const py::object& view) {
                if (prepares_) python_.self().attr("prepare")(view);
                return as_method("evaluate", [&] {
                    return answer_from(python_.self().attr("evaluate")(view), "evaluate()",
                                       context.surface.vertex_count());
                });
            });
        });
    }

    void evaluate(hooks::Range range, std::span<Vec3> out) const override {
        const auto first = displacements_.begin() + static_cast<std::ptrdiff_t>(range.begin);
        std::copy(first, first + static_cast<std::ptrdiff_t>(range.size()), out.begin());
    }

    void sample(std::span<const Vec3> points, std::span<const Vec3> unit_normals,
                std::span<Vec3> out) const override {
        if (!samples_) return VelocityField::sample(points, unit_normals, out);
        with_python([&] {
            const std::vector<Vec3> answer =
                answer_from(python_.self().attr("sample")(copy(points), copy(unit_normals)),
                            "sample()", points.size());
            std::copy(answer.begin(), answer.end(), out.begin());
        });
    }

    void publish(hooks::Attributes& out) const override {
        if (publishes_) python_.publish(out);
    }
    bool finished() const override { return finishes_ && python_.value("finished", false); }
    std::uint64_t planned_steps() const override {
        return plans_ ? python_.value<std::uint64_t>("planned_steps", 0) : 0;
    }
    void save(std::ostream& out) const override { python_.save(out); }
    void load(std::istream& in) override { python_.load(in); }

private:
    static py::array copy(std::span<const Vec3> values) {
        return copy_of(std::vector<Vec3>(values.begin(), values.end()));
    }

    Instance python_;
    bool advances_ = false, prepares_ = false, samples_ = false, finishes_ = false, plans_ = false,
         publishes_ = false, needs_faces_ = false, needs_support_ = false;
    std::optional<repair::CreaseRule> creases_;
    std::vector<Vec3> displacements_;
};

class PythonCurvature final : public hooks::CurvatureEstimator {
public:
    explicit PythonCurvature(Instance instance) : python_(std::move(instance)) {}

    void prepare(const hooks::StepContext& context) override {
        with_python([&] {
            with_view<StepView>(context, [&](const py::object& view) {
                if (python_.has("prepare")) python_.self().attr("prepare")(view);
                as_method("evaluate", [&] { ask(view, context.surface.vertex_count()); });
                return 0;
            });
        });
    }

    void evaluate(hooks::Range range, std::span<double> scalar,
                  std::span<Vec3> vector) const override {
        const auto first = static_cast<std::ptrdiff_t>(range.begin);
        const auto last = static_cast<std::ptrdiff_t>(range.end);
        std::copy(scalars_.begin() + first, scalars_.begin() + last, scalar.begin());
        std::copy(vectors_.begin() + first, vectors_.begin() + last, vector.begin());
    }

    void save(std::ostream& out) const override { python_.save(out); }
    void load(std::istream& in) override { python_.load(in); }

private:
    void ask(const py::object& view, std::size_t count) {
        const py::object answer = python_.self().attr("evaluate")(view);
        if (!py::isinstance<py::tuple>(answer) || py::len(answer) != 2)
            throw std::runtime_error(
                "evaluate() must return two arrays, the scalars and the vectors");
        scalars_ = numbers_answer_from(answer[py::int_(0)], "evaluate()[0]", count);
        vectors_ = answer_from(answer[py::int_(1)], "evaluate()[1]", count);
    }

    Instance python_;
    std::vector<double> scalars_;
    std::vector<Vec3> vectors_;
};

}  // namespace

std::unique_ptr<hooks::Strategy> adapt_velocity(Instance instance) {
    return std::make_unique<PythonVelocity>(std::move(instance));
}

std::unique_ptr<hooks::Strategy> adapt_curvature(Instance instance) {
    return std::make_unique<PythonCurvature>(std::move(instance));
}

}  // namespace dsc::python
