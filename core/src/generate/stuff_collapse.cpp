// Collapses edges of a new interface and thins the free vertices near it.
#include "generate/stuff_collapse.hpp"

#include <algorithm>
#include <tuple>

#include <dsc/base/error.hpp>
#include <dsc/geometry/quality.hpp>

namespace dsc::generate::stuffing {
namespace {

// A free vertex near the interface is removed if its shortest edge is below this fraction of the
// interface's edges there and all changed tets keep a minimum quality. Its edges may grow from
// layer to layer.
constexpr double dense = 0.9;
constexpr double growth = 1.3;
constexpr double thin_quality = 0.25;
// Layers of free vertices that are thinned between the passes over the interface, so that they do
// not block it, and at the end.
constexpr unsigned layers_between = 1, layers_at_end = 3;
// The first passes collapse only edges of the interface that leave tets of at least this quality;
// later passes accept less.
constexpr double first_quality = 0.3;
constexpr double relaxation = 0.6;

template <std::size_t N>
bool has(const std::array<std::uint32_t, N>& cell, std::uint32_t v) {
    return std::find(cell.begin(), cell.end(), v) != cell.end();
}

// The cells (tets or faces) of each vertex, kept up to date while vertices are merged. A removed
// cell has no_vertex as its first entry.
template <std::size_t N>
class Incidence {
public:
    using Cell = std::array<std::uint32_t, N>;

    Incidence(std::size_t points, std::vector<Cell>& cells)
        : cells_(cells), begin_(points + 2, 0), count_(points, 0) {
        for (const Cell& cell : cells) {
            for (const std::uint32_t v : cell) ++begin_[v + 2];
        }
        for (std::size_t i = 2; i < begin_.size(); ++i) begin_[i] += begin_[i - 1];
        pool_.resize(begin_.back());
        for (std::uint32_t i = 0; i < cells.size(); ++i) {
            for (const std::uint32_t v : cells[i]) pool_[begin_[v + 1]++] = i;
        }
        for (std::size_t v = 0; v < points; ++v) count_[v] = begin_[v + 1] - begin_[v];
    }

    /// Calls visit(index, cell) for the cells of v.
    template <class Visit>
    void each(std::uint32_t v, const Visit& visit) {
        std::uint32_t kept = begin_[v];
        for (std::uint32_t i = begin_[v]; i < begin_[v] + count_[v]; ++i) {
            const std::uint32_t cell = pool_[i];
            if (cells_[cell][0] == no_vertex) continue;
            pool_[kept++] = cell;
            visit(cell, cells_[cell]);
        }
        count_[v] = kept - begin_[v];
    }
    bool empty(std::uint32_t v) const { return count_[v] == 0; }

    /// The cells of `removed` become cells of `kept`; cells of both are removed.
    void merge(std::uint32_t kept, std::uint32_t removed) {
        merged_.clear();
        each(removed, [&](std::uint32_t i, const Cell& cell) {
            if (has(cell, kept)) {
                cells_[i][0] = no_vertex;
            } else {
                std::replace(cells_[i].begin(), cells_[i].end(), removed, kept);
                merged_.push_back(i);
            }
        });
        each(kept, [&](std::uint32_t i, const Cell&) { merged_.push_back(i); });
        count_[removed] = 0;
        begin_[kept] = static_cast<std::uint32_t>(pool_.size());
        count_[kept] = static_cast<std::uint32_t>(merged_.size());
        pool_.insert(pool_.end(), merged_.begin(), merged_.end());
    }

private:
    std::vector<Cell>& cells_;
    std::vector<std::uint32_t> begin_, count_, pool_, merged_;
};

struct Edge {
    double length;
    std::uint32_t a, b;
};

// Every collapse merges two vertices into one at a place where all remaining tets of the two are
// positive. Then the tets still fill the box exactly once: the map from the old mesh to the new one
// that contracts the edge keeps the border of the box, so it covers each place once, and tets that
// shared an edge or a face which they did not share before would overlap. On the interface the link
// condition of a surface [Dey1999] is also required. So the interface remains a surface of the same
// topology, and all its vertices are regular. It still separates the labels, because no tet changes
// its label.
class Collapser {
public:
    Collapser(Stuffed& stuffed, const StuffOptions& options, StuffReport& report,
              const CancelToken* cancel)
        : s_(stuffed),
          options_(options),
          report_(report),
          cancel_(cancel),
          box_(bounding_box(stuffed.mesh.points)),
          tets_(stuffed.mesh.points.size(), stuffed.mesh.tets),
          faces_(stuffed.mesh.points.size(), stuffed.faces),
          touched_(stuffed.mesh.points.size(), 0) {
        for (std::uint32_t v = 0; v < touched_.size(); ++v) vertices_ += faces_.empty(v) ? 0 : 1;
    }

