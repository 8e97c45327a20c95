// Refinement `@NAME@`: splits the interface edges at which the surface bends.
//
// An edge is split if the angle between the normals of its two faces is above `bend` and its length
// is at least `shortest`.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <tuple>

#include <dsc/hooks/refinement_policy.hpp>
#include <dsc/plugin/plugin.hpp>

namespace {

using dsc::surface::SurfaceView;

class @CLASS@ final : public dsc::hooks::RefinementPolicy {
public:
    /// The parameters that an experiment may set; the values here are the defaults.
    struct Params {
        double bend = 20.0;
        double shortest = 0.5;
    };
    static void declare(dsc::config::ParamSchema<Params>& schema) {
        schema.real("bend", &Params::bend)
            .range(0, 180, "degrees")
            .doc("Angle between the normals of the two faces of an edge above which the edge is "
                 "split.");
        schema.real("shortest", &Params::shortest)
            .range(0, 100, "current mean edges")
            .doc("Length below which edges are not split.");
    }

    @CLASS@(const Params& params, const dsc::plugin::Setup&) : params_(params) {}

    // Called between two steps. The kernel carries out the requests where it can, and counts the
    // others.
    void refine(const dsc::hooks::RefinementContext& context,
                dsc::hooks::RefinementRequests& out) override {
        const SurfaceView& surface = context.step.surface;
        const double flat = std::cos(params_.bend * std::numbers::pi / 180);
        const double shortest = params_.shortest * surface.mean_edge;
        const std::vector<Side> sides = sides_of(surface);
        for (std::size_t i = 0; i + 1 < sides.size(); ++i) {
            const auto& [a, b, face] = sides[i];
            const auto& [next_a, next_b, next_face] = sides[i + 1];
            if (a != next_a || b != next_b) continue;
            ++i;  // both sides of the edge are done
            if (surface.face_normals[face].dot(surface.face_normals[next_face]) >= flat) continue;
            if ((surface.positions[a] - surface.positions[b]).norm() < shortest) continue;
            out.split_edges.push_back({a, b});
        }
    }

private:
    // Lower vertex, higher vertex, face.
    using Side = std::tuple<std::uint32_t, std::uint32_t, std::uint32_t>;

    // Every edge once per face, sorted, so that the two sides of an edge follow each other.
    static std::vector<Side> sides_of(const SurfaceView& surface) {
        std::vector<Side> sides;
        for (std::uint32_t face = 0; face < surface.face_count(); ++face) {
            for (std::size_t k = 0; k < 3; ++k) {
                const auto [a, b] =
                    std::minmax(surface.faces[face][k], surface.faces[face][(k + 1) % 3]);
                sides.emplace_back(a, b, face);
            }
        }
        std::sort(sides.begin(), sides.end());
        return sides;
    }

    Params params_;
};

}  // namespace

DSC_PLUGIN("@NAME@", "0.1.0", "BSD-3-Clause", "Refinement @NAME@") {
    registrar.add<@CLASS@>("@NAME@", "splits interface edges at which the surface bends");
}
