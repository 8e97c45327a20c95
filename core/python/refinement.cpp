// A refinement written in Python.
#include <fmt/core.h>

#include <dsc/base/error.hpp>
#include <dsc/config/spelling.hpp>
#include <dsc/hooks/refinement_policy.hpp>

#include "adapters.hpp"
#include "arrays.hpp"
#include "contexts.hpp"

namespace dsc::python {
namespace {

constexpr std::size_t any_index = std::size_t{1} << 32U;

/// The dict that refine() returns, entry by entry.
class Answer {
public:
    explicit Answer(const py::dict& dict) : dict_(dict) {}

    void read(hooks::RefinementRequests& out) {
        if (const py::object v = take("split_faces")) out.split_faces = indices(v, "split_faces");
        if (const py::object v = take("split_edges")) out.split_edges = pairs(v, "split_edges");
        if (const py::object v = take("sizing")) out.sizing = numbers_from(v, "sizing");
        if (const py::object v = take("relabel")) out.relabel = pairs(v, "relabel");
        read_collapses(out);
        read_flips(out);
        read_moves(out);
        if (const py::object v = take("target_length")) out.target_length = v.cast<double>();
        if (const py::object v = take("target_lengths"))
            out.target_lengths = numbers_from(v, "target_lengths");
        if (const py::object v = take("attributes"))
            out.attributes = attributes_from(v, "refine()['attributes']");
        refuse_unknown();
    }

private:
    py::object take(const char* key) {
        known_.emplace_back(key);
        return dict_.contains(key) ? py::object(dict_[key]) : py::object();
    }

    static std::vector<std::uint32_t> indices(const py::object& value, const char* name) {
        return indices_from(value, name, any_index);
    }
    static std::vector<std::array<std::uint32_t, 2>> pairs(const py::object& value,
                                                           const char* name) {
        return rows_from<2>(value, name, any_index);
    }

    /// The places that belong to requests; required if there are requests.
    std::vector<Vec3> places(const char* name, std::size_t count, const char* of) {
        const py::object value = take(name);
        std::vector<Vec3> all;
        if (value) all = vectors_from(value, name);
        require_size(all.size(), count, name, of);
        return all;
    }

    void read_collapses(hooks::RefinementRequests& out) {
        const py::object value = take("collapse_edges");
        std::vector<std::array<std::uint32_t, 2>> edges;
        if (value) edges = pairs(value, "collapse_edges");
        const std::vector<Vec3> where = places("collapse_places", edges.size(), "collapse_edges");
        for (std::size_t i = 0; i < edges.size(); ++i)
            out.collapse_edges.push_back({edges[i][0], edges[i][1], where[i]});
    }

    void read_flips(hooks::RefinementRequests& out) {
        const py::object value = take("flip_edges");
        const py::object flatness = take("flip_flatness");
        if (!value) return;
        for (const auto& edge : pairs(value, "flip_edges")) {
            hooks::FlipRequest& request = out.flip_edges.emplace_back();
            request.edge = edge;
            if (flatness) request.flatness = flatness.cast<double>();
        }
    }

    void read_moves(hooks::RefinementRequests& out) {
        const py::object value = take("move_vertices");
        std::vector<std::uint32_t> vertices;
        if (value) vertices = indices(value, "move_vertices");
        const std::vector<Vec3> where = places("move_places", vertices.size(), "move_vertices");
        for (std::size_t i = 0; i < vertices.size(); ++i)
            out.move_vertices.push_back({vertices[i], where[i]});
    }

    void refuse_unknown() const {
        for (const auto& item : dict_) {
            const auto key = py::str(item.first).cast<std::string>();
            if (std::find(known_.begin(), known_.end(), key) != known_.end()) continue;
            const auto near = config::closest(key, known_);
            throw std::runtime_error(fmt::format("refine() returned the unknown key '{}'{}", key,
                                                 near ? ", did you mean '" + *near + "'?" : ""));
        }
    }

    const py::dict& dict_;
    std::vector<std::string> known_;
};

class PythonRefinement final : public hooks::RefinementPolicy {
public:
    explicit PythonRefinement(Instance instance)
        : python_(std::move(instance)),
          samples_(python_.value("needs_sampling", false)),
          sizes_(python_.value("owns_sizing", false)),
          passes_(python_.value("passes", 1U)),
          needs_faces_(python_.value("needs_faces_of_points", false)),
          needs_support_(python_.value("needs_support", false)),
          creases_(python_.creases()) {}

    bool needs_faces_of_points() const override { return needs_faces_; }
    bool needs_support() const override { return needs_support_; }
    bool needs_sampling() const override { return samples_; }
    bool owns_sizing() const override { return sizes_; }
    std::optional<repair::CreaseRule> keep_creases() const override { return creases_; }
    unsigned passes() const override { return passes_; }

    void refine(const hooks::RefinementContext& context, hooks::RefinementRequests& out) override {
        with_python([&] {
            with_view<StepView>(context, [&](const py::object& view) {
                const py::object answer = python_.self().attr("refine")(view);
                if (answer.is_none()) return 0;
                if (!py::isinstance<py::dict>(answer))
                    throw std::runtime_error("refine() must return a dict of requests or None");
                Answer(py::dict(answer)).read(out);
                return 0;
            });
        });
    }

    void save(std::ostream& out) const override { python_.save(out); }
    void load(std::istream& in) override { python_.load(in); }

private:
    Instance python_;
    bool samples_, sizes_;
    unsigned passes_;
    bool needs_faces_, needs_support_;
    std::optional<repair::CreaseRule> creases_;
};

}  // namespace

std::unique_ptr<hooks::Strategy> adapt_refinement(Instance instance) {
    return std::make_unique<PythonRefinement>(std::move(instance));
}

}  // namespace dsc::python
