#pragma once
// Distances to meshes and clouds, area-uniform sampling, and the figures that evaluate a
// reconstruction.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <dsc/base/random.hpp>
#include <dsc/surface/triangle_mesh.hpp>

namespace dsc {
class Workers;
}

namespace dsc::surface {

struct NearestHit {
    Vec3 point = Vec3::Zero();  ///< nearest point of the mesh or cloud
    double distance = 0.0;
    std::uint32_t index = 0;  ///< its face or point; of equally near ones the lowest
};

/// Finds the nearest point of a triangle mesh, in double precision. Keeps a copy of the triangles.
class TriangleTree {
public:
    /// Throws as require_sound(), and GeometryError "surface.empty" without faces. [setup]
    explicit TriangleTree(const TriangleMesh& mesh);
    ~TriangleTree();
    TriangleTree(TriangleTree&&) noexcept;
    TriangleTree& operator=(TriangleTree&&) noexcept;

    /// `p` must be finite. [parallel]
    NearestHit nearest(const Vec3& p) const;

private:
    struct Data;
    std::unique_ptr<Data> data_;
};

/// Finds the nearest point of a set of points. Keeps a copy.
class PointTree {
public:
    /// Throws GeometryError "surface.empty" without points, "surface.not_finite" for NaN or
    /// infinity. [setup]
    explicit PointTree(std::span<const Vec3> points);
    ~PointTree();
    PointTree(PointTree&&) noexcept;
    PointTree& operator=(PointTree&&) noexcept;

    /// `p` must be finite. [parallel]
    NearestHit nearest(const Vec3& p) const;

private:
    struct Data;
    std::unique_ptr<Data> data_;
};

struct SurfaceSamples {
    std::vector<Vec3> points;
    std::vector<std::uint32_t> faces;  ///< the face of each point
};

/// `count` points, uniform by area. Sample i depends only on the key and i (key.element is replaced
/// by i). Throws as require_sound(), and GeometryError "surface.empty" if the mesh has no area.
/// [setup]
SurfaceSamples sample_surface(const TriangleMesh& mesh, std::size_t count, RandomKey key);

struct EvaluateOptions {
    std::size_t samples = 100000;  ///< on each surface
    std::uint64_t seed = 7;
    Workers* workers = nullptr;  ///< the figures do not depend on them
};

/// Distances are fractions of the diagonal of the box of the true surface; multiply by 100 for per
/// cent.
struct Evaluation {
    double diagonal = 0.0;  ///< of the true surface, in its units
    double accuracy = 0.0;  ///< mean distance from the reconstruction's samples to the true surface
    double completeness = 0.0;        ///< mean distance from the true surface's samples to the
                                      ///< reconstruction
    double chamfer = 0.0;             ///< mean of accuracy and completeness
    double hausdorff = 0.0;           ///< largest distance of a sample, in both directions
    double hausdorff99 = 0.0;         ///< the larger 99 % quantile of both directions
    double f_score_05 = 0.0;          ///< F-score at 0.5 % of the diagonal
    double f_score_1 = 0.0;           ///< F-score at 1 % of the diagonal
    double normal_consistency = 0.0;  ///< mean of |n.n'| over both directions
};

/// Two-way comparison of a reconstruction with the true surface. Throws as TriangleTree and
/// sample_surface(). [step]
Evaluation evaluate(const TriangleMesh& recon, const TriangleMesh& truth,
                    const EvaluateOptions& options = {});

struct DistanceFigures {
    double mean = 0.0;
    double min = 0.0;
    double max = 0.0;
};

/// In the units of the arguments.
struct CloudEvaluation {
    DistanceFigures vertex_to_cloud;  ///< surface vertices to the nearest cloud point: table 6.2 of
                                      ///< the thesis
    DistanceFigures cloud_to_surface;  ///< cloud points to the nearest point of the surface
};

/// Nearest neighbours in both directions, in the units of the arguments.
struct CloudDistances {
    std::vector<NearestHit> of_vertices;  ///< per point of the mesh that a face uses: the nearest
                                          ///< point of the cloud
    std::vector<std::uint32_t> vertices;  ///< those points of the mesh
    std::vector<NearestHit> of_points;    ///< per point of the cloud: the nearest place on the
                                          ///< surface; its index is a face
};

/// Throws as TriangleTree and PointTree. The result does not depend on the number of threads.
/// [step]
CloudDistances cloud_distances(const TriangleMesh& surface, std::span<const Vec3> cloud,
                               Workers* workers = nullptr);

/// Evaluates a surface by the cloud that it was made from; points that no face uses are left out.
/// [parallel]
CloudEvaluation evaluate_cloud(const CloudDistances& distances);
/// The same from the meshes. Throws as cloud_distances. [step]
CloudEvaluation evaluate_cloud(const TriangleMesh& surface, std::span<const Vec3> cloud,
                               Workers* workers = nullptr);

}  // namespace dsc::surface
