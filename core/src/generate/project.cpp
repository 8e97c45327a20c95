// Moves a stair-stepped interface onto a smooth surface: pushing, approaching, sliding, relaxing.
#include "dsc/generate/project.hpp"

#include <algorithm>
#include <iterator>

#include <dsc/geometry/quality.hpp>
#include <dsc/mesh/adopt.hpp>
#include <dsc/mesh/local_star.hpp>
#include <dsc/mesh/star_quality.hpp>

namespace dsc::generate {
namespace {

/// A vertex closer to the surface than this, in mean edges of the lattice, has arrived.
constexpr double arrived = 1e-12;
/// A move that gains less quality than this is not made.
constexpr double least_gain = 1e-3;
constexpr int halvings = 5;
/// Distance, in mean edges, by which a vertex tries to move away from the opposite face of a bad
/// tet.
constexpr double escape_step = 0.2;
/// A push adds no vertex to the interface that is farther from the surface than this, in mean
/// edges.
constexpr double farthest_pushed = 0.9;

class Projection {
public:
    Projection(mesh::Complex& complex, const std::function<Vec3(const Vec3&)>& nearest,
               const ProjectOptions& options)
        : complex_(complex),
          nearest_(nearest),
          options_(options),
          local_(complex),
          floor_(options.quality) {
        fixed_.resize(complex.vertex_slots(), false);
        for (const mesh::VertexId v : options.fixed) fixed_[v] = true;
    }

    ProjectReport run() {
        collect();
        scale_ = mean_star_edge();
        while (push_vertices()) collect();
        for (unsigned round = 0; round < options_.rounds; ++round) {
            const bool nearer = approach();
            const bool slid = slide();
            const bool relaxed = relax();
            if (nearer) continue;
            if (off_surface() == 0 && !slid && !relaxed) break;
            stuck_ = floor_ == options_.least_quality;
            floor_ = std::max(0.5 * floor_, options_.least_quality);
        }
        report_.vertices = interface_.size();
        report_.off_surface = off_surface();
        report_.min_quality = complex_.least_quality();
        return report_;
    }

private:
    /// The interface vertices that may move and the free ones within two edges of them, both in
    /// birth order.
    void collect() {
        interface_.clear();
        for (const mesh::VertexId v : complex_.interface_vertices()) {
            if (complex_.movable(v) && !fixed_[v]) interface_.push_back(v);
        }
        sort_by_birth(interface_);
        free_.clear();
        std::vector<bool> seen(complex_.vertex_slots(), false);
        std::vector<mesh::VertexId> ring = interface_;
        for (int edges = 0; edges < 2; ++edges) ring = free_neighbours(ring, seen);
        sort_by_birth(free_);
    }

    std::vector<mesh::VertexId> free_neighbours(const std::vector<mesh::VertexId>& of,
                                                std::vector<bool>& seen) {
        std::vector<mesh::VertexId> found;
        for (const mesh::VertexId v : of) {
            complex_.star(v, star_);
            for (const mesh::TetId t : star_) {
                for (const mesh::VertexId w : complex_.tet(t).v) {
                    if (seen[w] || fixed_[w] || complex_.on_box(w) || complex_.on_interface(w))
                        continue;
                    seen[w] = true;
                    found.push_back(w);
                    free_.push_back(w);
                }
            }
        }
        return found;
    }

    void sort_by_birth(std::vector<mesh::VertexId>& vertices) const {
        std::sort(vertices.begin(), vertices.end(), [this](mesh::VertexId a, mesh::VertexId b) {
            return complex_.birth(a) < complex_.birth(b);
        });
    }

    /// Mean length of the edges of all tets at the interface vertices that may move; an edge counts
    /// once per tet.
    double mean_star_edge() {
        double sum = 0.0;
        std::size_t count = 0;
        for (const mesh::VertexId v : interface_) {
            complex_.star(v, star_);
            for (const mesh::TetId t : star_) {
                for (const auto& [i, j] : mesh::edge_vertices) {
                    sum += (complex_.position(complex_.tet(t).v[i]) -
                            complex_.position(complex_.tet(t).v[j]))
                               .norm();
                    ++count;
                }
            }
        }
        return count == 0 ? 0.0 : sum / static_cast<double>(count);
    }

    bool on_surface(mesh::VertexId v) const {
        const Vec3& p = complex_.position(v);
        return (nearest_(p) - p).norm() <= arrived * scale_;
    }
    std::size_t off_surface() const {
        return static_cast<std::size_t>(
            std::count_if(interface_.begin(), interface_.end(),
                          [this](mesh::VertexId v) { return !on_surface(v); }));
    }

    /// Least quality of the star of v (stored in star_), with v at `position`.
    double quality_at(mesh::VertexId v, const Vec3& position) const {
        return mesh::star_quality(complex_, star_, v, position);
    }

