#include <array>
#include <cmath>
#include <limits>

#include <cloud/winding_kernels.hpp>
#include <doctest/doctest.h>

#include <dsc/base/error.hpp>
#include <dsc/base/random.hpp>
#include <dsc/cloud/winding_field.hpp>

#include "solids.hpp"

using dsc::Vec3;
using namespace dsc::cloud;
using namespace dsc::cloud::known;

namespace {

const double four_pi = 4.0 * std::acos(-1.0);

/// The sum that the field stands for, in double, source by source.
double direct_winding(std::span<const SurfaceSample> samples, const Vec3& x, double target,
                      double smoothing) {
    double sum = 0.0;
    for (const SurfaceSample& s : samples) {
        const double own = smoothing * s.width;
        const Vec3 d = s.position - x;
        const double rho = std::sqrt(d.squaredNorm() + 0.5 * (target * target + own * own));
        sum += s.area.dot(d) / (rho * rho * rho);
    }
    return sum / four_pi;
}

/// Places all round, none of them nearer to the unit box's middle than that to its rim.
std::vector<Vec3> places(std::size_t count, double reach) {
    dsc::RandomStream random({3, 0, 0, 0});
    std::vector<Vec3> out;
    for (std::size_t i = 0; i < count; ++i)
        out.emplace_back(reach * (2.0 * random.uniform() - 1.0),
                         reach * (2.0 * random.uniform() - 1.0),
                         reach * (2.0 * random.uniform() - 1.0));
    return out;
}

WindingField field_of(std::span<const SurfaceSample> samples, double opening,
                      double smoothing = 0.5) {
    std::vector<Vec3> positions, vectors;
    std::vector<double> weights, lengths;
    for (const SurfaceSample& s : samples) {
        positions.push_back(s.position);
        vectors.push_back(s.area);
        weights.push_back(s.width * s.width);
        lengths.push_back(smoothing * s.width);
    }
    WindingField field(positions, weights, opening);
    field.set_smoothing(lengths);
    field.set_vectors(vectors);
    return field;
}

double dot(std::span<const double> a, std::span<const double> b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
    return sum;
}

}  // namespace

TEST_CASE("winding field: 1 inside and 0 outside of a sphere, a torus and a cube") {
    const auto check = [](const Solid& solid, const auto& distance) {
        const WindingField field = winding_field(samples_of(solid));
        const std::vector<Vec3> points = places(3000, 1.6);
        std::vector<double> w(points.size());
        field.evaluate(points, {}, w);
        std::size_t inside = 0;
        for (std::size_t i = 0; i < points.size(); ++i) {
            const double away = distance(points[i]);
            if (std::abs(away) < 0.1) continue;
            inside += away < 0.0 ? 1U : 0U;
            // Random samples cover a surface unevenly, which is felt near it.
            CHECK(std::abs(w[i] - (away < 0.0 ? 1.0 : 0.0)) < 0.25);
            if (std::abs(away) > 0.3) CHECK(std::abs(w[i] - (away < 0.0 ? 1.0 : 0.0)) < 0.1);
        }
        CHECK(inside > 100);
    };
    check(sphere(8000), [](const Vec3& p) { return p.norm() - 1.0; });
    check(torus(8000), [](const Vec3& p) {
        return Vec3(std::hypot(p.x(), p.y()) - 1.0, p.z(), 0.0).norm() - 0.4;
    });
    check(cube(8000), [](const Vec3& p) { return p.cwiseAbs().maxCoeff() - 1.0; });
}

TEST_CASE("winding field: without clusters it is the sum over all sources") {
    const std::vector<SurfaceSample> samples = samples_of(torus(600));
    const WindingField field = field_of(samples, 0.0);
    const std::vector<Vec3> points = places(300, 1.6);
    const std::vector<double> smoothing(points.size(), 0.03);
    std::vector<double> w(points.size());
    field.evaluate(points, smoothing, w);
    for (std::size_t i = 0; i < points.size(); ++i)
        CHECK(w[i] == doctest::Approx(direct_winding(samples, points[i], 0.03, 0.5))
                          .scale(1.0)
                          .epsilon(1e-5));
}

