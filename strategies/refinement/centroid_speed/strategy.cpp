// Refinement `centroid_speed`: splits faces that rest on three vertices but do not follow the
// target between them.
//
// Requests a split of every interface face whose three vertices are at rest while its centroid is
// not: "a face that is out-of-place, but whose endpoints are happy where they are" [Saul2015, ch.
// 7]. The speed of a point is the length of velocity->sample() there, with the normal of the vertex
// or of the face.
#include <algorithm>

#include <dsc/base/version.hpp>
#include <dsc/hooks/refinement_policy.hpp>
#include <dsc/plugin/plugin.hpp>

namespace {

using dsc::Vec3;

class CentroidSpeed final : public dsc::hooks::RefinementPolicy {
public:
    /// The parameters that an experiment may set; the values here are the defaults.
    struct Params {
        double rest = 0.02;
        double moving = 0.02;
        double absolute = 0.0;
        double finest = 0.0;
    };
    static void declare(dsc::config::ParamSchema<Params>& schema) {
        schema.real("rest", &Params::rest)
            .at_least(0, "current mean edges")
            .doc("Distance per step below which a vertex is at rest.");
        schema.real("moving", &Params::moving)
            .at_least(0, "current mean edges")
            .doc("Distance per step of the centroid above which a face is split if its vertices "
                 "are at rest.");
        schema.real("absolute", &Params::absolute)
            .at_least(0, "length")
            .doc("Distance per step that replaces both thresholds, for any mean edge; 0: not used; "
                 "0.0015 in the program of the thesis.");
        schema.real("finest", &Params::finest)
            .at_least(0, "neighbour distances")
            .doc("Length of the longest edge below which faces are not split, in neighbour "
                 "distances (from the point nearest to the centroid to its sixth neighbour), "
                 "because the points contain no information about smaller details. 0: no bound.");
    }

    CentroidSpeed(const Params& params, const dsc::plugin::Setup&) : params_(params) {}

    bool needs_sampling() const override { return true; }

    void refine(const dsc::hooks::RefinementContext& context,
                dsc::hooks::RefinementRequests& out) override {
        mark_resting(context);
        collect_faces(context.step);
        const double moving = params_.absolute > 0
                                  ? params_.absolute
                                  : params_.moving * context.step.surface.mean_edge;
        displacements_.resize(candidates_.size());
        context.velocity->sample(points_, normals_, displacements_);
        for (std::size_t i = 0; i < candidates_.size(); ++i) {
            if (displacements_[i].norm() > moving) out.split_faces.push_back(candidates_[i]);
        }
    }

private:
    void mark_resting(const dsc::hooks::RefinementContext& context) {
        const dsc::surface::SurfaceView& surface = context.step.surface;
        const double rest =
            params_.absolute > 0 ? params_.absolute : params_.rest * surface.mean_edge;
        displacements_.resize(surface.vertex_count());
        context.velocity->sample(surface.positions, surface.normals, displacements_);
        resting_.resize(surface.vertex_count());
        for (std::size_t v = 0; v < resting_.size(); ++v)
            resting_[v] = displacements_[v].norm() < rest ? 1 : 0;
    }

    void collect_faces(const dsc::hooks::StepContext& step) {
        const dsc::surface::SurfaceView& surface = step.surface;
        candidates_.clear();
        points_.clear();
        normals_.clear();
        for (std::uint32_t face = 0; face < surface.face_count(); ++face) {
            const auto& [a, b, c] = surface.faces[face];
            if (resting_[a] == 0 || resting_[b] == 0 || resting_[c] == 0 || too_fine(step, face))
                continue;
            candidates_.push_back(face);
            points_.push_back((surface.positions[a] + surface.positions[b] + surface.positions[c]) /
                              3);
            normals_.push_back(surface.face_normals[face]);
        }
    }

    bool too_fine(const dsc::hooks::StepContext& step, std::uint32_t face) const {
        if (!(params_.finest > 0) || step.cloud == nullptr) return false;
        const auto& [a, b, c] = step.surface.faces[face];
        const auto& x = step.surface.positions;
        const double longest =
            std::max({(x[a] - x[b]).norm(), (x[b] - x[c]).norm(), (x[c] - x[a]).norm()});
        const dsc::cloud::Neighbour nearest =
            step.cloud->search().nearest((x[a] + x[b] + x[c]) / 3);
        return longest < params_.finest * step.cloud->neighbour_distance(nearest.index);
    }

    Params params_;
    // Kept between calls to reuse their memory.
    std::vector<std::uint8_t> resting_;      // of each vertex
    std::vector<std::uint32_t> candidates_;  // faces with three resting vertices
    std::vector<Vec3> points_, normals_, displacements_;
};

}  // namespace

DSC_PLUGIN("centroid_speed", DSC_VERSION, "BSD-3-Clause",
           "Splitting of faces that rest away from their target") {
    registrar.add<CentroidSpeed>(
        "centroid_speed",
        "splits interface faces whose vertices rest while their centroid would move");
}