    /// Moves interface vertices towards the surface as far as no tet becomes worse than the floor
    /// or than before.
    bool approach() {
        bool any = false;
        for (const mesh::VertexId v : interface_) {
            const Vec3 from = complex_.position(v);
            const Vec3 way = nearest_(from) - from;
            if (way.norm() <= arrived * scale_) continue;
            complex_.star(v, star_);
            const double bound = std::min(floor_, quality_at(v, from));
            double part = 1.0;
            for (int i = 0; i <= halvings; ++i, part *= 0.5) {
                const Vec3 to = from + part * way;
                if (quality_at(v, to) < bound) continue;
                complex_.move(v, to, star_);
                any = any || (to - from).norm() > 1e-3 * scale_ || i == 0;
                break;
            }
        }
        return any;
    }

    /// Moves v to `to`, or part of the distance, if that raises the least quality of its star
    /// (stored in star_).
    bool improve(mesh::VertexId v, const Vec3& to, bool along_surface) {
        const Vec3 from = complex_.position(v);
        const double before = quality_at(v, from);
        double part = 1.0;
        for (int i = 0; i < 3; ++i, part *= 0.5) {
            const Vec3 straight = from + part * (to - from);
            const Vec3 there = along_surface ? nearest_(straight) : straight;
            if (quality_at(v, there) <= before + least_gain) continue;
            complex_.move(v, there, star_);
            return true;
        }
        return false;
    }

    /// Moves vertices on the surface towards the mean of their interface neighbours, along the
    /// surface.
    bool slide() {
        bool any = false;
        for (const mesh::VertexId v : interface_) {
            if (!on_surface(v)) continue;
            complex_.star(v, star_);
            any =
                improve(v, mean_of_neighbours(v, true), true) || (stuck_ && escape(v, true)) || any;
        }
        return any;
    }

    /// Moves free vertices towards the mean of their neighbours.
    bool relax() {
        bool any = false;
        for (const mesh::VertexId v : free_) {
            complex_.star(v, star_);
            any = improve(v, mean_of_neighbours(v, false), false) || escape(v, false) || any;
        }
        return any;
    }

    /// Moves v away from a bad tet. Surface vertices are moved only if nothing else has helped,
    /// because this makes uneven triangles.
    bool escape(mesh::VertexId v, bool along_surface) {
        const double bad = along_surface ? options_.quality : 2 * options_.quality;
        if (quality_at(v, complex_.position(v)) >= bad) return false;
        return improve(v, away_from_worst(v), along_surface);
    }

    /// A place farther away from the opposite face of the worst tet at v.
    Vec3 away_from_worst(mesh::VertexId v) const {
        const mesh::TetId worst =
            *std::min_element(star_.begin(), star_.end(), [this](mesh::TetId a, mesh::TetId b) {
                return complex_.quality(a) < complex_.quality(b);
            });
        const mesh::Tet& tet = complex_.tet(worst);
        const auto& face = mesh::face_vertices[mesh::index_of(tet, v)];
        const Vec3 normal = geometry::triangle_normal(complex_.position(tet.v[face[0]]),
                                                      complex_.position(tet.v[face[1]]),
                                                      complex_.position(tet.v[face[2]]));
        return complex_.position(v) - escape_step * scale_ * normal;
    }

    /// Over the star in star_; with `interface_only` over the interface faces at v.
    Vec3 mean_of_neighbours(mesh::VertexId v, bool interface_only) const {
        Vec3 sum = Vec3::Zero();
        std::size_t count = 0;
        for (const mesh::TetId t : star_) {
            const mesh::Tet& tet = complex_.tet(t);
            for (unsigned f = 0; f < 4; ++f) {
                if (tet.v[f] == v || (interface_only && !complex_.interface_face(t, f))) continue;
                for (const std::uint8_t i : mesh::face_vertices[f]) {
                    if (tet.v[i] == v) continue;
                    sum += complex_.position(tet.v[i]);
                    ++count;
                }
            }
        }
        return count == 0 ? complex_.position(v) : Vec3(sum / static_cast<double>(count));
    }

    /// A tet with four interface vertices has no vertex that could move away: with all of them on
    /// the surface it is nearly flat. Pushes one of its vertices off the interface, to either side,
    /// if that leaves fewer such tets.
    bool push_vertices() {
        bool any = false;
        for (const mesh::VertexId v : interface_) {
            if (!complex_.on_interface(v)) continue;
            complex_.star(v, star_);
            if (std::none_of(star_.begin(), star_.end(),
                             [this](mesh::TetId t) { return trapped(t); }))
                continue;
            any = push(v) || any;
        }
        return any;
    }

