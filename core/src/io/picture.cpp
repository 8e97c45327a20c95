// Shaded pictures: rays, colours, ambient occlusion.
#include "dsc/io/picture.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <numbers>
#include <utility>

#include <fmt/core.h>

#include <dsc/base/error.hpp>
#include <dsc/base/workers.hpp>
#include <dsc/surface/measure.hpp>

#include "io/embree_backend.hpp"
#include "io/shading_normals.hpp"

namespace dsc::io {
namespace {

constexpr std::array<std::pair<std::string_view, View>, 7> view_names = {{{"front", View::front},
                                                                          {"back", View::back},
                                                                          {"left", View::left},
                                                                          {"right", View::right},
                                                                          {"top", View::top},
                                                                          {"bottom", View::bottom},
                                                                          {"iso", View::iso}}};
constexpr int largest_size = 16384;
constexpr float margin = 0.05F;         // of the frame, on each side
constexpr unsigned occlusion_rays = 2;  // per pixel; 4 x 4 pixels share theirs

/// Rows: right, up, towards the viewer, in the mesh's coordinates.
Eigen::Matrix3d view_axes(View view, UpAxis up) {
    Vec3 towards(0, 0, 1), above(0, 1, 0);
    switch (view) {
        case View::front: break;
        case View::back: towards = {0, 0, -1}; break;
        case View::left: towards = {-1, 0, 0}; break;
        case View::right: towards = {1, 0, 0}; break;
        case View::top: towards = {0, 1, 0}, above = {0, 0, -1}; break;
        case View::bottom: towards = {0, -1, 0}, above = {0, 0, 1}; break;
        case View::iso: towards = Vec3(0.62, 0.48, 1.0).normalized(); break;
    }
    const Vec3 right = above.cross(towards).normalized();
    Eigen::Matrix3d axes;
    axes.row(0) = right;
    axes.row(1) = towards.cross(right);
    axes.row(2) = towards;
    if (up == UpAxis::y) return axes;
    // With z up the front is where y is least: (x, y, z) is seen as (x, z, -y).
    Eigen::Matrix3d turn;
    turn << 1, 0, 0, 0, 0, 1, 0, -1, 0;
    return axes * turn;
}

/// The points in pixels: x to the right and y upwards from the middle of the frame, z towards the
/// viewer, z <= 0.
std::vector<Vec3f> project(const surface::TriangleMesh& mesh, const RenderOptions& options) {
    const Eigen::Matrix3d axes = view_axes(options.view, options.up);
    // Everything is centred in doubles before the conversion to float.
    const Vec3 middle = surface::used_box(mesh).centre();
    Box3 box;
    for (const auto& face : mesh.faces) {
        for (const std::uint32_t v : face) box.extend(axes * (mesh.points[v] - middle));
    }
    const double width = options.width * (1.0 - 2.0 * margin),
                 height = options.height * (1.0 - 2.0 * margin);
    const Vec3 size = box.size().cwiseMax(1e-9 * box.diagonal());
    const double scale = box.diagonal() > 0.0 ? std::min(width / size.x(), height / size.y()) : 1.0;
    const Vec3 origin(box.centre().x(), box.centre().y(), box.high.z());
    std::vector<Vec3f> out;
    out.reserve(mesh.points.size());
    for (const Vec3& p : mesh.points)
        out.push_back((scale * (axes * (p - middle) - origin)).cast<float>());
    return out;
}

using Colour = Eigen::Array3f;  // linear light

const Colour front_colour(0.24F, 0.41F, 0.58F);
const Colour back_colour(0.62F, 0.26F, 0.16F);
const Colour line_colour(0.012F, 0.016F, 0.025F);
const Colour sky_light(0.50F, 0.54F, 0.60F);
const Colour ground_light(0.24F, 0.21F, 0.19F);
const Colour key_light(1.02F, 0.97F, 0.90F);
const Colour head_light(0.14F, 0.15F, 0.16F);

/// A soft gradient, lighter at the top.
Colour background(float height) {
    const Colour low(0.80F, 0.83F, 0.87F), high(0.97F, 0.98F, 0.99F);
    return low + height * (high - low);
}

/// The colour scale of the report's viewer, from good to bad. People who cannot distinguish red and
/// green can also read it.
Colour ramp(float part) {
    constexpr std::array<std::array<float, 3>, 5> stops = {{{0.13F, 0.35F, 0.55F},
                                                            {0.16F, 0.60F, 0.62F},
                                                            {0.55F, 0.75F, 0.38F},
                                                            {0.96F, 0.76F, 0.20F},
                                                            {0.85F, 0.28F, 0.16F}}};
    const float at = std::clamp(part, 0.0F, 1.0F) * 4.0F;
    const auto low = static_cast<std::size_t>(std::min(at, 3.0F));
    Colour out;
    for (std::size_t k = 0; k < 3; ++k) {
        const float srgb =
            stops[low][k] + (at - static_cast<float>(low)) * (stops[low + 1][k] - stops[low][k]);
        out[static_cast<int>(k)] =
            srgb <= 0.04045F ? srgb / 12.92F : std::pow((srgb + 0.055F) / 1.055F, 2.4F);
    }
    return out;
}

/// Position of each value on the scale; NaN if it is not finite.
std::vector<float> ramp_parts(std::span<const double> values) {
    const ColourBounds bounds = colour_bounds(values);
    std::vector<float> parts;
    parts.reserve(values.size());
    for (const double value : values) {
        parts.push_back(std::isfinite(value) ? static_cast<float>(colour_part(value, bounds))
                                             : std::numeric_limits<float>::quiet_NaN());
    }
    return parts;
}

Colour shade(const Vec3f& normal, const Colour& material, float open) {
    static const Vec3f key = Vec3f(-0.45F, 0.62F, 0.64F).normalized();
    static const Vec3f half = (key + Vec3f(0, 0, 1)).normalized();
    const float lit = std::max(0.0F, (normal.dot(key) + 0.12F) / 1.12F);
    const Colour ambient = ground_light + (0.5F + 0.5F * normal.y()) * (sky_light - ground_light);
    // Crevices also get less of the key light; this partly replaces its soft shadow.
    const Colour light = open * ambient + (0.3F + 0.7F * open) * lit * key_light +
                         (0.4F + 0.6F * open) * std::max(0.0F, normal.z()) * head_light;
    const auto square = [](float x) { return x * x; };
    const float fourth = square(square(std::max(0.0F, normal.dot(half))));
    const float gloss = 0.10F * square(square(square(fourth))) * fourth * open;  // 36th power
    return material * light + gloss;
}

std::uint8_t to_srgb(float linear) {
    const float x = std::clamp(linear, 0.0F, 1.0F);
    const float y = x <= 0.0031308F ? 12.92F * x : 1.055F * std::pow(x, 1.0F / 2.4F) - 0.055F;
    return static_cast<std::uint8_t>(std::lround(255.0F * y));
}

float radical_inverse(unsigned i) {
    float value = 0.0F, digit = 0.5F;
    for (; i != 0; i >>= 1U, digit *= 0.5F) value += (i & 1U) != 0 ? digit : 0.0F;
    return value;
}

/// Directions round +z with the density of their cosine. A pixel uses every 16th of them.
std::array<Vec3f, 16 * occlusion_rays> occlusion_directions() {
    std::array<Vec3f, 16 * occlusion_rays> all;
    for (unsigned number = 0; number < all.size(); ++number) {
        const float share = (static_cast<float>(number) + 0.5F) / static_cast<float>(all.size());
        const float angle = 2.0F * std::numbers::pi_v<float> * radical_inverse(number);
        const float radius = std::sqrt(share);
        all[number] = {radius * std::cos(angle), radius * std::sin(angle), std::sqrt(1.0F - share)};
    }
    return all;
}

/// What a ray through one pixel hits.
struct Surfel {
    Vec3f point = Vec3f::Zero();
    Vec3f normal = Vec3f::Zero();  ///< for shading, towards the viewer
    Vec3f flat = Vec3f::Zero();    ///< of the face, towards the viewer
    std::uint32_t face = 0;
    bool front = true;
    bool hit = false;
    float open = 1.0F;
    float part = std::numeric_limits<float>::quiet_NaN();  ///< position on the colour scale
};

class Painter {
public:
    Painter(const surface::TriangleMesh& mesh, const RenderOptions& options)
        : options_(options),
          faces_(mesh.faces),
          points_(project(mesh, options)),
          normals_(shading_normals(points_, faces_)),
          parts_(ramp_parts(options.values)),
          scene_(embree_backend().make_scene(points_, faces_)) {
        Eigen::AlignedBox3f box;
        for (const auto& face : faces_) {
            for (const std::uint32_t v : face) box.extend(points_[v]);
        }
        diagonal_ = box.diagonal().norm();
        centres_.resize(static_cast<std::size_t>(options.width) *
                        static_cast<std::size_t>(options.height));
    }

