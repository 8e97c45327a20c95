#include <doctest/doctest.h>
#include <png.h>

#include <dsc/base/workers.hpp>
#include <dsc/io/picture.hpp>

#include "files.hpp"

using namespace dsc;
using namespace dsc::io;
using surface::TriangleMesh;

namespace {

/// A tetrahedron: one corner up (y), the others wide.
TriangleMesh tetrahedron() {
    TriangleMesh m;
    m.points = {{0, 1, 0}, {-1, -1, 1}, {1, -1, 1}, {0, -1, -1}};
    m.faces = {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}};
    return m;
}

/// Two triangles that fill a square of the xy plane and look to +z.
TriangleMesh square() {
    TriangleMesh m;
    m.points = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
    m.faces = {{0, 1, 2}, {0, 2, 3}};
    return m;
}

RenderOptions small(View view) {
    RenderOptions o;
    o.view = view;
    o.width = 96;
    o.height = 64;
    return o;
}

/// The background is grey or nearly so; the object is blue in front and red behind.
bool is_object(const Image& image, int x, int y) {
    const auto [r, g, b] = image.at(x, y);
    return std::abs(r - b) > 12 || b < 160;
}

int object_pixels(const Image& image) {
    int count = 0;
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) count += is_object(image, x, y) ? 1 : 0;
    }
    return count;
}

}  // namespace

TEST_CASE("names of views") {
    CHECK(view_from_name("front") == View::front);
    CHECK(view_from_name("iso") == View::iso);
    CHECK_FALSE(view_from_name("Front").has_value());
    CHECK_FALSE(view_from_name("").has_value());
}

TEST_CASE("object and background, where they must be") {
    const Image image = render(tetrahedron(), small(View::front));
    CHECK(image.width == 96);
    CHECK(image.pixels.size() == 96 * 64 * 3);
    CHECK(is_object(image, 48, 40));       // inside the triangle
    CHECK(is_object(image, 48, 8));        // below its tip
    CHECK_FALSE(is_object(image, 30, 8));  // beside the tip
    CHECK_FALSE(is_object(image, 2, 2));
    CHECK_FALSE(is_object(image, 93, 61));
    // Base and height are 90 % of 64 pixels.
    const double expected = 0.5 * 57.6 * 57.6;
    CHECK(std::abs(object_pixels(image) - expected) < 0.06 * expected);
}

TEST_CASE("every view fits the frame and fills it") {
    for (const View view :
         {View::front, View::back, View::left, View::right, View::top, View::bottom, View::iso}) {
        const Image image = render(tetrahedron(), small(view));
        CHECK(object_pixels(image) > 500);
        for (int x = 0; x < 96; ++x)
            CHECK_FALSE((is_object(image, x, 0) || is_object(image, x, 63)));
        for (int y = 0; y < 64; ++y)
            CHECK_FALSE((is_object(image, 0, y) || is_object(image, 95, y)));
    }
}

TEST_CASE("up is y, or z when asked for") {
    // A thin arrow along +z with its head at the top: seen from the front it stands upright only
    // with z up.
    TriangleMesh arrow;
    arrow.points = {{-0.2, 0, -1}, {0.2, 0, -1}, {0, 0, 1}, {0, 0.2, -1}};
    arrow.faces = {{0, 1, 2}, {1, 3, 2}, {3, 0, 2}, {0, 3, 1}};
    RenderOptions o = small(View::front);
    o.up = UpAxis::z;
    const Image upright = render(arrow, o);
    CHECK(is_object(upright, 48, 10));
    CHECK(is_object(upright, 48, 58));
    CHECK_FALSE(is_object(upright, 43, 10));
    CHECK(is_object(upright, 44, 59));
    // With y up the same picture is the view from below.
    CHECK(object_pixels(render(arrow, small(View::bottom))) == object_pixels(upright));
}

TEST_CASE("the back of a face is coloured differently from its front") {
    const auto front = render(square(), small(View::front)).at(48, 32);
    const auto back = render(square(), small(View::back)).at(48, 32);
    CHECK(front[2] > front[0]);
    CHECK(back[0] > back[2]);
}

TEST_CASE("edges are dark lines") {
    RenderOptions o = small(View::front);
    const Image plain = render(square(), o);
    o.edges = true;
    const Image lined = render(square(), o);
    // The diagonal runs through the middle of the frame from lower left to upper right.
    CHECK(lined.at(48, 31)[1] + 40 < plain.at(48, 31)[1]);
    CHECK(lined.at(60, 40) == plain.at(60, 40));
}

TEST_CASE("occlusion darkens a corner and nothing on a convex body") {
    TriangleMesh corner;  // floor and wall
    corner.points = {{-1, 0, 0}, {1, 0, 0}, {1, 0, 2}, {-1, 0, 2}, {-1, 2, 0}, {1, 2, 0}};
    corner.faces = {{0, 2, 1}, {0, 3, 2}, {0, 1, 5}, {0, 5, 4}};
    RenderOptions o = small(View::front);
    o.ambient_occlusion = false;
    const Image open = render(corner, o), body = render(tetrahedron(), o);
    o.ambient_occlusion = true;
    CHECK(render(corner, o).at(48, 56)[1] + 15 < open.at(48, 56)[1]);
    CHECK(render(tetrahedron(), o).pixels == body.pixels);
}