    bool trapped(mesh::TetId t) const {
        std::array<Vec3, 4> p;
        for (unsigned i = 0; i < 4; ++i) {
            const mesh::VertexId v = complex_.tet(t).v[i];
            if (!complex_.movable(v)) return false;
            p[i] = nearest_(complex_.position(v));
        }
        return geometry::tet_quality(p[0], p[1], p[2], p[3]) < options_.quality;
    }

    /// All tets of one label at v take the other label.
    bool push(mesh::VertexId v) {
        std::vector<mesh::TetId> star;
        complex_.star(v, star);
        std::array<mesh::Label, 2> labels = {complex_.label(star[0]), complex_.label(star[0])};
        for (const mesh::TetId t : star) {
            if (complex_.label(t) != labels[0]) labels[1] = complex_.label(t);
        }
        for (const mesh::Label from : labels) {
            std::vector<mesh::TetId> region;
            std::copy_if(star.begin(), star.end(), std::back_inserter(region),
                         [&](mesh::TetId t) { return complex_.label(t) == from; });
            const mesh::Label to = from == labels[0] ? labels[1] : labels[0];
            if (push_region(region, from, to)) return true;
        }
        return false;
    }

    bool push_region(std::span<const mesh::TetId> region, mesh::Label from, mesh::Label to) {
        std::vector<mesh::VertexId> touched;
        for (const mesh::TetId t : region) {
            for (const mesh::VertexId v : complex_.tet(t).v) {
                if (complex_.on_box(v) || complex_.phases(v) > 2) return false;
                if (std::find(touched.begin(), touched.end(), v) == touched.end())
                    touched.push_back(v);
            }
        }
        if (!stays_regular(touched, region, to)) return false;
        const std::size_t before = trapped_round(touched);
        complex_.relabel(region, to);
        const bool near = std::all_of(touched.begin(), touched.end(), [this](mesh::VertexId v) {
            return !complex_.on_interface(v) ||
                   (nearest_(complex_.position(v)) - complex_.position(v)).norm() <
                       farthest_pushed * scale_;
        });
        if (near && trapped_round(touched) < before) {
            report_.relabelled += region.size();
            return true;
        }
        complex_.relabel(region, from);
        return false;
    }

    std::size_t trapped_round(std::span<const mesh::VertexId> vertices) {
        std::vector<mesh::TetId> tets;
        for (const mesh::VertexId v : vertices) {
            complex_.star(v, star_);
            tets.insert(tets.end(), star_.begin(), star_.end());
        }
        std::sort(tets.begin(), tets.end());
        tets.erase(std::unique(tets.begin(), tets.end()), tets.end());
        return static_cast<std::size_t>(
            std::count_if(tets.begin(), tets.end(), [this](mesh::TetId t) { return trapped(t); }));
    }

    bool stays_regular(std::span<const mesh::VertexId> touched, std::span<const mesh::TetId> region,
                       mesh::Label label) {
        int euler = 0;
        for (const mesh::VertexId v : touched) {
            local_.build(v);
            euler -= local_.euler_share();
            local_.build(v, region, label);
            euler += local_.euler_share();
            if (!local_.regular()) return false;
        }
        return euler == 0;
    }

    mesh::Complex& complex_;
    const std::function<Vec3(const Vec3&)>& nearest_;
    ProjectOptions options_;
    mesh::LocalStar local_;
    double floor_;  // lowered if vertices cannot move
    double scale_ = 0.0;
    bool stuck_ = false;  // nothing has moved although the floor is as low as possible
    ProjectReport report_;
    std::vector<bool> fixed_;
    std::vector<mesh::VertexId> interface_;
    std::vector<mesh::VertexId> free_;
    std::vector<mesh::VertexId> pushed_;
    std::vector<mesh::TetId> star_;
};

}  // namespace

ProjectReport project_interface(mesh::Complex& complex,
                                const std::function<Vec3(const Vec3&)>& nearest,
                                const ProjectOptions& options) {
    return Projection(complex, nearest, options).run();
}

mesh::TetMesh make_projected(const std::function<mesh::TetMesh(std::span<const Shape>)>& make,
                             std::span<const Shape> shapes, double cell, std::string_view name) {
    // A tet belongs to a shape if no vertex lies farther outside than this fraction of a cell. So
    // no tet outside has four vertices on the interface, and on average the interface moves inwards
    // as much as outwards.
    constexpr double reach = 0.4;
    std::vector<Shape> reached;
    for (const Shape& shape : shapes) {
        reached.push_back(grown(shape, reach * cell));
        reached.back().rule = ShapeRule::vertices;
    }
    mesh::Complex complex = mesh::adopt(make(reached), name, nullptr, 0.0);
    project_interface(complex, [&](const Vec3& p) { return nearest_on_surface(shapes, p); });
    return complex.to_mesh();
}

}  // namespace dsc::generate
