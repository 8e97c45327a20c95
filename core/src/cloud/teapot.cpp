// The teapot: 32 bicubic Bezier patches [Crow1987] from share/data/teapot.bpt.
#include <algorithm>
#include <cmath>
#include <map>
#include <span>
#include <string>

#include <dsc/base/error.hpp>
#include <dsc/base/read_file.hpp>
#include <dsc/cloud/data_file.hpp>
#include <dsc/text/numbers.hpp>
#include <dsc/text/reading.hpp>
#include <dsc/text/words.hpp>

#include "surfaces.hpp"

namespace dsc::cloud {

namespace {

using Patch = std::array<Vec3, 16>;  // row v, column u: 4 * v + u

std::array<double, 4> bernstein(double t) {
    const double s = 1.0 - t;
    return {s * s * s, 3.0 * s * s * t, 3.0 * s * t * t, t * t * t};
}

Vec3 at(const Patch& patch, double u, double v) {
    const auto bu = bernstein(u), bv = bernstein(v);
    Vec3 p = Vec3::Zero();
    for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t j = 0; j < 4; ++j) p += bv[i] * bu[j] * patch[4 * i + j];
    return p;
}

std::vector<Patch> load_patches() {
    const std::filesystem::path path = data_file("teapot.bpt");
    const std::string text = read_file(path);
    text::Lines lines(text);
    std::string_view line;
    const auto numbers = [&](std::size_t count, double* values) {
        const bool any = lines.next(line);
        std::string_view rest = line;
        bool good = any;
        for (std::size_t k = 0; good && k < count; ++k)
            good = text::parse_number(text::next_word(rest), values[k]) == text::Number::ok;
        if (!good)
            throw IoError("io.syntax", path.string(), std::to_string(lines.number()),
                          "the line does not have " + text::counted(count, "number"),
                          "restore the file from the source tree");
    };
    double count = 0.0;
    numbers(1, &count);
    std::vector<Patch> patches(count == 32.0 ? 32 : 0);
    if (patches.empty())
        throw IoError("io.syntax", path.string(), "1", "the teapot has 32 patches",
                      "restore the file from the source tree");
    for (Patch& patch : patches) {
        std::array<double, 2> degrees{};
        numbers(2, degrees.data());
        for (Vec3& p : patch) numbers(3, p.data());
    }
    return patches;
}

/// The patches of which a scan sees only the part outside the body: handle and spout.
bool enters_body(std::size_t patch) { return patch >= 12 && patch < 20; }

/// Body and bottom, which are rotated profiles: every cross-section is the same quarter arc, scaled
/// by the radius at its height. The arc is a cubic Bezier curve with a tangent of 0.56, which is
/// not exactly a circle.
class Body {
public:
    /// `patches`: their first columns define the profile.
    explicit Body(const std::vector<Patch>& patches)
        : upper_(column(patches[4])), lower_(column(patches[8])), bottom_(column(patches[28])) {}

    bool contains(const Vec3& p) const {
        const double r = std::hypot(p.x(), p.y());
        for (const Profile* profile : {&upper_, &lower_, &bottom_}) {
            const double first = (*profile)[0].z(), last = (*profile)[3].z();
            if (p.z() >= std::min(first, last) && p.z() <= std::max(first, last))
                return r < radius(*profile, p.z()) * arc(std::abs(p.x()), std::abs(p.y()));
        }
        return false;
    }

private:
    using Profile = std::array<Vec3, 4>;

    static Profile column(const Patch& patch) { return {patch[0], patch[4], patch[8], patch[12]}; }

    /// The root of an increasing function on [0, 1].
    template <class Function>
    static double root(const Function& f) {
        double low = 0.0, high = 1.0;
        for (int n = 0; n < 60; ++n) {
            const double middle = 0.5 * (low + high);
            (f(middle) < 0.0 ? low : high) = middle;
        }
        return 0.5 * (low + high);
    }

    static Vec3 point(const Profile& profile, double t) {
        const auto b = bernstein(t);
        return b[0] * profile[0] + b[1] * profile[1] + b[2] * profile[2] + b[3] * profile[3];
    }

    static double radius(const Profile& profile, double z) {
        const double sign = profile[3].z() > profile[0].z() ? 1.0 : -1.0;
        return point(profile, root([&](double t) { return sign * (point(profile, t).z() - z); }))
            .x();
    }

    /// Radius of the unit arc in the direction (x, y) of the first quadrant.
    static double arc(double x, double y) {
        static const Profile quarter{Vec3(1, 0, 0), Vec3(1, 0.56, 0), Vec3(0.56, 1, 0),
                                     Vec3(0, 1, 0)};
        const double t = root([&](double s) {
            const Vec3 p = point(quarter, s);
            return p.y() * x - p.x() * y;
        });
        return point(quarter, t).norm();
    }

    Profile upper_, lower_, bottom_;
};

/// The four patches of the handle or of the spout: an open tube that leaves the body in the
/// direction `side` of x and encloses a part of its wall.
class Tube {
public:
    Tube(std::span<const Patch> patches, double side) : side_(side) {
        for (const Patch& patch : patches) {
            const auto corner = [&](std::size_t i, std::size_t j) {
                return at(patch, static_cast<double>(i) / cells, static_cast<double>(j) / cells);
            };
            for (std::size_t j = 0; j < cells; ++j)
                for (std::size_t i = 0; i < cells; ++i) {
                    faces_.push_back({corner(i, j), corner(i + 1, j), corner(i + 1, j + 1)});
                    faces_.push_back({corner(i, j), corner(i + 1, j + 1), corner(i, j + 1)});
                }
        }
        for (const auto& face : faces_)
            for (const Vec3& p : face) box_.extend(p);
    }

