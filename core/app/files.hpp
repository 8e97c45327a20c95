#pragma once
// Reads the files that are named on the command line.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <dsc/cloud/read.hpp>
#include <dsc/mesh/tet_mesh.hpp>
#include <dsc/surface/triangle_mesh.hpp>

namespace CLI {
class App;
}

namespace dsc::app {

/// The content of a file; exactly one member is set.
struct Content {
    std::optional<surface::TriangleMesh> surface;
    std::optional<mesh::TetMesh> volume;
    std::optional<cloud::Cloud> cloud;
    std::size_t dropped = 0;  ///< number of points of a cloud that were not finite
    std::vector<cloud::FoundProperty> properties{};  ///< properties of a cloud
};

/// Reads a surface, a volume or a cloud. A surface file without faces is read as a cloud. `columns`
/// are those of a text cloud (cloud::ReadOptions). Throws IoError.
Content read_any(const std::filesystem::path& file, const std::vector<std::string>& columns = {});

/// Adds the option --columns to a command that reads a cloud.
void add_columns(CLI::App& command, std::vector<std::string>& columns);

/// Reads the surface in `path`: a surface file, the label interface of a volume, or the result of a
/// run folder. Throws IoError "io.no_result" for a folder without one, UsageError "file.no_surface"
/// for a cloud.
surface::TriangleMesh read_any_surface(const std::filesystem::path& path);

/// Whether the text is UTF-8, as JSON and experiments need it.
bool is_utf8(const std::string& text);

/// Whether both names lead to the same file.
bool same_file(const std::filesystem::path& a, const std::filesystem::path& b);

/// To be called for every output before the work begins. Throws UsageError "file.same" when `out`
/// is the input, IoError "io.folder" when its folder does not exist, "io.write" when it cannot be
/// written.
void require_output(const std::filesystem::path& out, const std::filesystem::path& input);

}  // namespace dsc::app
