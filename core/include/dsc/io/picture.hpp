#pragma once
// Shaded pictures of surfaces by ray casting, without a display.

#include <array>
#include <cstdint>
#include <dsc/surface/triangle_mesh.hpp>
#include <filesystem>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace dsc {
class Workers;
}

namespace dsc::io {

/// Rows from the top, three bytes (red, green, blue; sRGB) a pixel.
struct Image {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> pixels;

    std::array<std::uint8_t, 3> at(int x, int y) const {
        const auto i =
            3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x));
        return {pixels[i], pixels[i + 1], pixels[i + 2]};
    }
};

enum class View { front, back, left, right, top, bottom, iso };

/// The view of a name as on the command line; empty when there is none. [parallel]
std::optional<View> view_from_name(std::string_view name);

enum class UpAxis { y, z };

/// The values that the two ends of a ramp of colours show.
struct ColourBounds {
    double low = 0.0;
    double high = 0.0;
};

/// The quantiles 0.01 and 0.99 of the finite values, so that a few stray ones do not leave all others in one colour; zeros
/// without a finite value.
ColourBounds colour_bounds(std::span<const double> values);

/// Where a finite value is between the bounds: 0 at `low` and below, 1 at `high` and above. [parallel]
double colour_part(double value, const ColourBounds& bounds);

struct RenderOptions {
    View view = View::iso;
    int width = 1024;       ///< 1 to 16384
    int height = 768;       ///< 1 to 16384
    bool edges = false;     ///< draw the edges of the triangles
    UpAxis up = UpAxis::y;  ///< what "top" means
    bool ambient_occlusion = true;
    /// One per point, or none: the outside gets the colours of the report's viewer between their colour_bounds(), blue for
    /// low and red for high, and is plain where a value is not finite.
    std::span<const double> values = {};
    Workers* workers = nullptr;  ///< the picture does not depend on it
};

/// Orthographic picture of the mesh, fitted to the frame, the same bytes every time. Throws GeometryError as
/// surface::require_sound(), "surface.empty" without faces, "surface.size" when the values do not fit, UsageError "picture.size". [step]
Image render(const surface::TriangleMesh& mesh, const RenderOptions& options = {});

/// Writes a PNG, atomically. Throws IoError "io.write". [step]
void write_png(const std::filesystem::path& file, const Image& image);

}  // namespace dsc::io