    void run() {
        double quality = std::max(first_quality, options_.collapse_quality);
        while (vertices_ > options_.most_interface_vertices) {
            // Long edges are tried only if no short edge can be collapsed: the next pass may limit
            // the list differently.
            const std::vector<Edge> edges = sorted_edges();
            std::size_t done = pass(edges, edges.size() / 2, quality);
            if (done == 0) done = pass(edges, edges.size(), quality);
            if (done == 0 && quality <= options_.collapse_quality) break;
            quality = std::max(options_.collapse_quality, relaxation * quality);
            if (vertices_ > options_.most_interface_vertices) thin_free_vertices(layers_between);
        }
        thin_free_vertices(layers_at_end);
    }

private:
    const Vec3& at(std::uint32_t v) const { return s_.mesh.points[v]; }

    std::vector<Edge> sorted_edges() {
        std::vector<Edge> edges;
        edges.reserve(3 * vertices_);
        for (std::uint32_t a = 0; a < touched_.size(); ++a) {
            if (faces_.empty(a)) continue;
            neighbours(a, near_a_);
            for (const std::uint32_t b : near_a_) {
                if (b > a) edges.push_back({(at(a) - at(b)).norm(), a, b});
            }
        }
        const auto key = [](const Edge& e) { return std::make_tuple(e.length, e.a, e.b); };
        std::sort(edges.begin(), edges.end(),
                  [&](const Edge& x, const Edge& y) { return key(x) < key(y); });
        return edges;
    }

    // Tries the first `count` edges, except those of merged vertices, whose lengths have changed.
    // Returns the number of collapses.
    std::size_t pass(const std::vector<Edge>& edges, std::size_t count, double quality) {
        std::fill(touched_.begin(), touched_.end(), 0);
        std::size_t done = 0;
        for (std::size_t i = 0; i < count && vertices_ > options_.most_interface_vertices; ++i) {
            if (i % 1024 == 0) check_cancelled();
            const auto [length, a, b] = edges[i];
            if (touched_[a] != 0 || touched_[b] != 0 || !link_condition(a, b)) continue;
            const std::array<Vec3, 3> places = {0.5 * (at(a) + at(b)), at(a), at(b)};
            std::size_t best = 3;
            double best_quality = quality;
            for (std::size_t k = 0; k < 3; ++k) {
                const double least = std::min(least_quality(a, b, places[k], best_quality),
                                              least_quality(b, a, places[k], best_quality));
                if (least > best_quality) {
                    best_quality = least;
                    best = k;
                }
            }
            if (best == 3) continue;
            touched_[a] = touched_[b] = 1;
            tets_.merge(a, b);
            faces_.merge(a, b);
            s_.mesh.points[a] = places[best];
            --vertices_;
            ++report_.collapsed_edges;
            ++done;
        }
        return done;
    }

    // Least quality of the tets of v without `other` if v were at `place`; ends early below the
    // bound.
    double least_quality(std::uint32_t v, std::uint32_t other, const Vec3& place, double bound) {
        double least = 2.0;
        tets_.each(v, [&](std::uint32_t, const Corners& tet) {
            if (least <= bound || has(tet, other)) return;
            std::array<const Vec3*, 4> p{};
            for (std::size_t i = 0; i < 4; ++i) p[i] = tet[i] == v ? &place : &at(tet[i]);
            least = std::min(least, geometry::tet_quality(*p[0], *p[1], *p[2], *p[3]));
        });
        return least;
    }

    // Whether a and b have exactly the two vertices opposite the edge as common neighbours on the
    // interface, and at least three neighbours are left.
    bool link_condition(std::uint32_t a, std::uint32_t b) {
        neighbours(a, near_a_);
        neighbours(b, near_b_);
        if (near_a_.size() + near_b_.size() < 7) return false;
        std::size_t common = 0;
        auto y = near_b_.begin();
        for (const std::uint32_t x : near_a_) {
            while (y != near_b_.end() && *y < x) ++y;
            common += y != near_b_.end() && *y == x ? 1 : 0;
        }
        return common == 2;
    }

    void neighbours(std::uint32_t v, std::vector<std::uint32_t>& out) {
        out.clear();
        faces_.each(v, [&](std::uint32_t, const Face& face) {
            for (const std::uint32_t w : face) {
                if (w != v) out.push_back(w);
            }
        });
        std::sort(out.begin(), out.end());
        out.erase(std::unique(out.begin(), out.end()), out.end());
    }

