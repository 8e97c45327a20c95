// Winding number normal consistency [Lin2024]: descent steps and turns.
#include "normal_consistency.hpp"

#include <cmath>

#include <dsc/base/error.hpp>

namespace dsc::cloud {

namespace {

/// Factor of the widths in iteration t. Rounded to float, because libraries differ in the last bit
/// of pow.
double smoothing_at(const ConsistencySchedule& schedule, std::size_t t) {
    if (schedule.iterations <= 1) return schedule.last;
    const double share = static_cast<double>(t) / static_cast<double>(schedule.iterations - 1);
    return static_cast<double>(
        static_cast<float>(schedule.first * std::pow(schedule.last / schedule.first, share)));
}

/// Working arrays of an iteration, allocated once.
struct Buffers {
    explicit Buffers(std::size_t count) : w(count), r(count), direction(count) {}
    std::vector<double> w, r;
    std::vector<Vec3> direction;
};

/// mu += s g with g = A^T r and the s that minimises |r - s A g|. Returns the root mean square of
/// r.
double descend(WindingField& field, std::vector<Vec3>& vectors, Buffers& buffers,
               Workers* workers) {
    field.winding(buffers.w, workers);
    const double residual = winding_residual(buffers.w);
    for (std::size_t i = 0; i < vectors.size(); ++i) buffers.r[i] = 0.5 - buffers.w[i];
    field.adjoint(buffers.r, buffers.direction, workers);
    field.set_vectors(buffers.direction);
    field.winding(buffers.w, workers);
    double along = 0.0, square = 0.0;
    for (std::size_t i = 0; i < vectors.size(); ++i) {
        along += buffers.r[i] * buffers.w[i];
        square += buffers.w[i] * buffers.w[i];
    }
    const double step = square > 0.0 ? along / square : 0.0;
    for (std::size_t i = 0; i < vectors.size(); ++i) vectors[i] += step * buffers.direction[i];
    field.set_vectors(vectors);
    return residual;
}

void turn_to_gradient(WindingField& field, std::vector<Vec3>& vectors, Sides sides,
                      Buffers& buffers, Workers* workers) {
    field.gradient(buffers.direction, workers);
    for (std::size_t i = 0; i < vectors.size(); ++i) {
        if (!sides.empty() && buffers.direction[i].dot(sides[i]) < 0.0)
            buffers.direction[i] = sides[i];
        const double length = buffers.direction[i].norm();
        if (length > 0.0) vectors[i] = buffers.direction[i] * (vectors[i].norm() / length);
    }
    field.set_vectors(vectors);
}

}  // namespace

double winding_residual(std::span<const double> w) {
    double sum = 0.0;
    for (const double value : w) sum += (0.5 - value) * (0.5 - value);
    return w.empty() ? 0.0 : std::sqrt(sum / static_cast<double>(w.size()));
}

void set_smoothing(WindingField& field, std::span<const double> widths, double factor) {
    std::vector<double> lengths(widths.begin(), widths.end());
    for (double& length : lengths) length *= factor;
    field.set_smoothing(lengths);
}

double make_consistent(WindingField& field, std::span<const double> widths,
                       const ConsistencySchedule& schedule, std::vector<Vec3>& vectors,
                       Workers* workers, const CancelToken* cancel, Sides sides) {
    Buffers buffers(vectors.size());
    field.set_vectors(vectors);
    double residual = 0.0;
    for (std::size_t t = 0; t < schedule.iterations; ++t) {
        if (cancel != nullptr && cancel->cancelled())
            throw CancelledError("the run was stopped while it oriented the cloud");
        set_smoothing(field, widths, smoothing_at(schedule, t));
        residual = descend(field, vectors, buffers, workers);
        turn_to_gradient(field, vectors, sides, buffers, workers);
    }
    return residual;
}

}  // namespace dsc::cloud