TEST_CASE("the same bytes every time, for any number of threads") {
    RenderOptions o = small(View::iso);
    o.edges = true;
    const Image first = render(tetrahedron(), o), second = render(tetrahedron(), o);
    CHECK(first.pixels == second.pixels);
    Workers workers(3);
    o.workers = &workers;
    CHECK(render(tetrahedron(), o).pixels == first.pixels);
}

TEST_CASE("a mesh far from the origin looks like the same mesh near it") {
    TriangleMesh far = tetrahedron();
    for (Vec3& p : far.points) p += Vec3(0x1p22, 0x1p22, 0x1p22);
    CHECK(render(far, small(View::iso)).pixels == render(tetrahedron(), small(View::iso)).pixels);
}

TEST_CASE("degenerate bodies do not disturb") {
    TriangleMesh point;
    point.points = {{1, 1, 1}, {1, 1, 1}, {1, 1, 1}};
    point.faces = {{0, 1, 2}};
    CHECK(object_pixels(render(point, small(View::front))) == 0);
    TriangleMesh line;
    line.points = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
    line.faces = {{0, 1, 2}};
    CHECK(object_pixels(render(line, small(View::front))) == 0);
    CHECK(object_pixels(render(square(), small(View::top))) == 0);
}

TEST_CASE("what cannot be drawn is refused") {
    CHECK_THROWS_WITH_AS(render(TriangleMesh{}),
                         "picture: the mesh has no faces; at least one is needed", GeometryError);
    RenderOptions o;
    o.width = 0;
    CHECK_THROWS_WITH_AS(
        render(square(), o),
        "picture: a size of 0x768 pixels is not possible; use 1 to 16384 pixels per side",
        UsageError);
    o.width = 100000;
    CHECK_THROWS_AS(render(square(), o), UsageError);
    TriangleMesh bad = square();
    bad.faces[0][0] = 9;
    CHECK_THROWS_AS(render(bad), GeometryError);
}

TEST_CASE("the png holds the pixels and is the same file every time") {
    const test::Folder folder;
    const Image image = render(tetrahedron(), small(View::iso));
    write_png(folder / "a.png", image);
    write_png(folder / "b.png", image);
    CHECK(test::content_of(folder / "a.png") == test::content_of(folder / "b.png"));
    png_image header{};
    header.version = PNG_IMAGE_VERSION;
    REQUIRE(png_image_begin_read_from_file(&header, (folder / "a.png").c_str()) != 0);
    CHECK(header.width == 96);
    CHECK(header.height == 64);
    header.format = PNG_FORMAT_RGB;
    std::vector<std::uint8_t> pixels(96 * 64 * 3);
    REQUIRE(png_image_finish_read(&header, nullptr, pixels.data(), 0, nullptr) != 0);
    CHECK(pixels == image.pixels);
    const auto found =
        test::refusal(folder / "none/a.png", [&](const auto& f) { write_png(f, image); });
    CHECK(found.code == "io.write");
}

TEST_CASE("values colour the outside: blue where they are low, red where they are high, plain "
          "without one") {
    const TriangleMesh m = square();
    RenderOptions options = small(View::front);
    const Image plain = render(m, options);
    const std::vector<double> across = {3, 7, 7, 3};
    options.values = across;
    const Image image = render(m, options);
    const int y = image.height / 2, middle = image.width / 2, side = image.height / 4;
    const auto left = image.at(middle - side, y), right = image.at(middle + side, y),
               centre = image.at(middle, y);
    CHECK(left[2] > left[0] + 40);
    CHECK(right[0] > right[2] + 40);
    CHECK(centre[1] > centre[0]);  // the ramp's middle is green
    CHECK(centre[1] > centre[2]);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const std::vector<double> none = {nan, nan, nan, nan};
    options.values = none;
    CHECK(render(m, options).pixels == plain.pixels);
    // The inside keeps its colour.
    options.view = View::back;
    options.values = across;
    const Image inside = render(m, options);
    options.values = {};
    CHECK(inside.pixels == render(m, options).pixels);
    options.values = std::span(across).first(3);
    CHECK_THROWS_WITH_AS(render(m, options),
                         "picture: 3 values for 4 points; give one for each or none",
                         GeometryError);
}

TEST_CASE("bounds of colours leave out the outer hundredths and what is not finite") {
    std::vector<double> values;
    for (int i = 100; i >= 0; --i) values.push_back(i);
    CHECK(colour_bounds(values).low == 1);
    CHECK(colour_bounds(values).high == 99);
    values.insert(values.begin(), {std::numeric_limits<double>::quiet_NaN(),
                                   std::numeric_limits<double>::infinity()});
    CHECK(colour_bounds(values).high == 99);
    CHECK(colour_bounds({}).high == 0);
    const ColourBounds bounds{2, 6};
    CHECK(colour_part(3, bounds) == 0.25);
    CHECK(colour_part(-1e300, bounds) == 0);
    CHECK(colour_part(1e300, bounds) == 1);
    CHECK(colour_part(5, {5, 5}) == 0);
    CHECK(colour_part(0, {-1.7e308, 1.7e308}) == 0.5);
}