TEST_CASE("winding field: clusters cost little accuracy, the less the smaller they are") {
    const std::vector<SurfaceSample> samples = samples_of(torus(5000));
    const std::vector<Vec3> points = places(1000, 1.6);
    std::vector<double> exact, w(points.size());
    for (const Vec3& p : points) exact.push_back(direct_winding(samples, p, 0.0, 0.5));
    const auto error = [&](double opening) {
        field_of(samples, opening).evaluate(points, {}, w);
        double square = 0.0;
        for (std::size_t i = 0; i < points.size(); ++i) {
            CHECK(std::abs(w[i] - exact[i]) < 0.12 * opening);
            square += (w[i] - exact[i]) * (w[i] - exact[i]);
        }
        return std::sqrt(square / static_cast<double>(points.size()));
    };
    const double usual = error(0.5), fine = error(0.25);
    CHECK(usual < 0.02);
    CHECK(fine < 0.5 * usual);
    CHECK(fine > 1e-5);  // clusters were used at all
}

TEST_CASE("winding field: the gradient is that of the winding number") {
    const std::vector<SurfaceSample> samples = samples_of(sphere(500));
    WindingField field = field_of(samples, 0.0);
    const std::vector<Vec3> points = places(100, 1.5);
    const std::vector<double> smoothing(points.size(), 0.1);
    std::vector<Vec3> gradients(points.size());
    field.evaluate_gradient(points, smoothing, gradients);
    for (std::size_t i = 0; i < points.size(); ++i)
        for (int k = 0; k < 3; ++k) {
            const Vec3 step = 1e-4 * Vec3::Unit(k);
            const double slope = (direct_winding(samples, points[i] + step, 0.1, 0.5) -
                                  direct_winding(samples, points[i] - step, 0.1, 0.5)) /
                                 2e-4;
            CHECK(gradients[i][k] == doctest::Approx(-slope).scale(1.0).epsilon(1e-4));
        }
    // At the positions themselves: the same function.
    std::vector<Vec3> own(samples.size()), elsewhere(samples.size()), positions;
    std::vector<double> lengths;
    for (const SurfaceSample& s : samples) {
        positions.push_back(s.position);
        lengths.push_back(0.5 * s.width);
    }
    field.gradient(own);
    field.evaluate_gradient(positions, lengths, elsewhere);
    for (std::size_t i = 0; i < own.size(); ++i)
        CHECK((own[i] - elsewhere[i]).norm() < 1e-4 * own[i].norm());
}

TEST_CASE("winding field: the adjoint is one, <A mu, r> = <mu, A^T r>") {
    const std::vector<SurfaceSample> samples = samples_of(cube(700));
    for (const double opening : {0.0, 0.5}) {
        WindingField field = field_of(samples, opening);
        dsc::RandomStream random({8, 0, 0, 0});
        std::vector<Vec3> mu(samples.size()), g(samples.size());
        std::vector<double> r(samples.size()), w(samples.size());
        for (std::size_t i = 0; i < mu.size(); ++i) {
            mu[i] = samples[i].area * (1.0 + random.uniform());
            r[i] = 1.0 + random.uniform();
        }
        field.set_vectors(mu);
        field.winding(w);
        field.adjoint(r, g);
        double right = 0.0;
        for (std::size_t i = 0; i < mu.size(); ++i) right += mu[i].dot(g[i]);
        const double left = dot(w, r);
        CHECK(std::abs(left - right) < (opening > 0.0 ? 0.1 : 1e-5) * std::abs(left));
        CHECK(std::abs(left) > 100.0);
        // The vectors stay what they were.
        std::vector<double> again(w.size());
        field.winding(again);
        CHECK(again == w);
    }
}

TEST_CASE("winding field: the number of threads changes no bit") {
    const std::vector<SurfaceSample> samples = samples_of(torus(4000));
    const std::vector<Vec3> points = places(3000, 1.6);
    const auto all = [&](dsc::Workers* workers) {
        WindingField field = winding_field(samples);
        std::vector<double> w(points.size()), own(samples.size());
        std::vector<Vec3> g(points.size()), adjoint(samples.size()), gradient(samples.size());
        field.evaluate(points, {}, w, workers);
        field.evaluate_gradient(points, {}, g, workers);
        field.winding(own, workers);
        field.adjoint(own, adjoint, workers);
        field.gradient(gradient, workers);
        g.insert(g.end(), adjoint.begin(), adjoint.end());
        g.insert(g.end(), gradient.begin(), gradient.end());
        w.insert(w.end(), own.begin(), own.end());
        return std::make_pair(w, g);
    };
    const auto one = all(nullptr);
    for (const unsigned threads : {2U, 3U}) {
        dsc::Workers workers(threads);
        CHECK(all(&workers) == one);
    }
}