    /// `p` lies on the body's wall. The ray along x that leaves the body meets the tube an odd
    /// number of times if p is inside the tube, and an even number of times if it is outside; it
    /// never passes through the open ends of the tube.
    bool encloses(const Vec3& p) const {
        if (!box_.contains(p)) return false;
        return std::count_if(faces_.begin(), faces_.end(),
                             [&](const auto& face) { return meets(p, face); }) %
                   2 ==
               1;
    }

private:
    static constexpr std::size_t cells = 16;  // per side of a patch

    bool meets(const Vec3& p, const std::array<Vec3, 3>& face) const {
        std::array<double, 3> part;  // twice the areas of p's image with the edges of the face's
                                     // image
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3 a = face[k] - p, b = face[(k + 1) % 3] - p;
            part[(k + 2) % 3] = a.y() * b.z() - a.z() * b.y();
        }
        if ((part[0] < 0.0) != (part[1] < 0.0) || (part[1] < 0.0) != (part[2] < 0.0)) return false;
        const double sum = part[0] + part[1] + part[2];
        if (sum == 0.0) return false;
        const double x =
            (part[0] * face[0].x() + part[1] * face[1].x() + part[2] * face[2].x()) / sum;
        return side_ * (x - p.x()) > 0.0;
    }

    double side_;
    std::vector<std::array<Vec3, 3>> faces_;
    Box3 box_;
};

class Teapot final : public Shape {
public:
    Teapot()
        : patches_(load_patches()),
          body_(patches_),
          handle_(std::span(patches_).subspan(12, 4), -1.0),
          spout_(std::span(patches_).subspan(16, 4), 1.0) {
        double area = 0.0;
        for (const Patch& patch : patches_) {
            std::array<Vec3, (cells + 1) * (cells + 1)> grid;
            for (std::size_t j = 0; j <= cells; ++j)
                for (std::size_t i = 0; i <= cells; ++i) {
                    Vec3& p = grid[j * (cells + 1) + i];
                    p = at(patch, static_cast<double>(i) / cells, static_cast<double>(j) / cells);
                    box_.extend(p);
                }
            for (std::size_t cell = 0; cell < cells * cells; ++cell) {
                const std::size_t a = cell / cells * (cells + 1) + cell % cells;
                const Vec3 diagonal = grid[a + cells + 2] - grid[a];
                for (const std::size_t other : {a + 1, a + cells + 1}) {
                    area += 0.5 * diagonal.cross(grid[other] - grid[a]).norm();
                    area_below_.push_back(area);
                }
            }
        }
    }

    Vec3 sample(RandomStream& random) const override {
        for (;;) {
            // Chooses a cell of the patches by its area, then a place in it. The cells are small
            // enough to have an even area density, and the point lies on the patch itself, not on a
            // chord.
            const double pick = random.uniform(0.0, area_below_.back());
            const auto found = std::upper_bound(area_below_.begin(), area_below_.end(), pick);
            const auto triangle = static_cast<std::size_t>(std::min(found, area_below_.end() - 1) -
                                                           area_below_.begin());
            const std::size_t patch = triangle / (2 * cells * cells);
            const std::size_t cell = triangle / 2 % (cells * cells);
            double u = random.uniform(), v = random.uniform();
            if ((triangle % 2 == 0) != (u > v)) std::swap(u, v);
            const Vec3 p = at(patches_[patch], (static_cast<double>(cell % cells) + u) / cells,
                              (static_cast<double>(cell / cells) + v) / cells);
            if (!hidden(patch, p)) return p;
        }
    }

    Box3 box() const override { return box_; }

    ShapeMesh mesh() const override {
        ShapeMesh mesh;
        // joins the patches along their borders
        std::map<std::array<long long, 3>, std::uint32_t> known;
        const auto vertex = [&](const Vec3& p) {
            std::array<long long, 3> key;
            for (std::size_t k = 0; k < 3; ++k) key[k] = std::llround(p[static_cast<int>(k)] * 1e9);
            const auto [place, added] =
                known.try_emplace(key, static_cast<std::uint32_t>(mesh.points.size()));
            if (added) mesh.points.push_back(p);
            return place->second;
        };
        for (std::size_t n = 0; n < patches_.size(); ++n) {
            const auto corner = [&](std::size_t i, std::size_t j) {
                return at(patches_[n], static_cast<double>(i) / cells,
                          static_cast<double>(j) / cells);
            };
            const auto face = [&](const Vec3& a, const Vec3& b, const Vec3& c) {
                if (hidden(n, (a + b + c) / 3.0)) return;
                const std::array<std::uint32_t, 3> ids{vertex(a), vertex(b), vertex(c)};
                if (ids[0] != ids[1] && ids[1] != ids[2] && ids[2] != ids[0])
                    mesh.faces.push_back(ids);
            };
            for (std::size_t j = 0; j < cells; ++j)
                // u cross v points outwards in these patches
                for (std::size_t i = 0; i < cells; ++i) {
                    const Vec3 a = corner(i, j), b = corner(i + 1, j), c = corner(i + 1, j + 1),
                               d = corner(i, j + 1);
                    face(a, b, c);
                    face(a, c, d);
                }
        }
        return mesh;
    }

private:
    static constexpr std::size_t cells = 32;  // per side of a patch

    bool hidden(std::size_t patch, const Vec3& p) const {
        if (enters_body(patch)) return body_.contains(p);
        return handle_.encloses(p) || spout_.encloses(p);
    }

    std::vector<Patch> patches_;
    Body body_;
    Tube handle_, spout_;
    Box3 box_;
    std::vector<double> area_below_;  ///< cumulative areas of the triangles of all cells
};

}  // namespace

std::unique_ptr<Shape> make_teapot() { return std::make_unique<Teapot>(); }

}  // namespace dsc::cloud
