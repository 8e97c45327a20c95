// Curvature `@NAME@`: the mean curvature of the circles that touch the surface at a vertex and pass
// through its neighbours.
//
//     K = mean over the neighbours y of 2 N.(x - y) / |x - y|^2
//
// where x is the vertex and N its outward unit normal. A circle smaller than `smallest_circle`
// counts as one of that size. K is 1/r on a sphere of radius r.
#include <algorithm>

#include <dsc/hooks/curvature_estimator.hpp>
#include <dsc/plugin/plugin.hpp>

namespace {

using dsc::Vec3;

class @CLASS@ final : public dsc::hooks::CurvatureEstimator {
public:
    /// The parameters that an experiment may set; the values here are the defaults.
    struct Params {
        double smallest_circle = 0.5;
    };
    static void declare(dsc::config::ParamSchema<Params>& schema) {
        schema.real("smallest_circle", &Params::smallest_circle)
            .range(0, 100, "current mean edges")
            .open_low()
            .doc(
                "Least radius of the circles; a smaller circle counts as a circle of this radius.");
    }

    @CLASS@(const Params& params, const dsc::plugin::Setup&) : params_(params) {}

    // Called before evaluate(), any number of times per step and for any surface; it only computes.
    // The context is valid until the next call.
    void prepare(const dsc::hooks::StepContext& context) override {
        surface_ = &context.surface;
        limit_ = 1 / (params_.smallest_circle * surface_->mean_edge);
    }

    // Several threads call this at the same time, each for its own range: it only reads, and writes
    // only its two outputs.
    void evaluate(dsc::hooks::Range range, std::span<double> scalar,
                  std::span<Vec3> vector) const override {
        for (std::size_t i = 0; i < range.size(); ++i) {
            const std::size_t v = range.begin + i;
            scalar[i] = at(v);
            vector[i] = scalar[i] * surface_->normals[v];
        }
    }

private:
    // Around a closed vertex every neighbour is in two faces, so the mean over the faces is the
    // mean over the neighbours.
    double at(std::size_t vertex) const {
        double sum = 0;
        std::size_t count = 0;
        for (const std::uint32_t face : surface_->faces_of(vertex)) {
            for (const std::uint32_t v : surface_->faces[face]) {
                const Vec3 back = surface_->positions[vertex] - surface_->positions[v];
                const double square = back.squaredNorm();
                if (!(square > 0)) continue;  // the vertex itself, or a neighbour in the same place
                const double bend = 2 * surface_->normals[vertex].dot(back) / square;
                sum += std::clamp(bend, -limit_, limit_);
                ++count;
            }
        }
        return count == 0 ? 0.0 : sum / static_cast<double>(count);
    }

    Params params_;
    const dsc::surface::SurfaceView* surface_ = nullptr;
    double limit_ = 0.0;  // 1/length
};

}  // namespace

DSC_PLUGIN("@NAME@", "0.1.0", "BSD-3-Clause", "Curvature @NAME@") {
    registrar.add<@CLASS@>("@NAME@", "mean curvature of the circles through the neighbours");
}