    /// First pass: what the middle of every pixel sees, and its occlusion.
    void measure_row(int y) {
        for (int x = 0; x < options_.width; ++x) {
            Surfel& centre = centres_[index(x, y)];
            centre =
                look(frame_x(static_cast<float>(x) + 0.5F), frame_y(static_cast<float>(y) + 0.5F));
            if (centre.hit && options_.ambient_occlusion)
                centre.open = openness(centre, tile_of(x, y));
        }
    }

    /// Second pass.
    void paint_row(int y, Image& image) const {
        // A rotated grid of 2 x 2 samples: near-vertical and near-horizontal lines get four steps
        // instead of two.
        constexpr std::array<std::array<float, 2>, 4> offsets = {
            {{0.375F, 0.125F}, {0.875F, 0.375F}, {0.125F, 0.625F}, {0.625F, 0.875F}}};
        auto out = image.pixels.begin() + 3 * static_cast<std::ptrdiff_t>(y) * image.width;
        const Colour sky = background_at(frame_y(static_cast<float>(y) + 0.5F));
        const std::array plain = {to_srgb(sky[0]), to_srgb(sky[1]), to_srgb(sky[2])};
        for (int x = 0; x < image.width; ++x) {
            Colour mean = Colour::Zero();
            if (smooth_at(x, y)) {
                if (!centres_[index(x, y)].hit) {
                    out = std::copy(plain.begin(), plain.end(), out);
                    continue;
                }
                mean = colour_of(centres_[index(x, y)], x, y, 0.5F, 0.5F).min(1.0F);
            } else {
                // Clamped before the mean, so that an edge against the light background stays
                // smooth.
                for (const auto& offset : offsets)
                    mean += 0.25F * sample(x, y, offset[0], offset[1]).min(1.0F);
            }
            for (int k = 0; k < 3; ++k) *out++ = to_srgb(mean[k]);
        }
    }

private:
    float frame_x(float x) const { return x - 0.5F * static_cast<float>(options_.width); }
    float frame_y(float y) const { return 0.5F * static_cast<float>(options_.height) - y; }
    std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(options_.width) +
               static_cast<std::size_t>(x);
    }

