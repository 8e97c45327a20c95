// Orients a cloud by the normals of its file or by the position of its scanner.
#include "dsc/cloud/given_normals.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <dsc/cloud/normalize.hpp>
#include <dsc/cloud/search.hpp>
#include <dsc/cloud/winding_field.hpp>
#include <dsc/text/numbers.hpp>

#include "normal_consistency.hpp"
#include "one_sided.hpp"
#include "orient_samples.hpp"

namespace dsc::cloud {

namespace {

constexpr double least_present = 0.9;   // fraction of points with a normal
constexpr double least_standing = 0.8;  // fraction of flat places where the normal is perpendicular
                                        // to the plane
constexpr double least_agreeing = 0.95;   // fraction of pairs with the same sign: real files have
                                          // some wrong signs at rims
constexpr double seen_agreeing = 0.99;    // the same for normals towards a true scanner position,
                                          // which are right even at rims
constexpr double sides_agreeing = 0.998;  // above this fraction the signs are kept fixed
constexpr double least_kept = 0.9;    // fraction of signs that the winding field leaves unchanged
constexpr double most_dropped = 0.2;  // fraction of samples that fixed signs may leave inside or
                                      // outside
constexpr double most_behind = 0.05;  // fraction of neighbours in the view that lie far behind each
                                      // other
constexpr double far_behind = 10.0;   // that distance, in widths; for a slanted surface it is the
                                      // reciprocal of the cosine
constexpr double inwards = -0.1;     // mean winding number below which normals point into the solid
constexpr double closed = 0.3;       // mean winding number above which a short iteration is enough
constexpr double flat_cosine = 0.9;  // of the planes round a flat place
constexpr double standing_cosine = 0.7;
constexpr double one_piece_cosine = 0.8;  // between the planes of two neighbours on one piece of
                                          // surface
constexpr double one_piece_offset = 0.3;  // largest offset of a neighbour from the plane, over its
                                          // distance
constexpr std::size_t pair_neighbours = 6;
constexpr std::size_t view_neighbours = 4;
constexpr double checked_smoothing = 0.5;

double share_of(std::size_t part, std::size_t all) {
    return all == 0 ? 1.0 : static_cast<double>(part) / static_cast<double>(all);
}

std::string percent(double share) {
    return text::rounded(std::round(1000.0 * share) / 10.0) + " %";
}

/// Places where at most a quarter of the neighbours have a turned plane: not on creases, at corners
/// or in thick noise.
std::vector<std::uint8_t> flat_places(const ScaledSamples& samples) {
    std::vector<std::uint8_t> flat(samples.size());
    std::vector<double> cosines;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        cosines.clear();
        for (const std::uint32_t j : samples.neighbours.of(i))
            cosines.push_back(std::abs(samples.normals[i].dot(samples.normals[j])));
        const auto quarter = cosines.begin() + static_cast<std::ptrdiff_t>(cosines.size() / 4);
        std::nth_element(cosines.begin(), quarter, cosines.end());
        flat[i] = *quarter > flat_cosine ? 1 : 0;
    }
    return flat;
}

/// Agreement of the samples' normals with the planes and with each other, at the flat places.
struct Agreement {
    double standing = 1.0;  ///< fraction of places where the normal is perpendicular to the plane
    double agreeing = 1.0;  ///< fraction of neighbours on one piece of surface whose normals have
                            ///< the same sign
};

Agreement agreement_of(const ScaledSamples& samples, const std::vector<Vec3>& normals) {
    const std::vector<std::uint8_t> flat = flat_places(samples);
    const auto one_piece = [&](std::size_t i, std::size_t j) {
        const Vec3 d = samples.positions[j] - samples.positions[i];
        return flat[j] != 0 && !normals[j].isZero(0.0) &&
               std::abs(samples.normals[i].dot(samples.normals[j])) > one_piece_cosine &&
               std::abs(d.dot(samples.normals[i])) < one_piece_offset * d.norm();
    };
    std::size_t places = 0, standing = 0, pairs = 0, agreeing = 0;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        if (flat[i] == 0 || normals[i].isZero(0.0)) continue;
        ++places;
        standing += std::abs(normals[i].dot(samples.normals[i])) > standing_cosine ? 1U : 0U;
        const auto around = samples.neighbours.of(i);
        for (const std::uint32_t j : around.first(std::min(pair_neighbours, around.size()))) {
            if (!one_piece(i, j)) continue;
            ++pairs;
            agreeing += normals[i].dot(normals[j]) > 0.0 ? 1U : 0U;
        }
    }
    return {share_of(standing, places), share_of(agreeing, pairs)};
}

/// The mean of w at the samples: 1/2 for a closed solid with normals that point outwards, -1/2 with
/// inward normals, near 0 if they bound nothing.
double mean_winding(const ScaledSamples& samples, const std::vector<Vec3>& normals,
                    Workers* workers) {
    std::vector<double> areas(samples.widths), w(samples.size());
    std::vector<Vec3> vectors(normals);
    for (std::size_t i = 0; i < areas.size(); ++i) {
        areas[i] *= areas[i];
        vectors[i] *= areas[i];
    }
    WindingField field(samples.positions, areas);
    set_smoothing(field, samples.widths, checked_smoothing);
    field.set_vectors(vectors);
    field.winding(w, workers);
    double sum = 0.0;
    for (const double value : w) sum += value;
    return sum / static_cast<double>(w.size());
}

