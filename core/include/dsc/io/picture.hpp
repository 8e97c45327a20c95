#pragma once
// Shaded pictures of surfaces by ray casting, without a display.

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include <dsc/surface/triangle_mesh.hpp>

namespace dsc {
class Workers;
}

namespace dsc::io {

/// Rows from the top; three bytes (red, green, blue; sRGB) per pixel.
struct Image {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> pixels;

    std::array<std::uint8_t, 3> at(int x, int y) const {
        const auto i = 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                            static_cast<std::size_t>(x));
        return {pixels[i], pixels[i + 1], pixels[i + 2]};
    }
};

enum class View { front, back, left, right, top, bottom, iso };

/// The view with a name of the command line; empty if there is none. [parallel]
std::optional<View> view_from_name(std::string_view name);

enum class UpAxis { y, z };

/// The values at the two ends of a colour scale.
struct ColourBounds {
    double low = 0.0;
    double high = 0.0;
};

/// The quantiles 0.01 and 0.99 of the finite values, so that a few extreme values do not give all
/// others the same colour; zeros if no value is finite.
ColourBounds colour_bounds(std::span<const double> values);

/// Position of a finite value between the bounds: 0 at `low` and below, 1 at `high` and above.
/// [parallel]
double colour_part(double value, const ColourBounds& bounds);

struct RenderOptions {
    View view = View::iso;
    int width = 1024;       ///< 1 to 16384
    int height = 768;       ///< 1 to 16384
    bool edges = false;     ///< draw the edges of the triangles
    UpAxis up = UpAxis::y;  ///< the axis that points up
    bool ambient_occlusion = true;
    /// One value per point, or none. The outside gets the colours of the report's viewer between
    /// colour_bounds() of the values: blue for low, red for high, the plain colour where a value is
    /// not finite.
    std::span<const double> values = {};
    Workers* workers = nullptr;  ///< the picture does not depend on it
};

/// Orthographic picture of the mesh, fitted to the frame; the bytes are always the same. Throws
/// GeometryError as surface::require_sound(), "surface.empty" without faces, "surface.size" for a
/// wrong number of values, UsageError "picture.size". [step]
Image render(const surface::TriangleMesh& mesh, const RenderOptions& options = {});

/// Writes a PNG, atomically. Throws IoError "io.write". [step]
void write_png(const std::filesystem::path& file, const Image& image);

}  // namespace dsc::io
