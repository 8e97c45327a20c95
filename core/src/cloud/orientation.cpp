// Orients a cloud from its points alone, in a coarse and a fine stage [Lin2024].
#include "dsc/cloud/orientation.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>

#include <dsc/base/error.hpp>
#include <dsc/cloud/normalize.hpp>
#include <dsc/cloud/statistics.hpp>
#include <dsc/cloud/winding_field.hpp>
#include <dsc/text/words.hpp>

#include "cells.hpp"
#include "checks.hpp"
#include "normal_consistency.hpp"
#include "one_sided.hpp"
#include "orient_samples.hpp"
#include "samples.hpp"

namespace dsc::cloud {

namespace {

constexpr double most_representatives = 8000.0;
constexpr std::size_t few_samples = 10000;  // up to this number every sample is a representative
constexpr double coarse_first = 6.0, coarse_last = 1.0;
constexpr double fine_first = 2.0, fine_last = 0.5, fine_last_noisy = 1.1;
constexpr double field_smoothing = 0.5;    // of the finished field
constexpr double normal_smoothing = 0.7;   // for reading normals between the samples
constexpr double far_from_surface = 0.45;  // |w - 1/2| of samples inside or outside
constexpr double off_and_apart = 0.3;      // the same if the point is also far from its neighbours
constexpr double apart_factor = 1.25;
constexpr std::size_t width_neighbours = 12;
constexpr double unit_tolerance = 1e-6;

std::vector<double> squares_of(std::span<const double> widths) {
    std::vector<double> out(widths.begin(), widths.end());
    for (double& width : out) width *= width;
    return out;
}

Vec3 direction_or(const Vec3& v, const Vec3& other) {
    const double length = v.norm();
    return length > 0.0 && std::isfinite(length) ? Vec3(v / length) : other;
}

/// Samples of the coarse stage.
struct Representatives {
    std::vector<Vec3> positions;
    std::vector<double> widths, weights;
    double edge = 0.0;  ///< of the cells whose means they are; 0 if they are the samples
};

Representatives representatives_of(const ScaledSamples& samples, bool all, Workers* workers) {
    Representatives out;
    if (all || samples.size() <= few_samples) {
        out.positions = samples.positions;
        out.widths = samples.widths;
        out.weights = squares_of(samples.widths);
        return out;
    }
    out.edge =
        samples.width * std::sqrt(1.5 * static_cast<double>(samples.size()) / most_representatives);
    const Cells cells = cells_of(samples.positions, out.edge);
    out.positions = means_of(cells, samples.positions);
    out.weights.assign(out.positions.size(), 0.0);
    for (std::size_t i = 0; i < samples.size(); ++i)
        out.weights[cells.of_point[i]] += samples.widths[i] * samples.widths[i];
    out.widths = label_widths(find_neighbours(out.positions, reach_neighbours, workers), workers);
    return out;
}

/// Both stages, and their results for the samples.
class Orienter {
public:
    Orienter(const ScaledSamples& samples, Workers* workers, const CancelToken* cancel)
        : vectors(samples.size(), Vec3::Zero()),
          w(samples.size()),
          dropped(samples.size(), false),
          samples_(samples),
          field_(samples.positions, squares_of(samples.widths)),
          workers_(workers),
          cancel_(cancel) {}

    void coarse(const OrientOptions& options) {
        const Representatives chosen = representatives_of(samples_, options.all_points, workers_);
        representatives = chosen.positions.size();
        std::vector<Vec3> found(representatives, Vec3::Zero());
        WindingField field(chosen.positions, chosen.weights);
        coarse_residual = make_consistent(field, chosen.widths,
                                          {options.coarse_iterations, coarse_first, coarse_last},
                                          found, workers_, cancel_);
        std::vector<double> smoothing(samples_.widths);
        for (double& length : smoothing) length = std::max(length, 0.5 * chosen.edge);
        field.evaluate_gradient(samples_.positions, smoothing, vectors, workers_);
        for (std::size_t i = 0; i < vectors.size(); ++i)
            vectors[i] = direction_or(vectors[i], samples_.normals[i]) *
                         (samples_.widths[i] * samples_.widths[i]);
    }

    /// Instead of the coarse stage: the planes' normals, turned towards the place of recording. In
    /// the copy, which consists of the points from `first_copy` on, they are turned away from it.
    void face_recorder(const Vec3& away, std::size_t first_copy) {
        std::vector<std::uint8_t> copied(samples_.size(), 0);
        for (std::size_t i = first_copy; i < samples_.of_point.size(); ++i)
            copied[samples_.of_point[i]] = 1;
        for (std::size_t s = 0; s < vectors.size(); ++s) {
            const bool along = samples_.normals[s].dot(away) > 0.0;
            const double area = samples_.widths[s] * samples_.widths[s];
            vectors[s] = (along == (copied[s] != 0) ? area : -area) * samples_.normals[s];
        }
    }

    void fine(std::size_t iterations) {
        residual = make_consistent(
            field_, samples_.widths,
            {iterations, fine_first, samples_.noisy() ? fine_last_noisy : fine_last}, vectors,
            workers_, cancel_, sides_);
        measure_winding();
    }

