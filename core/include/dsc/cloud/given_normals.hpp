#pragma once
// Orients a cloud by what its file says: by normals, or by the place of the scanner. Both are judged before they are trusted.

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <dsc/cloud/orientation.hpp>

namespace dsc::cloud {

/// What became of a file's normals or of its scanner's place.
struct GivenOrientation {
    std::optional<OrientedPoints> oriented{};  ///< empty where they are not used
    std::string note{};                        ///< one sentence that says what was done and why; empty where there is nothing to say
    std::vector<std::pair<std::string, double>> figures{};  ///< what the judgement rests on, as a filter reports figures
};

/// Uses cloud.normals where they are consistent: nearly all points have one; they stand on the planes through the neighbours where
/// these are flat; neighbours on one piece of surface agree in their sign; and together they bound something: either the
/// winding field keeps them as they are, or all are turned, because they point into the solid. Only their sides decide; their
/// directions are improved with the field, so that their noise does no harm. Throws as orient_points. [setup]
GivenOrientation orient_by_file_normals(const Cloud& cloud, const OrientOptions& options = {}, Workers* workers = nullptr,
                                        const CancelToken* cancel = nullptr);

/// Turns the normals of the planes towards cloud.sensor where all points can have been seen from there: no point lies far behind its
/// neighbours in the view, and neighbours on one piece of surface agree in their sign. A place that is not stated counts only outside
/// of the cloud's box, and where the surface bulges towards it. Throws as orient_points. [setup]
GivenOrientation orient_by_sensor(const Cloud& cloud, const OrientOptions& options = {}, Workers* workers = nullptr,
                                  const CancelToken* cancel = nullptr);

}  // namespace dsc::cloud
