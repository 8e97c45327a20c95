// Observer `@NAME@`: the sphericity of the surface, and the fraction of narrow faces.
//
//     sphericity = cbrt(36 pi V^2) / A
//
// where V is the volume inside the surface and A its area; it is 1 for a sphere. A face is narrow
// if its smallest angle is below `narrow`.
#include <algorithm>
#include <cmath>
#include <istream>
#include <limits>
#include <numbers>
#include <ostream>

#include <dsc/geometry/corner.hpp>
#include <dsc/hooks/observer.hpp>
#include <dsc/plugin/plugin.hpp>

namespace {

using dsc::Vec3;
using dsc::surface::SurfaceView;

class @CLASS@ final : public dsc::hooks::Observer {
public:
    /// The parameters that an experiment may set; the values here are the defaults.
    struct Params {
        double narrow = 15.0;
    };
    static void declare(dsc::config::ParamSchema<Params>& schema) {
        schema.real("narrow", &Params::narrow)
            .range(0, 60, "degrees")
            .doc("Angle below which a face counts as narrow.");
    }

    @CLASS@(const Params& params, const dsc::plugin::Setup&) : params_(params) {}

    void begin(const dsc::hooks::StepContext& context) override {
        least_sphericity_ = sphericity(context.surface);
    }

    // Called after each step, for a row of metrics.csv. The names are the same in every step.
    dsc::hooks::Figures step(const dsc::hooks::StepContext& context,
                             const dsc::hooks::StepFigures&) override {
        const double now = sphericity(context.surface);
        least_sphericity_ = std::min(least_sphericity_, now);
        return {{"sphericity", now}, {"narrow_faces", narrow_faces(context.surface)}};
    }

    // Called after the last step, for summary.json.
    dsc::hooks::Figures end(const dsc::hooks::StepContext& context) override {
        return {{"sphericity", sphericity(context.surface)},
                {"narrow_faces", narrow_faces(context.surface)},
                {"least_sphericity", least_sphericity_}};
    }

    // Writes everything that is kept between steps, so that a resumed run continues as if it had
    // never stopped.
    void save(std::ostream& out) const override {
        out.precision(std::numeric_limits<double>::max_digits10);
        out << "1 " << least_sphericity_ << " end\n";
    }

    void load(std::istream& in) override {
        int version = 0;
        double least = 0;
        std::string mark;
        if (!(in >> version >> least >> mark) || version != 1 || mark != "end")
            throw dsc::StrategyError("@NAME@.state", "observer '@NAME@'",
                                     "its saved state is damaged", "start the run again");
        least_sphericity_ = least;
    }

private:
    // In mean edges, so that the sums work for a surface of any size. The volume is that of the
    // tets between the first vertex and the faces.
    static double sphericity(const SurfaceView& surface) {
        const auto at = [&](std::uint32_t v) {
            return Vec3((surface.positions[v] - surface.positions[0]) / surface.mean_edge);
        };
        double volume = 0;
        double area = 0;
        for (const auto& [a, b, c] : surface.faces) {
            const Vec3 p = at(a);
            const Vec3 q = at(b);
            const Vec3 r = at(c);
            volume += p.dot(q.cross(r)) / 6;
            area += (q - p).cross(r - p).norm() / 2;
        }
        return area > 0 ? std::cbrt(36 * std::numbers::pi * volume * volume) / area : 0.0;
    }

    double narrow_faces(const SurfaceView& surface) const {
        if (surface.face_count() == 0) return 0.0;
        const double bound = params_.narrow * std::numbers::pi / 180;
        std::size_t count = 0;
        for (const auto& [a, b, c] : surface.faces) {
            const Vec3& p = surface.positions[a];
            const Vec3& q = surface.positions[b];
            const Vec3& r = surface.positions[c];
            const double least = std::min({dsc::geometry::corner_angle(p, q, r),
                                           dsc::geometry::corner_angle(q, r, p),
                                           dsc::geometry::corner_angle(r, p, q)});
            if (least < bound) ++count;
        }
        return static_cast<double>(count) / static_cast<double>(surface.face_count());
    }

    Params params_;
    double least_sphericity_ = 1.0;
};

}  // namespace

DSC_PLUGIN("@NAME@", "0.1.0", "BSD-3-Clause", "Observer @NAME@") {
    registrar.add<@CLASS@>("@NAME@", "sphericity of the surface and its fraction of narrow faces");
}
