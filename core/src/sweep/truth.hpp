#pragma once
// The comparison of a point's result with the true surface: truth.json in the point's folder.

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <dsc/base/workers.hpp>
#include <dsc/config/node.hpp>
#include <dsc/surface/triangle_mesh.hpp>

namespace dsc::sweep {

/// Writes the name of the truth, a string, to the point's folder, or removes truth.json for null.
/// The figures of the same truth are kept. [setup]
void name_truth(const std::filesystem::path& point, const config::ConfigNode& mesh);

/// Compares results with their truths; reads each truth once.
class Truths {
public:
    explicit Truths(Workers* workers) : workers_(workers) {}

    /// The figures of surface::truth_figures() for the result in POINT/run; empty without a truth
    /// or without a result. They come from truth.json if neither surface has changed. Throws
    /// IoError for a truth or a result that cannot be read. [setup]
    std::vector<std::pair<std::string, double>> figures(const std::filesystem::path& point);

private:
    struct Truth {
        std::string sha256;
        std::optional<surface::TriangleMesh> mesh;  ///< read when it is first needed
    };

    Truth& truth(const std::string& file);

    Workers* workers_;
    std::map<std::string, Truth> truths_;
};

}  // namespace dsc::sweep