    Colour background_at(float y) const {
        return background(0.5F + y / static_cast<float>(options_.height));
    }

    /// 4 x 4 neighbouring pixels have 16 different numbers, distributed so that neighbours differ
    /// much.
    static unsigned tile_of(int x, int y) {
        constexpr std::array<unsigned, 16> order = {0, 8,  2, 10, 12, 4, 14, 6,
                                                    3, 11, 1, 9,  15, 7, 13, 5};
        return order[static_cast<unsigned>(y % 4) * 4 + static_cast<unsigned>(x % 4)];
    }

    Surfel look(float x, float y) const {
        Surfel out;
        RayHit hit;
        out.hit = scene_->first_hit(Vec3f(x, y, 1.0F), Vec3f(0, 0, -1), hit);
        if (!out.hit) return out;
        const auto& [a, b, c] = faces_[hit.face];
        const auto& corner = normals_[hit.face];
        out.face = hit.face;
        out.point = Vec3f(x, y, 1.0F - hit.distance);
        out.flat = (points_[b] - points_[a]).cross(points_[c] - points_[a]).normalized();
        out.normal = ((1.0F - hit.u - hit.v) * corner[0] + hit.u * corner[1] + hit.v * corner[2])
                         .normalized();
        if (!parts_.empty())
            out.part = (1.0F - hit.u - hit.v) * parts_[a] + hit.u * parts_[b] + hit.v * parts_[c];
        out.front = out.flat.z() >= 0.0F;
        if (!out.front) {
            out.flat = -out.flat;
            out.normal = -out.normal;
        }
        return out;
    }

