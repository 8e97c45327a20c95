#pragma once
// States of a run for ParaView: surfaces with arrays as .vtp, and the .pvd that makes an animation
// of several files. Volumes with arrays are written by write_volume(). Atomic, as all writers.

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include <dsc/io/write.hpp>

namespace dsc::io {

/// One vector per point, for a .vtp.
struct VectorArray {
    std::string name;
    std::vector<Vec3> values;
};

/// Arrays of a surface: one number per face (cells) or per point, one vector per point.
struct SurfaceData {
    std::vector<DataArray> cells;
    std::vector<DataArray> points;
    std::vector<VectorArray> vectors;
    bool compressed = false;  ///< with zlib
};

/// Writes VTK polygons: doubles; colours as an array `colour` of three bytes per point. A
/// mesh without faces is also written, because a state may have vanished. Throws IoError
/// "io.write"; GeometryError as surface::require_sound(), "surface.size" for an array of a wrong
/// size. [setup]
void write_vtp(const std::filesystem::path& file, const surface::TriangleMesh& mesh,
               const SurfaceData& data = {});

/// Reads a surface with its colours and its arrays of floating-point numbers; every bit is as
/// written. Throws IoError with the codes of read_surface(), and "io.cell_type" for anything but
/// triangles. [setup]
surface::TriangleMesh read_vtp(const std::filesystem::path& file, SurfaceData* data = nullptr);

/// A file of a series and the time at which ParaView shows it.
struct SeriesEntry {
    std::uint64_t step = 0;
    std::string file;  ///< relative to the .pvd
};

/// Writes the index of a series. Throws IoError "io.write". [step]
void write_pvd(const std::filesystem::path& file, std::span<const SeriesEntry> entries);

}  // namespace dsc::io
