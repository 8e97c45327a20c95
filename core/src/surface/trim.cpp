// Removes the parts of a surface that no data supports.
#include "dsc/surface/trim.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

#include <fmt/core.h>

#include <dsc/base/error.hpp>
#include <dsc/geometry/quality.hpp>
#include <dsc/surface/measure.hpp>

namespace dsc::surface {
namespace {

constexpr double border_part = 0.5;    // of the bound: the border of the removed part is moved back
                                       // to this
constexpr double least_island = 0.02;  // of the remaining area
constexpr std::uint32_t none = 0xffffffffU;
constexpr int tooth_rounds = 3;

/// Faces joined through edges: per face, the three faces across its edges, or none.
std::vector<std::array<std::uint32_t, 3>> faces_across(const TriangleMesh& mesh) {
    struct Side {
        std::uint32_t low, high, face, edge;
    };
    std::vector<Side> sides;
    sides.reserve(3 * mesh.faces.size());
    for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
        for (std::uint32_t e = 0; e < 3; ++e) {
            const std::uint32_t a = mesh.faces[f][e], b = mesh.faces[f][(e + 1) % 3];
            sides.push_back({std::min(a, b), std::max(a, b), f, e});
        }
    }
    std::sort(sides.begin(), sides.end(), [](const Side& l, const Side& r) {
        return std::array{l.low, l.high, l.face, l.edge} <
               std::array{r.low, r.high, r.face, r.edge};
    });
    std::vector<std::array<std::uint32_t, 3>> across(mesh.faces.size(), {none, none, none});
    for (std::size_t i = 0; i + 1 < sides.size(); ++i) {
        const Side &l = sides[i], &r = sides[i + 1];
        if (l.low != r.low || l.high != r.high) continue;
        across[l.face][l.edge] = r.face;
        across[r.face][r.edge] = l.face;
    }
    return across;
}

class Trimmer {
public:
    explicit Trimmer(const TriangleMesh& mesh)
        : mesh_(mesh), across_(faces_across(mesh)), kept_(mesh.faces.size(), 1) {}

    const std::vector<std::uint8_t>& kept() const { return kept_; }

    template <class Bad>
    void remove(Bad&& bad) {
        for (std::size_t f = 0; f < kept_.size(); ++f) {
            if (bad(mesh_.faces[f])) kept_[f] = 0;
        }
    }

    /// Removes faces for which `weak` is true and that lie next to removed ones, and repeats this.
    template <class Weak>
    void spread(Weak&& weak) {
        std::vector<std::uint32_t> front;
        for (std::uint32_t f = 0; f < kept_.size(); ++f) {
            if (kept_[f] == 0) front.push_back(f);
        }
        while (!front.empty()) {
            const std::uint32_t f = front.back();
            front.pop_back();
            for (const std::uint32_t g : across_[f]) {
                if (g == none || kept_[g] == 0 || !weak(mesh_.faces[g])) continue;
                kept_[g] = 0;
                front.push_back(g);
            }
        }
    }

    void remove_teeth() {
        for (int round = 0; round < tooth_rounds; ++round) {
            std::vector<std::uint32_t> teeth;
            for (std::uint32_t f = 0; f < kept_.size(); ++f) {
                if (kept_[f] != 0 && border_edges(f) >= 2) teeth.push_back(f);
            }
            for (const std::uint32_t f : teeth) kept_[f] = 0;
        }
    }

    std::size_t remove_islands() {
        std::vector<std::uint32_t> piece(kept_.size(), none);
        std::vector<double> areas;
        for (std::uint32_t f = 0; f < kept_.size(); ++f) {
            if (kept_[f] != 0 && piece[f] == none)
                areas.push_back(flood(f, static_cast<std::uint32_t>(areas.size()), piece));
        }
        const double bound = least_island * std::accumulate(areas.begin(), areas.end(), 0.0);
        for (std::uint32_t f = 0; f < kept_.size(); ++f) {
            if (kept_[f] != 0 && areas[piece[f]] < bound) kept_[f] = 0;
        }
        return static_cast<std::size_t>(
            std::count_if(areas.begin(), areas.end(), [&](double area) { return area < bound; }));
    }

    /// If the faces round a vertex form several fans, removes all but the largest. Returns whether
    /// any face was removed.
    bool remove_fans() {
        std::vector<std::pair<std::uint32_t, std::uint32_t>> corners;  // vertex, face
        for (std::uint32_t f = 0; f < kept_.size(); ++f) {
            if (kept_[f] == 0) continue;
            for (const std::uint32_t v : mesh_.faces[f]) corners.emplace_back(v, f);
        }
        std::sort(corners.begin(), corners.end());
        std::vector<std::uint32_t> gone;
        for (std::size_t begin = 0, end = 0; begin < corners.size(); begin = end) {
            for (end = begin; end < corners.size() && corners[end].first == corners[begin].first;)
                ++end;
            smaller_fans(corners, begin, end, gone);
        }
        for (const std::uint32_t f : gone) kept_[f] = 0;
        return !gone.empty();
    }

private:
    int border_edges(std::uint32_t f) const {
        return static_cast<int>(
            std::count_if(across_[f].begin(), across_[f].end(),
                          [&](std::uint32_t g) { return g == none || kept_[g] == 0; }));
    }