    /// Whether the pixel and the four next to it see one smooth piece of surface, or nothing: one
    /// sample gives its colour.
    bool smooth_at(int x, int y) const {
        if (options_.edges) return false;
        const Surfel& here = centres_[index(x, y)];
        constexpr std::array<std::array<int, 2>, 4> steps = {{{-1, 0}, {1, 0}, {0, -1}, {0, 1}}};
        return std::all_of(steps.begin(), steps.end(), [&](const auto& step) {
            const int nx = std::clamp(x + step[0], 0, options_.width - 1);
            const int ny = std::clamp(y + step[1], 0, options_.height - 1);
            const Surfel& next = centres_[index(nx, ny)];
            if (here.hit != next.hit || here.front != next.front) return false;
            return !here.hit || (here.normal.dot(next.normal) > 0.98F &&
                                 std::abs((next.point - here.point).dot(here.flat)) < 0.75F);
        });
    }

    Colour sample(int px, int py, float dx, float dy) const {
        return colour_of(
            look(frame_x(static_cast<float>(px) + dx), frame_y(static_cast<float>(py) + dy)), px,
            py, dx, dy);
    }

    Colour colour_of(Surfel seen, int px, int py, float dx, float dy) const {
        const float x = frame_x(static_cast<float>(px) + dx),
                    y = frame_y(static_cast<float>(py) + dy);
        if (!seen.hit) return background_at(y);
        if (options_.ambient_occlusion) seen.open = gathered(seen, px, py);
        const Colour outside = std::isfinite(seen.part) ? ramp(seen.part) : front_colour;
        const Colour colour = shade(seen.normal, seen.front ? outside : back_colour, seen.open);
        if (!options_.edges) return colour;
        const auto& [a, b, c] = faces_[seen.face];
        return colour +
               line_strength(x, y, points_[a], points_[b], points_[c]) * (line_colour - colour);
    }

    /// Mean occlusion of the 16 pixels around that lie on the same piece of surface; together they
    /// use all directions.
    float gathered(const Surfel& seen, int px, int py) const {
        float sum = 0.0F, weights = 0.0F;
        for (int y = std::max(0, py - 2); y < std::min(options_.height, py + 2); ++y) {
            for (int x = std::max(0, px - 2); x < std::min(options_.width, px + 2); ++x) {
                const Surfel& centre = centres_[index(x, y)];
                if (!centre.hit) continue;
                const float cosine = std::max(0.0F, centre.normal.dot(seen.normal));
                const float alike = cosine * cosine * cosine * cosine;
                const float off_plane = std::abs((centre.point - seen.point).dot(seen.flat));
                const float weight = alike * alike / (1.0F + off_plane * off_plane);
                sum += weight * centre.open;
                weights += weight;
            }
        }
        return weights > 0.05F ? sum / weights : openness(seen, tile_of(px, py));
    }

    /// Fraction of the hemisphere that is free nearby, cosine-weighted.
    float openness(const Surfel& at, unsigned tile) const {
        const Vec3f& normal = at.normal;
        const Vec3f side = (std::abs(normal.x()) < 0.8F ? Vec3f(1, 0, 0) : Vec3f(0, 1, 0))
                               .cross(normal)
                               .normalized();
        const Vec3f other = normal.cross(side);
        const Vec3f from = at.point + 2e-5F * diagonal_ * at.flat;
        const float reach = 0.3F * diagonal_;
        unsigned cast = 0, free = 0;
        for (unsigned i = 0; i < occlusion_rays; ++i) {
            const Vec3f& local = directions_[i * 16 + tile];
            const Vec3f direction = local.x() * side + local.y() * other + local.z() * normal;
            // Rays below the flat face are artefacts of the smooth normal.
            if (direction.dot(at.flat) <= 0.01F) continue;
            ++cast;
            if (!scene_->blocked(from, direction, reach)) ++free;
        }
        return cast == 0 ? 1.0F : static_cast<float>(free) / static_cast<float>(cast);
    }

