#pragma once
// Finds area vectors whose winding number is 1/2 at their own positions and whose directions agree
// with its gradient [Lin2024].

#include <cstddef>
#include <span>
#include <vector>

#include <dsc/base/progress.hpp>
#include <dsc/base/workers.hpp>
#include <dsc/cloud/winding_field.hpp>

namespace dsc::cloud {

/// Smoothing lengths, in widths, decrease geometrically from `first` to `last`.
struct ConsistencySchedule {
    std::size_t iterations = 1;
    double first = 1.0, last = 1.0;
};

/// The side that a sensor saw, per vector: a vector never turns away from it. Zero: any side.
/// Empty: any side for all.
using Sides = std::span<const Vec3>;

/// Improves `vectors` by steps of steepest descent on |1/2 - A mu|^2, each with the best step
/// length. After each step every vector turns to the direction of the field's negative gradient and
/// keeps its length. The field keeps the last smoothing and the result. Returns the root mean
/// square of 1/2 - A mu at the beginning of the last iteration. Throws CancelledError. [setup]
double make_consistent(WindingField& field, std::span<const double> widths,
                       const ConsistencySchedule& schedule, std::vector<Vec3>& vectors,
                       Workers* workers, const CancelToken* cancel, Sides sides = {});

/// Root mean square of 1/2 - w.
double winding_residual(std::span<const double> w);

/// Sets the smoothing of every position to `factor` times its width.
void set_smoothing(WindingField& field, std::span<const double> widths, double factor);

}  // namespace dsc::cloud