TEST_CASE("winding field: moved and scaled clouds have the same field") {
    const Solid solid = torus(2000);
    const std::vector<Vec3> points = places(500, 1.6);
    std::vector<double> w(points.size());
    winding_field(samples_of(solid)).evaluate(points, {}, w);
    const auto check = [&](double scale, const Vec3& shift) {
        std::vector<SurfaceSample> samples = samples_of(solid);
        for (SurfaceSample& s : samples)
            s = {scale * s.position + shift, scale * scale * s.area, scale * s.width};
        std::vector<Vec3> there(points);
        for (Vec3& p : there) p = scale * p + shift;
        std::vector<double> found(points.size());
        std::vector<Vec3> gradients(points.size());
        const WindingField field = winding_field(samples);
        field.evaluate(there, {}, found);
        field.evaluate_gradient(there, {}, gradients);
        for (std::size_t i = 0; i < w.size(); ++i) {
            CHECK(std::abs(found[i] - w[i]) < 1e-3);
            CHECK(gradients[i].allFinite());
        }
    };
    check(1e-6, Vec3::Zero());
    check(1e6, Vec3::Zero());
    check(1.0, Vec3(5e6, -5e6, 5e6));
}

TEST_CASE("winding field: a target on a source, equal sources, one source") {
    const std::vector<Vec3> equal(40, Vec3(1, 2, 3));
    const std::vector<double> weights(40, 1.0);
    WindingField field(equal, weights);
    field.set_vectors(std::vector<Vec3>(40, Vec3::UnitX()));
    std::vector<double> w(40);
    std::vector<Vec3> g(40);
    field.winding(w);
    field.evaluate_gradient(equal, {}, g);
    for (std::size_t i = 0; i < w.size(); ++i) {
        CHECK(w[i] == 0.0);
        CHECK(g[i].allFinite());
    }
    CHECK_THROWS_AS(WindingField({}, {}), dsc::GeometryError);
    const std::vector<Vec3> bad(1, Vec3(0, std::numeric_limits<double>::quiet_NaN(), 0));
    CHECK_THROWS_AS(WindingField(bad, std::vector<double>(1, 1.0)), dsc::GeometryError);
    CHECK_THROWS_AS(field.evaluate(bad, {}, w), dsc::GeometryError);
}

// The order of all operations, spelled out. It holds for whichever registers this machine has, so
// all give the same bits.
TEST_CASE("winding kernels: eight sums side by side, added up in one order") {
    dsc::RandomStream random({4, 0, 0, 0});
    WindingSources sources;
    sources.resize(37);
    for (std::size_t q = 0; q < winding_quantities; ++q)
        for (std::size_t n = 0; n < 37; ++n)
            sources.column(q)[n] =
                static_cast<float>(q == 3 ? 0.01 * random.uniform() : random.uniform());
    CHECK(sources.count() == 40);
    const WindingTarget target{0.3F, 0.6F, 0.2F, 0.001F};
    std::array<std::array<float, 8>, 7> sums{};
    for (std::size_t n = 0; n < sources.count(); ++n) {
        const std::array<float, 3> d{sources[0][n] - target.x, sources[1][n] - target.y,
                                     sources[2][n] - target.z};
        const std::array<float, 3> v{sources[4][n], sources[5][n], sources[6][n]};
        const float inverse_square =
            1.0F / (d[0] * d[0] + d[1] * d[1] + d[2] * d[2] + (sources[3][n] + target.half_square));
        const float inverse_cube = inverse_square * std::sqrt(inverse_square);
        const float dot_product = v[0] * d[0] + v[1] * d[1] + v[2] * d[2];
        sums[0][n % 8] += dot_product * inverse_cube;
        for (std::size_t k = 0; k < 3; ++k) {
            sums[1 + k][n % 8] -= v[0] * inverse_cube * d[k];
            sums[4 + k][n % 8] +=
                (v[k] - 3.0F * dot_product * inverse_square * d[k]) * inverse_cube;
        }
    }
    std::array<float, 7> total{};
    for (std::size_t k = 0; k < 7; ++k) {
        const auto& s = sums[k];
        total[k] = ((s[0] + s[4]) + (s[2] + s[6])) + ((s[1] + s[5]) + (s[3] + s[7]));
    }
    CHECK(sum_winding(sources, target) == total[0]);
    CHECK(sum_adjoint(sources, target) == std::array<float, 3>{total[1], total[2], total[3]});
    CHECK(sum_gradient(sources, target) == std::array<float, 3>{total[4], total[5], total[6]});
}
