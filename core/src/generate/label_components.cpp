// Finds islands and cavities of labelled vertices and removes those that must not stay.
#include "dsc/generate/label_components.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <dsc/base/union_find.hpp>

namespace dsc::generate {
namespace {

using Corners = std::array<std::uint32_t, 4>;
constexpr double changed_value = 1e-3;

struct Region {
    LabelComponent component;
    std::uint32_t vertex = 0;  // the lowest one
    bool on_box = false;

    bool cavity() const { return !component.inside && !on_box; }
};

// All components of both labels.
struct Regions {
    std::vector<Region> list;       // by their lowest vertices
    std::vector<std::uint32_t> of;  // region of each vertex
};

Regions regions_of(std::span<const Vec3> points, std::span<const Corners> tets,
                   std::span<const double> values, std::span<const double> volumes) {
    UnionFind sets(points.size());
    std::vector<std::uint8_t> in(points.size());
    for (std::size_t v = 0; v < points.size(); ++v) in[v] = values[v] > 0 ? 1 : 0;
    for (const Corners& tet : tets) {
        for (std::size_t i = 0; i < 4; ++i) {
            for (std::size_t j = i + 1; j < 4; ++j) {
                if (in[tet[i]] == in[tet[j]]) sets.join(tet[i], tet[j]);
            }
        }
    }
    Regions out;
    out.of.resize(points.size());
    const Box3 box = bounding_box(points);
    for (std::uint32_t v = 0; v < points.size(); ++v) {
        // Roots are the lowest vertices, so their regions exist before they are needed.
        const std::uint32_t root = sets.find(v);
        if (root == v) {
            out.of[v] = static_cast<std::uint32_t>(out.list.size());
            Region region;
            region.component.inside = in[v] != 0;
            region.component.place = Vec3::Zero();
            region.vertex = v;
            out.list.push_back(region);
        }
        out.of[v] = out.of[root];
        Region& region = out.list[out.of[v]];
        region.component.volume += volumes[v];
        region.component.place += points[v];
        region.component.peak = std::max(region.component.peak, std::abs(values[v]));
        ++region.component.vertices;
        region.on_box = region.on_box || (points[v].array() == box.low.array()).any() ||
                        (points[v].array() == box.high.array()).any();
    }
    for (Region& region : out.list)
        region.component.place /= static_cast<double>(region.component.vertices);
    return out;
}

void change(const Regions& regions, const std::vector<std::uint8_t>& chosen,
            std::span<double> values) {
    for (std::size_t v = 0; v < values.size(); ++v) {
        if (chosen[regions.of[v]] != 0) values[v] = values[v] > 0 ? -changed_value : changed_value;
    }
}

// Finds the region that the shell between two regions encloses. In a box, regions that touch form a
// tree with the outermost region as its root, so the enclosed region is the one farther from the
// root.
class Shells {
public:
    Shells(const Regions& regions, std::span<const Corners> tets)
        : depth_(regions.list.size(), unreached) {
        std::vector<std::pair<std::uint32_t, std::uint32_t>> touching;
        for (const Corners& tet : tets) {
            for (std::size_t i = 1; i < 4; ++i) {
                const std::uint32_t a = regions.of[tet[0]], b = regions.of[tet[i]];
                if (a != b) touching.emplace_back(std::min(a, b), std::max(a, b));
            }
        }
        std::sort(touching.begin(), touching.end());
        touching.erase(std::unique(touching.begin(), touching.end()), touching.end());
        for (std::size_t r = 0; r < regions.list.size(); ++r) {
            if (regions.list[r].on_box) depth_[r] = 0;
        }
        for (bool again = true; again;) {
            again = false;
            for (const auto& [a, b] : touching) {
                for (const auto& [from, to] : {std::pair{a, b}, std::pair{b, a}}) {
                    if (depth_[from] == unreached || depth_[to] <= depth_[from] + 1) continue;
                    depth_[to] = depth_[from] + 1;
                    again = true;
                }
            }
        }
    }
    std::uint32_t enclosed(std::uint32_t a, std::uint32_t b) const {
        return depth_[a] > depth_[b] ? a : b;
    }

private:
    static constexpr std::uint32_t unreached = std::numeric_limits<std::uint32_t>::max() - 1;
    std::vector<std::uint32_t> depth_;
};

// The tets around chosen vertices.
class Rounds {
public:
    Rounds(std::size_t vertices, std::span<const Corners> tets,
           std::span<const std::uint32_t> chosen)
        : begin_(vertices + 1, 0) {
        std::vector<std::uint8_t> wanted(vertices, 0);
        for (const std::uint32_t v : chosen) wanted[v] = 1;
        for (const Corners& tet : tets) {
            for (const std::uint32_t v : tet) begin_[v + 1] += wanted[v];
        }
        for (std::size_t v = 0; v < vertices; ++v) begin_[v + 1] += begin_[v];
        round_.resize(begin_.back());
        std::vector<std::uint32_t> next(begin_.begin(), begin_.end() - 1);
        for (std::uint32_t t = 0; t < tets.size(); ++t) {
            for (const std::uint32_t v : tets[t]) {
                if (wanted[v] != 0) round_[next[v]++] = t;
            }
        }
    }
    std::span<const std::uint32_t> at(std::uint32_t v) const {
        return std::span(round_).subspan(begin_[v], begin_[v + 1] - begin_[v]);
    }

private:
    std::vector<std::uint32_t> begin_, round_;
};

// Points of the cloud nearest to the shell round each region.
std::vector<std::size_t> points_at_shells(std::span<const Vec3> points,
                                          std::span<const Corners> tets,
                                          std::span<const double> values, const Regions& regions,
                                          const PlacedPoints& cloud) {
    const Shells shells(regions, tets);
    const Rounds rounds(points.size(), tets, cloud.vertices);
    std::vector<std::size_t> out(regions.list.size(), 0);
    for (std::size_t p = 0; p < cloud.places.size(); ++p) {
        double least = std::numeric_limits<double>::infinity();
        std::uint32_t nearest = 0;
        for (const std::uint32_t t : rounds.at(cloud.vertices[p])) {
            const Corners& tet = tets[t];
            for (std::size_t i = 0; i < 4; ++i) {
                for (std::size_t j = i + 1; j < 4; ++j) {
                    const std::uint32_t a = tet[i], b = tet[j];
                    if (regions.of[a] == regions.of[b]) continue;
                    const double t_cut = values[a] / (values[a] - values[b]);
                    const Vec3 cut = points[a] + t_cut * (points[b] - points[a]);
                    const double distance = (cut - cloud.places[p]).squaredNorm();
                    if (!(distance < least)) continue;
                    least = distance;
                    nearest = shells.enclosed(regions.of[a], regions.of[b]);
                }
            }
        }
        if (least < std::numeric_limits<double>::infinity()) ++out[nearest];
    }
    return out;
}

// The islands that do not stay.
std::vector<std::uint8_t> islands_of(const Regions& regions, double least_volume) {
    std::size_t largest = regions.list.size();
    for (std::size_t r = 0; r < regions.list.size(); ++r) {
        const LabelComponent& c = regions.list[r].component;
        if (c.inside &&
            (largest == regions.list.size() || c.volume > regions.list[largest].component.volume))
            largest = r;
    }
    std::vector<std::uint8_t> out(regions.list.size(), 0);
    for (std::size_t r = 0; r < out.size(); ++r) {
        const LabelComponent& c = regions.list[r].component;
        out[r] = c.inside && r != largest && c.volume < least_volume ? 1 : 0;
    }
    return out;
}

bool any(const std::vector<std::uint8_t>& chosen) {
    return std::find(chosen.begin(), chosen.end(), 1) != chosen.end();
}

}  // namespace

std::vector<LabelComponent> settle_components(
    std::span<const Vec3> points, std::span<const Corners> tets, std::span<double> values,
    std::span<const double> volumes, const PlacedPoints& cloud, const ComponentOptions& options) {
    const double least_volume =
        options.least_volume * options.width * options.width * options.width;
    const Regions found = regions_of(points, tets, values, volumes);
    Regions regions = found;
    if (options.remove_islands) {
        const std::vector<std::uint8_t> islands = islands_of(found, least_volume);
        if (any(islands)) {
            change(found, islands, values);
            regions = regions_of(points, tets, values, volumes);
        }
    }

    // Cavities for which the points must be counted, and cavities that do not stay in any case.
    std::vector<std::uint8_t> filled(regions.list.size(), 0), asked(regions.list.size(), 0);
    for (std::size_t r = 0; r < filled.size(); ++r) {
        const Region& region = regions.list[r];
        if (!region.cavity()) continue;
        const bool automatic = options.cavities == CavityPolicy::automatic;
        const bool stays = options.cavities != CavityPolicy::fill &&
                           region.component.volume >= least_volume &&
                           (!automatic || region.component.peak > options.certain);
        filled[r] = stays ? 0 : 1;
        asked[r] = stays && automatic ? 1 : 0;
    }
    std::vector<std::size_t> nearest(regions.list.size(), 0);
    if (any(asked)) {
        nearest = points_at_shells(points, tets, values, regions, cloud);
        for (std::size_t r = 0; r < filled.size(); ++r) {
            if (asked[r] == 0) continue;
            regions.list[r].component.points = nearest[r];
            filled[r] = nearest[r] < options.least_points ? 1 : 0;
        }
    }
    change(regions, filled, values);

    std::vector<LabelComponent> out;
    for (const Region& region : found.list) {
        if (!region.component.inside && !region.cavity()) continue;
        LabelComponent c = region.component;
        c.kept = (values[region.vertex] > 0) == c.inside;
        const std::uint32_t now = regions.of[region.vertex];
        if (!c.inside && asked[now] != 0) c.points = nearest[now];
        out.push_back(c);
    }
    return out;
}

}  // namespace dsc::generate