    /// Sets vectors along unit normals of the samples, or zero; their lengths are the samples'
    /// areas.
    void start_from(std::span<const Vec3> given) {
        for (std::size_t s = 0; s < vectors.size(); ++s)
            vectors[s] = given[s] * (samples_.widths[s] * samples_.widths[s]);
    }

    /// Fixes every vector to its present side.
    void hold_sides() { sides_ = vectors; }

    /// w at the samples, from the present vectors.
    void measure_winding() {
        set_smoothing(field_, samples_.widths, field_smoothing);
        field_.set_vectors(vectors);
        field_.winding(w, workers_);
    }

    void drop_outliers() {
        const std::vector<double> around = median_reaches(samples_.neighbours, workers_);
        for (std::size_t i = 0; i < w.size(); ++i) {
            const double off = std::abs(w[i] - 0.5);
            dropped[i] =
                off > far_from_surface ||
                (off > off_and_apart && samples_.neighbours.reach[i] > apart_factor * around[i]);
        }
    }

    /// Turns the vectors towards the normals of the planes; `agreement` is the absolute cosine
    /// between the two.
    void refine_directions() {
        agreement.resize(vectors.size());
        for (std::size_t i = 0; i < vectors.size(); ++i) {
            const double length = vectors[i].norm();
            const Vec3 normal = direction_or(vectors[i], samples_.normals[i]);
            const double cosine = normal.dot(samples_.normals[i]);
            agreement[i] = std::min(1.0, std::abs(cosine));
            Vec3 turned = normal;
            if (agreement[i] > 0.5) {
                const Vec3 plane = cosine < 0.0 ? Vec3(-samples_.normals[i]) : samples_.normals[i];
                turned = samples_.noisy() ? plane : Vec3((normal + plane).normalized());
            }
            normals.push_back(turned);
            vectors[i] = turned * length;
            if (dropped[i]) vectors[i].setZero();
        }
    }

    /// Normals between the samples.
    std::vector<Vec3> normals_at(std::span<const Vec3> places,
                                 std::span<const std::uint32_t> sample) {
        set_smoothing(field_, samples_.widths, normal_smoothing);
        field_.set_vectors(vectors);
        std::vector<double> smoothing(places.size());
        for (std::size_t i = 0; i < places.size(); ++i)
            smoothing[i] = normal_smoothing * samples_.widths[sample[i]];
        std::vector<Vec3> out(places.size());
        field_.evaluate_gradient(places, smoothing, out, workers_);
        for (std::size_t i = 0; i < places.size(); ++i)
            out[i] = direction_or(out[i], normals[sample[i]]);
        return out;
    }