    /// 1 on an edge of the projected triangle; weaker where triangles are only a few pixels wide.
    static float line_strength(float x, float y, const Vec3f& a, const Vec3f& b, const Vec3f& c) {
        constexpr float half_width = 0.6F, full_height = 7.0F;
        const Eigen::Vector2f p(x, y);
        const std::array<Eigen::Vector2f, 3> q = {a.head<2>(), b.head<2>(), c.head<2>()};
        const Eigen::Vector2f ab = q[1] - q[0], ac = q[2] - q[0];
        const float doubled_area = std::abs(ab.x() * ac.y() - ab.y() * ac.x());
        float nearest = std::numeric_limits<float>::infinity(), longest = 0.0F;
        for (std::size_t k = 0; k < 3; ++k) {
            const Eigen::Vector2f edge = q[(k + 1) % 3] - q[k];
            const float length = edge.norm();
            longest = std::max(longest, length);
            const float t = length > 0.0F
                                ? std::clamp((p - q[k]).dot(edge) / (length * length), 0.0F, 1.0F)
                                : 0.0F;
            nearest = std::min(nearest, (p - q[k] - t * edge).norm());
        }
        if (nearest > half_width || longest <= 0.0F) return 0.0F;
        return 0.85F * std::clamp(doubled_area / longest / full_height, 0.12F, 1.0F);
    }

    const RenderOptions& options_;
    const std::vector<std::array<std::uint32_t, 3>>& faces_;
    std::vector<Vec3f> points_;
    std::vector<std::array<Vec3f, 3>> normals_;
    std::vector<float> parts_;  ///< position of the points on the scale; empty: one colour
    std::unique_ptr<RayScene> scene_;
    float diagonal_ = 0.0F;
    const std::array<Vec3f, 16 * occlusion_rays> directions_ = occlusion_directions();
    std::vector<Surfel> centres_;  ///< one per pixel
};

}  // namespace

std::optional<View> view_from_name(std::string_view name) {
    for (const auto& [known, view] : view_names) {
        if (known == name) return view;
    }
    return std::nullopt;
}

ColourBounds colour_bounds(std::span<const double> values) {
    std::vector<double> finite;
    std::copy_if(values.begin(), values.end(), std::back_inserter(finite),
                 [](double v) { return std::isfinite(v); });
    if (finite.empty()) return {};
    const auto quantile = [&](double part) {
        const auto at = finite.begin() +
                        static_cast<std::ptrdiff_t>(part * static_cast<double>(finite.size() - 1));
        std::nth_element(finite.begin(), at, finite.end());
        return *at;
    };
    return {quantile(0.01), quantile(0.99)};
}

double colour_part(double value, const ColourBounds& bounds) {
    if (!(bounds.high > bounds.low)) return 0.0;
    // The difference of two huge bounds may be infinite; the difference of their halves is not.
    return std::clamp((0.5 * value - 0.5 * bounds.low) / (0.5 * bounds.high - 0.5 * bounds.low),
                      0.0, 1.0);
}

Image render(const surface::TriangleMesh& mesh, const RenderOptions& options) {
    for (const int size : {options.width, options.height}) {
        if (size >= 1 && size <= largest_size) continue;
        throw UsageError(
            "picture.size", "picture",
            fmt::format("a size of {}x{} pixels is not possible", options.width, options.height),
            fmt::format("use 1 to {} pixels per side", largest_size));
    }
    surface::require_sound(mesh);
    if (mesh.faces.empty()) {
        throw GeometryError("surface.empty", "picture", "the mesh has no faces",
                            "at least one is needed");
    }
    if (!options.values.empty() && options.values.size() != mesh.points.size()) {
        throw GeometryError(
            "surface.size", "picture",
            fmt::format("{} values for {} points", options.values.size(), mesh.points.size()),
            "give one for each or none");
    }
    Painter painter(mesh, options);
    Image image{options.width, options.height, {}};
    image.pixels.resize(3 * static_cast<std::size_t>(options.width) *
                        static_cast<std::size_t>(options.height));
    Workers alone;
    const auto for_rows = [&](const std::function<void(int)>& paint) {
        (options.workers != nullptr ? *options.workers : alone)
            .for_blocks(static_cast<std::size_t>(options.height), 8,
                        [&](std::size_t begin, std::size_t end) {
                            for (std::size_t y = begin; y < end; ++y) paint(static_cast<int>(y));
                        });
    };
    for_rows([&](int y) { painter.measure_row(y); });
    for_rows([&](int y) { painter.paint_row(y, image); });
    return image;
}

}  // namespace dsc::io
