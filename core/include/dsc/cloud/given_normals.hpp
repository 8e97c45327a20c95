#pragma once
// Orients a cloud by the data of its file: by normals, or by the position of the scanner. Both are
// tested before use.

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <dsc/cloud/orientation.hpp>

namespace dsc::cloud {

/// What was done with a file's normals or scanner position.
struct GivenOrientation {
    std::optional<OrientedPoints> oriented{};  ///< empty if the data is not used
    std::string note{};  ///< one sentence: what was done and why; empty if there is nothing to
                         ///< report
    std::vector<std::pair<std::string, double>> figures{};  ///< the figures behind the decision, in
                                                            ///< the form of a filter's figures
};

/// Uses cloud.normals if they are consistent: nearly all points have one; they are perpendicular to
/// the planes through the neighbours where these are flat; neighbours on one piece of surface agree
/// in their sign; and together they bound a solid: either the winding field agrees with them, or
/// all of them are turned because they point into the solid. Only their signs are used; their
/// directions are improved with the field, so their noise does no harm. Throws as orient_points.
/// [setup]
GivenOrientation orient_by_file_normals(const Cloud& cloud, const OrientOptions& options = {},
                                        Workers* workers = nullptr,
                                        const CancelToken* cancel = nullptr);

/// Turns the normals of the planes towards cloud.sensor if all points can have been seen from
/// there: no point lies far behind its neighbours in the view, and neighbours on one piece of
/// surface agree in their sign. A position that the file does not state explicitly is used only
/// outside the cloud's box, and only if the surface bulges towards it. Throws as orient_points.
/// [setup]
GivenOrientation orient_by_sensor(const Cloud& cloud, const OrientOptions& options = {},
                                  Workers* workers = nullptr, const CancelToken* cancel = nullptr);

}  // namespace dsc::cloud