    std::vector<Vec3> vectors;
    std::vector<Vec3> normals;
    std::vector<double> w;
    std::vector<double> agreement;
    std::vector<bool> dropped;
    double coarse_residual = 0.0, residual = 0.0;
    std::size_t representatives = 0;

private:
    const ScaledSamples& samples_;
    WindingField field_;
    Workers* workers_;
    const CancelToken* cancel_;
    std::vector<Vec3> sides_;
};

Orientation orientation_of(const ScaledSamples& samples, std::span<const Vec3> points,
                           const Orienter& found) {
    Orientation out;
    const double area = samples.diagonal * samples.diagonal;
    for (std::size_t s = 0; s < samples.size(); ++s) {
        if (found.dropped[s]) continue;
        const Vec3 position = samples.clustered
                                  ? Vec3(samples.positions[s] * samples.diagonal + samples.centre)
                                  : points[samples.first_point[s]];
        out.samples.push_back(
            {position, found.vectors[s] * area, samples.widths[s] * samples.diagonal});
    }
    out.residual = found.residual;
    out.noise = samples.noise * samples.diagonal;
    out.all_points = found.representatives == samples.size();
    return out;
}

/// Normals, areas and confidence of the given points; `normals` in the order of the points.
OrientedPoints spread(const ScaledSamples& samples, std::vector<Vec3> normals,
                      const Orienter& found) {
    OrientedPoints out;
    out.normals = std::move(normals);
    out.areas.resize(out.normals.size());
    out.confidence.resize(out.normals.size());
    const double area = samples.diagonal * samples.diagonal;
    for (std::size_t i = 0; i < out.normals.size(); ++i) {
        const std::size_t s = samples.of_point[i];
        out.areas[i] = out.normals[i] *
                       (found.vectors[s].norm() * area / static_cast<double>(samples.counts[s]));
        if (found.dropped[s]) continue;
        const double on_surface = std::clamp(1.0 - 2.0 * std::abs(found.w[s] - 0.5), 0.0, 1.0);
        out.confidence[i] = on_surface * (found.agreement.empty() ? 1.0 : found.agreement[s]);
    }
    out.representatives = found.representatives;
    out.dropped =
        static_cast<std::size_t>(std::count(found.dropped.begin(), found.dropped.end(), true));
    out.coarse_residual = found.coarse_residual;
    return out;
}

/// Normals of the given points, scaled to the samples' units if they are not the samples
/// themselves.
std::vector<Vec3> point_normals(const ScaledSamples& samples, std::span<const Vec3> points,
                                Orienter& found) {
    std::vector<Vec3> out(points.size());
    if (samples.clustered) {
        for (std::size_t i = 0; i < points.size(); ++i)
            out[i] = (points[i] - samples.centre) / samples.diagonal;
        return found.normals_at(out, samples.of_point);
    }
    for (std::size_t i = 0; i < points.size(); ++i) out[i] = found.normals[samples.of_point[i]];
    return out;
}

/// The fine stage and its results for the points.
OrientedPoints finished(const ScaledSamples& samples, std::span<const Vec3> points,
                        Orienter& orienter, std::size_t iterations) {
    orienter.fine(iterations);
    orienter.drop_outliers();
    orienter.refine_directions();
    OrientedPoints out = spread(samples, point_normals(samples, points, orienter), orienter);
    out.orientation = orientation_of(samples, points, orienter);
    return out;
}

/// Orients the points together with a copy of them. The result contains the samples of both; all
/// other entries are for the points only.
OrientedPoints orient_backed(std::span<const Vec3> points, const Vec3& backing,
                             const OrientOptions& options, Workers* workers,
                             const CancelToken* cancel) {
    const std::vector<Vec3> all = with_copy(points, backing);
    const ScaledSamples samples = scaled_samples(all, workers);
    Orienter orienter(samples, workers, cancel);
    orienter.face_recorder(backing, points.size());
    OrientedPoints out = finished(samples, all, orienter, options.fine_iterations);
    leave_out_copy(points.size(), backing, out);
    return out;
}

}  // namespace

OrientedPoints orient_points(std::span<const Vec3> points, const OrientOptions& options,
                             Workers* workers, const CancelToken* cancel, std::string_view name) {
    require_volume(points, name);
    const ScaledSamples samples = scaled_samples(points, workers);
    const Vec3 backing = options.backing ? *options.backing
                                         : backing_of(samples, -samples.centre / samples.diagonal);
    if (backing != Vec3::Zero()) return orient_backed(points, backing, options, workers, cancel);
    Orienter orienter(samples, workers, cancel);
    orienter.coarse(options);
    return finished(samples, points, orienter, options.fine_iterations);
}

OrientedPoints orient_samples_from(const ScaledSamples& samples, std::span<const Vec3> points,
                                   std::span<const Vec3> given, const StartOptions& options,
                                   Workers* workers, const CancelToken* cancel) {
    Orienter orienter(samples, workers, cancel);
    orienter.start_from(given);
    if (options.hold_sides) orienter.hold_sides();
    OrientedPoints out = finished(samples, points, orienter, options.iterations);
    out.orientation.all_points = true;  // a coarse stage would lose the initial directions
    return out;
}

OrientedPoints orient_by_normals(std::span<const Vec3> points, std::span<const Vec3> normals,
                                 Workers* workers, const CancelToken* cancel,
                                 std::string_view name) {
    require_volume(points, name);
    if (normals.size() != points.size())
        throw GeometryError("cloud.normals", named(name),
                            "there are " + text::counted(normals.size(), "normal") + " for " +
                                text::counted(points.size(), "point"),
                            "let the filter orient estimate them");
    std::vector<Vec3> unit(normals.size());
    for (std::size_t i = 0; i < normals.size(); ++i) {
        // then every bit is kept
        const bool already = std::abs(normals[i].squaredNorm() - 1.0) < unit_tolerance;
        unit[i] = already ? normals[i] : direction_or(normals[i], Vec3::Zero());
        if (unit[i].isZero(0.0))
            throw GeometryError("cloud.normals", named(name),
                                fmt::format("the normal of point {} has no direction", i),
                                "let the filter orient estimate the normals");
    }
    if (cancel != nullptr && cancel->cancelled())
        throw CancelledError("the run was stopped while it oriented the cloud");
    const ScaledSamples samples = scaled_samples(points, workers);
    Orienter orienter(samples, workers, cancel);
    for (std::size_t i = 0; i < points.size(); ++i)
        orienter.vectors[samples.of_point[i]] += unit[i];
    const Neighbours& around = samples.neighbours;
    for (std::size_t s = 0; s < samples.size(); ++s) {
        const std::size_t last = std::min(width_neighbours, around.each);
        const double reach =
            (samples.positions[around.of(s)[last - 1]] - samples.positions[s]).norm();
        const double width = width_of(reach, static_cast<double>(last));
        orienter.vectors[s] =
            direction_or(orienter.vectors[s], unit[samples.first_point[s]]) * (width * width);
    }
    orienter.measure_winding();
    orienter.residual = winding_residual(orienter.w);
    OrientedPoints out = spread(samples, std::move(unit), orienter);
    out.orientation = orientation_of(samples, points, orienter);
    out.orientation.all_points = true;  // a finer stage would not change given normals
    return out;
}

}  // namespace dsc::cloud