    // Merges free vertices near the interface into neighbours if they are denser than the
    // interface.
    void thin_free_vertices(unsigned layers) {
        const std::vector<double> wanted = wanted_lengths(layers);
        for (std::uint32_t v = 0; v < wanted.size(); ++v) {
            if (wanted[v] == 0.0 || !faces_.empty(v) || tets_.empty(v) || lies_on(box_, at(v)))
                continue;
            if (v % 1024 == 0) check_cancelled();
            merge_free_vertex(v, wanted[v]);
        }
    }

    // Least length of the edges of vertices on the interface and in some layers around it; 0 for
    // other vertices.
    std::vector<double> wanted_lengths(unsigned layers) const {
        std::vector<double> wanted(s_.mesh.points.size(), 0.0);
        for (const Face& f : s_.faces) {
            if (f[0] == no_vertex) continue;
            double mean = 0.0;
            for (std::size_t i = 0; i < 3; ++i) mean += (at(f[i]) - at(f[(i + 1) % 3])).norm() / 3;
            for (const std::uint32_t v : f) wanted[v] = std::max(wanted[v], dense * mean);
        }
        for (unsigned layer = 0; layer < layers; ++layer) {
            const std::vector<double> inner = wanted;
            const double factor = layer == 0 ? 1.0 : growth;
            for (const Corners& tet : s_.mesh.tets) {
                if (tet[0] == no_vertex) continue;
                double most = 0.0;
                for (const std::uint32_t v : tet) most = std::max(most, factor * inner[v]);
                if (most == 0.0) continue;
                for (const std::uint32_t v : tet) {
                    if (inner[v] == 0.0) wanted[v] = std::max(wanted[v], most);
                }
            }
        }
        return wanted;
    }

    void merge_free_vertex(std::uint32_t v, double length) {
        std::uint32_t nearest = no_vertex;
        double least = length * length;
        tets_.each(v, [&](std::uint32_t, const Corners& tet) {
            for (const std::uint32_t w : tet) {
                const double square = (at(w) - at(v)).squaredNorm();
                if (w == v || square > least || (square == least && w >= nearest)) continue;
                least = square;
                nearest = w;
            }
        });
        if (nearest == no_vertex) return;
        // A tet of four interface vertices becomes flat when the interface is smoothed.
        bool flat = false;
        tets_.each(v, [&](std::uint32_t, const Corners& tet) {
            if (has(tet, nearest) || faces_.empty(nearest)) return;
            flat = flat || std::count_if(tet.begin(), tet.end(),
                                         [&](std::uint32_t w) { return !faces_.empty(w); }) == 3;
        });
        if (flat || least_quality(v, nearest, at(nearest), thin_quality) <= thin_quality) return;
        tets_.merge(nearest, v);
        ++report_.removed_free_vertices;
    }

    void check_cancelled() const {
        if (cancel_ != nullptr && cancel_->cancelled())
            throw CancelledError("the run was stopped while it made its initial mesh");
    }

    Stuffed& s_;
    const StuffOptions& options_;
    StuffReport& report_;
    const CancelToken* cancel_;
    Box3 box_;
    Incidence<4> tets_;
    Incidence<3> faces_;
    std::vector<char> touched_;
    std::vector<std::uint32_t> near_a_, near_b_;
    std::size_t vertices_ = 0;
};

// Removes dead cells and unused points.
void compact(Stuffed& s) {
    mesh::TetMesh& mesh = s.mesh;
    std::vector<std::uint32_t> index(mesh.points.size(), no_vertex);
    std::size_t tets = 0;
    for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
        if (mesh.tets[t][0] == no_vertex) continue;
        for (const std::uint32_t v : mesh.tets[t]) index[v] = 0;
        mesh.tets[tets] = mesh.tets[t];
        mesh.labels[tets++] = mesh.labels[t];
    }
    mesh.tets.resize(tets);
    mesh.labels.resize(tets);
    std::uint32_t points = 0;
    for (std::size_t v = 0; v < index.size(); ++v) {
        if (index[v] == no_vertex) continue;
        index[v] = points;
        mesh.points[points++] = mesh.points[v];
    }
    mesh.points.resize(points);
    s.faces.erase(std::remove_if(s.faces.begin(), s.faces.end(),
                                 [](const Face& f) { return f[0] == no_vertex; }),
                  s.faces.end());
    for (Corners& tet : mesh.tets) {
        for (std::uint32_t& v : tet) v = index[v];
    }
    for (Face& face : s.faces) {
        for (std::uint32_t& v : face) v = index[v];
    }
}

}  // namespace

void collapse_interface(Stuffed& stuffed, const StuffOptions& options, StuffReport& report,
                        const CancelToken* cancel) {
    Collapser(stuffed, options, report, cancel).run();
    compact(stuffed);
}

}  // namespace dsc::generate::stuffing