    double area(std::uint32_t f) const {
        const auto& face = mesh_.faces[f];
        return geometry::triangle_area(mesh_.points[face[0]], mesh_.points[face[1]],
                                       mesh_.points[face[2]]);
    }

    double flood(std::uint32_t start, std::uint32_t number,
                 std::vector<std::uint32_t>& piece) const {
        std::vector<std::uint32_t> front = {start};
        piece[start] = number;
        double sum = 0.0;
        while (!front.empty()) {
            const std::uint32_t f = front.back();
            front.pop_back();
            sum += area(f);
            for (const std::uint32_t g : across_[f]) {
                if (g == none || kept_[g] == 0 || piece[g] != none) continue;
                piece[g] = number;
                front.push_back(g);
            }
        }
        return sum;
    }

    void smaller_fans(const std::vector<std::pair<std::uint32_t, std::uint32_t>>& corners,
                      std::size_t begin, std::size_t end, std::vector<std::uint32_t>& gone) const {
        std::vector<std::vector<std::uint32_t>> fans;
        std::vector<std::uint32_t> left;
        for (std::size_t i = begin; i < end; ++i) left.push_back(corners[i].second);
        while (!left.empty()) {
            std::vector<std::uint32_t>& fan = fans.emplace_back(1, left.back());
            left.pop_back();
            for (std::size_t i = 0; i < fan.size(); ++i) {
                for (const std::uint32_t g : across_[fan[i]]) {
                    const auto found = std::find(left.begin(), left.end(), g);
                    if (found == left.end()) continue;
                    fan.push_back(g);
                    left.erase(found);
                }
            }
        }
        if (fans.size() < 2) return;
        std::stable_sort(fans.begin(), fans.end(),
                         [](const auto& l, const auto& r) { return l.size() > r.size(); });
        for (std::size_t n = 1; n < fans.size(); ++n)
            gone.insert(gone.end(), fans[n].begin(), fans[n].end());
    }

    const TriangleMesh& mesh_;
    std::vector<std::array<std::uint32_t, 3>> across_;
    std::vector<std::uint8_t> kept_;
};

TriangleMesh picked(const TriangleMesh& mesh, const std::vector<std::uint8_t>& kept,
                    std::vector<std::uint32_t>* points_of) {
    std::vector<std::uint32_t> number(mesh.points.size(), none);
    std::vector<std::uint8_t> used(mesh.points.size(), 0);
    for (std::size_t f = 0; f < kept.size(); ++f) {
        if (kept[f] == 0) continue;
        for (const std::uint32_t v : mesh.faces[f]) used[v] = 1;
    }
    TriangleMesh out;
    if (points_of != nullptr) points_of->clear();
    for (std::uint32_t v = 0; v < mesh.points.size(); ++v) {
        if (used[v] == 0) continue;
        number[v] = static_cast<std::uint32_t>(out.points.size());
        out.points.push_back(mesh.points[v]);
        if (!mesh.colours.empty()) out.colours.push_back(mesh.colours[v]);
        if (points_of != nullptr) points_of->push_back(v);
    }
    for (std::size_t f = 0; f < kept.size(); ++f) {
        const auto& face = mesh.faces[f];
        if (kept[f] != 0) out.faces.push_back({number[face[0]], number[face[1]], number[face[2]]});
    }
    return out;
}

}  // namespace

TriangleMesh trim(const TriangleMesh& mesh, std::span<const double> gaps,
                  std::span<const double> support, const TrimOptions& options,
                  std::vector<std::uint32_t>* points_of, TrimReport* report) {
    if (gaps.size() != mesh.points.size() ||
        (!support.empty() && support.size() != mesh.points.size())) {
        throw GeometryError("trim.values", "trim",
                            fmt::format("there are {} gaps and {} supports for {} points",
                                        gaps.size(), support.size(), mesh.points.size()),
                            "provide one per point");
    }
    const auto any = [](const std::array<std::uint32_t, 3>& face, auto&& holds) {
        return holds(face[0]) || holds(face[1]) || holds(face[2]);
    };
    Trimmer trimmer(mesh);
    trimmer.remove([&](const auto& face) {
        return any(face, [&](std::uint32_t v) {
            return !(gaps[v] <= options.distance) ||
                   (!support.empty() && support[v] < options.support);
        });
    });
    trimmer.spread([&](const auto& face) {
        return any(face, [&](std::uint32_t v) { return gaps[v] > border_part * options.distance; });
    });
    // The result is final when no faces touch others only in a vertex.
    std::size_t islands = trimmer.remove_islands();
    trimmer.remove_teeth();
    while (trimmer.remove_fans()) {
    }
    islands += trimmer.remove_islands();
    TriangleMesh out = picked(mesh, trimmer.kept(), points_of);
    if (report != nullptr) {
        const double all = area(mesh);
        *report = {mesh.faces.size() - out.faces.size(), all > 0.0 ? 1.0 - area(out) / all : 0.0,
                   islands};
    }
    return out;
}

}  // namespace dsc::surface
