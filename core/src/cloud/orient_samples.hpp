#pragma once
// The fine stage of an orientation, started from normals of the samples instead of a coarse stage.

#include <cstddef>
#include <span>

#include <dsc/cloud/orientation.hpp>

#include "samples.hpp"

namespace dsc::cloud {

struct StartOptions {
    std::size_t iterations = 12;
    bool hold_sides = false;  ///< no normal turns away from its given side
};

/// `given`: a unit vector or zero per sample. The result does not contain the noise of the given
/// directions. Throws CancelledError. [setup]
OrientedPoints orient_samples_from(const ScaledSamples& samples, std::span<const Vec3> points,
                                   std::span<const Vec3> given, const StartOptions& options,
                                   Workers* workers, const CancelToken* cancel);

}  // namespace dsc::cloud