void turn(std::vector<Vec3>& normals) {
    for (Vec3& normal : normals) normal = -normal;
}

/// Fraction of points whose normal still has the given sign.
double kept_share(const ScaledSamples& samples, const std::vector<Vec3>& given,
                  const OrientedPoints& found) {
    std::size_t kept = 0, all = 0;
    for (std::size_t i = 0; i < found.normals.size(); ++i) {
        const Vec3& normal = given[samples.of_point[i]];
        if (normal.isZero(0.0)) continue;
        ++all;
        kept += found.normals[i].dot(normal) > 0.0 ? 1U : 0U;
    }
    return share_of(kept, all);
}

std::vector<Vec3> normals_of_samples(const ScaledSamples& samples,
                                     const std::vector<Vec3>& normals) {
    std::vector<Vec3> out(samples.size(), Vec3::Zero());
    for (std::size_t i = 0; i < normals.size(); ++i) out[samples.of_point[i]] += normals[i];
    for (Vec3& normal : out) {
        const double length = normal.norm();
        if (length > 0.0) normal /= length;
    }
    return out;
}

/// Normals of the planes, turned towards a place in scaled units.
std::vector<Vec3> normals_towards(const ScaledSamples& samples, const Vec3& place) {
    std::vector<Vec3> out(samples.normals);
    for (std::size_t i = 0; i < out.size(); ++i)
        if (out[i].dot(place - samples.positions[i]) < 0.0) out[i] = -out[i];
    return out;
}

/// Fraction of the samples' neighbours, in the view from a place, that lie far from them: if the
/// scanner was elsewhere, the back of a solid appears behind its front.
double behind_share(const ScaledSamples& samples, const Vec3& place) {
    std::vector<Vec3> directions;
    directions.reserve(samples.size());
    for (const Vec3& p : samples.positions) {
        const Vec3 ray = p - place;
        const double length = ray.norm();
        directions.push_back(length > 0.0 ? Vec3(ray / length) : Vec3(Vec3::UnitZ()));
    }
    const NearestSearch search(directions);
    std::vector<Neighbour> around;
    std::size_t behind = 0, all = 0;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        search.k_nearest(directions[i], view_neighbours + 1, around);
        for (const Neighbour& n : around) {
            if (n.index == i) continue;
            ++all;
            behind += (samples.positions[n.index] - samples.positions[i]).norm() >
                              far_behind * samples.widths[i]
                          ? 1U
                          : 0U;
        }
    }
    return share_of(behind, all);
}

double dropped_share(const OrientedPoints& found) {
    return share_of(found.dropped, found.dropped + found.orientation.samples.size());
}

/// The displacement of the copy that closes a cloud of one layer (Orientation::backing), along
/// `away`; zero for a cloud that needs none. `place`: possible position of the scanner, in scaled
/// units.
Vec3 backing_along(const Vec3& away, const ScaledSamples& samples, const Vec3& place,
                   const OrientOptions& options) {
    return options.backing ? *options.backing : backing_of(samples, place, Vec3(away.normalized()));
}

/// The sum of the view directions from a place: a copy moved along it lies behind everything that
/// is visible from there.
Vec3 view_from(const ScaledSamples& samples, const Vec3& place) {
    Vec3 sum = Vec3::Zero();
    for (const Vec3& p : samples.positions) sum += (p - place).normalized();
    return sum;
}

Vec3 sum_of(const std::vector<Vec3>& vectors) {
    Vec3 sum = Vec3::Zero();
    for (const Vec3& v : vectors) sum += v;
    return sum;
}

/// orient_samples_from, with a moved copy of the points with opposite normals unless `backing` is
/// zero.
OrientedPoints orient_with_backing(const ScaledSamples& samples, std::span<const Vec3> points,
                                   const std::vector<Vec3>& given, const Vec3& backing,
                                   const StartOptions& options, Workers* workers,
                                   const CancelToken* cancel) {
    if (backing.isZero(0.0))
        return orient_samples_from(samples, points, given, options, workers, cancel);
    const std::vector<Vec3> all = with_copy(points, backing);
    std::vector<Vec3> normals;
    normals.reserve(all.size());
    for (std::size_t i = 0; i < points.size(); ++i) normals.push_back(given[samples.of_point[i]]);
    for (std::size_t i = 0; i < points.size(); ++i) normals.emplace_back(-normals[i]);
    const ScaledSamples both = scaled_samples(all, workers);
    OrientedPoints out =
        orient_samples_from(both, all, normals_of_samples(both, normals), options, workers, cancel);
    leave_out_copy(points.size(), backing, out);
    return out;
}

}  // namespace

