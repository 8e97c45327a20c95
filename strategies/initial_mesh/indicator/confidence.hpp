#pragma once
// How far the labels of a cloud can be trusted: figures, and warnings where they pass a limit.

#include <dsc/cloud/cloud.hpp>
#include <dsc/hooks/figures.hpp>
#include <dsc/mesh/tet_mesh.hpp>

#include "labels.hpp"

namespace dsc::indicator {

/// Residual of the winding field above which a finer orientation is tried, and above which the
/// topology stays doubtful; noisy clouds with correct labels reach 0.14.
inline constexpr double retry_residual = 0.135, most_residual = 0.15;
/// Residual, and area of the start per area of the points, above which the cloud is open.
inline constexpr double open_residual = 0.17, open_area = 1.3;

/// Whether a finer orientation may help: confirmed vertices count like changed ones. [setup]
bool doubtful(const Labels& labels, const cloud::Orientation& orientation);

/// Figures of the initial interface about the cloud.
struct StartSurface {
    double area = 0.0;        ///< of the interface
    double cloud_area = 0.0;  ///< cloud::Statistics::area
    double gap_share = 0.0;   ///< fraction of the interface's area farther than 3 local widths from
                              ///< every sample
};
/// Measures the interface of the labelled tets against the samples. [setup]
StartSurface measure_start(const mesh::TetMesh& mesh, const cloud::Orientation& orientation,
                           double cloud_area);

hooks::Warnings warnings_of(const Labels& labels, const cloud::Orientation& orientation,
                            const StartSurface& start);
void add_figures(const Labels& labels, const cloud::Orientation& orientation,
                 const StartSurface& start, hooks::Figures& out);

}  // namespace dsc::indicator