GivenOrientation orient_by_file_normals(const Cloud& cloud, const OrientOptions& options,
                                        Workers* workers, const CancelToken* cancel) {
    GivenOrientation out;
    if (cloud.normals.size() != cloud.points.size()) return out;
    require_volume(cloud.points, cloud.source);
    const auto refuse = [&](const std::string& why) {
        out.note = "The normals of the file are not used, because " + why + ".";
        return out;
    };
    const auto without = std::count_if(cloud.normals.begin(), cloud.normals.end(),
                                       [](const Vec3& n) { return n.isZero(0.0); });
    const double present = 1.0 - share_of(static_cast<std::size_t>(without), cloud.normals.size());
    out.figures.emplace_back("normals_present", present);
    if (present < least_present) return refuse(percent(1.0 - present) + " of the points have none");

    const ScaledSamples samples = scaled_samples(cloud.points, workers);
    std::vector<Vec3> given = normals_of_samples(samples, cloud.normals);
    const Agreement agreement = agreement_of(samples, given);
    out.figures.emplace_back("normals_standing", agreement.standing);
    out.figures.emplace_back("normals_agreeing", agreement.agreeing);
    if (agreement.standing < least_standing)
        return refuse("at " + percent(1.0 - agreement.standing) +
                      " of the flat places they are not perpendicular to the surface");
    if (agreement.agreeing < least_agreeing)
        return refuse(percent(1.0 - agreement.agreeing) +
                      " of neighbouring normals point to opposite sides");

    const double winding = mean_winding(samples, given, workers);
    out.figures.emplace_back("normals_winding", winding);
    const bool inverted = winding < inwards;
    if (inverted) turn(given);
    const std::string used =
        inverted
            ? "The normals of the file point into the solid; they are used with the opposite sign."
            : "The normals of the file are used.";
    const Vec3 backing =
        backing_along(-sum_of(given), samples, -samples.centre / samples.diagonal, options);
    const auto start = [&](std::size_t iterations, bool hold_sides) {
        return orient_with_backing(samples, cloud.points, given, backing, {iterations, hold_sides},
                                   workers, cancel);
    };
    if (agreement.agreeing >= sides_agreeing) {
        const bool is_closed = std::abs(winding) > closed || !backing.isZero(0.0);
        OrientedPoints held =
            start(is_closed ? options.fine_iterations : options.coarse_iterations, true);
        if (dropped_share(held) <= most_dropped) {
            out.figures.emplace_back("normals_kept", kept_share(samples, given, held));
            out.oriented = std::move(held);
            out.note = used;
            return out;
        }
    }
    OrientedPoints found = start(options.fine_iterations, false);
    const double kept = kept_share(samples, given, found);
    out.figures.emplace_back("normals_kept", kept);
    if (kept < least_kept)
        return refuse("together they bound no solid: " + percent(1.0 - kept) +
                      " contradict the others");
    out.oriented = std::move(found);
    out.note = used;
    return out;
}

GivenOrientation orient_by_sensor(const Cloud& cloud, const OrientOptions& options,
                                  Workers* workers, const CancelToken* cancel) {
    GivenOrientation out;
    if (!cloud.sensor) return out;
    require_volume(cloud.points, cloud.source);
    const Vec3& at = cloud.sensor->position;
    const bool stated = cloud.sensor->stated;
    if (!stated && bounding_box(cloud.points).contains(at)) return out;
    const ScaledSamples samples = scaled_samples(cloud.points, workers);
    const Vec3 place = (at - samples.centre) / samples.diagonal;
    const std::string viewpoint = "viewpoint " + text::rounded(at.x()) + " " +
                                  text::rounded(at.y()) + " " + text::rounded(at.z());
    const auto refuse = [&](const std::string& why) {
        if (stated)
            out.note = "The " + viewpoint + " of the file is not used, because " + why + ".";
        return out;
    };
    const double behind = behind_share(samples, place);
    out.figures.emplace_back("viewpoint_behind", behind);
    if (behind > most_behind)
        return refuse(percent(behind) +
                      " of the neighbouring points lie behind each other from there");
    const std::vector<Vec3> given = normals_towards(samples, place);
    const Agreement agreement = agreement_of(samples, given);
    out.figures.emplace_back("viewpoint_agreeing", agreement.agreeing);
    if (agreement.agreeing < seen_agreeing)
        return refuse(percent(1.0 - agreement.agreeing) +
                      " of neighbouring points show opposite sides to it");
    const double winding = mean_winding(samples, given, workers);
    out.figures.emplace_back("viewpoint_winding", winding);
    if (!stated && winding <= 0.0) return out;
    const Vec3 backing = backing_along(view_from(samples, place), samples, place, options);
    const std::size_t iterations =
        backing.isZero(0.0) ? options.coarse_iterations : options.fine_iterations;
    OrientedPoints found = orient_with_backing(samples, cloud.points, given, backing,
                                               {iterations, true}, workers, cancel);
    if (dropped_share(found) > most_dropped)
        return refuse(percent(dropped_share(found)) +
                      " of the points would then lie inside or outside");
    out.oriented = std::move(found);
    out.note =
        "Normals point towards the " + viewpoint + " of the file, from which all points were seen.";
    return out;
}

}  // namespace dsc::cloud
