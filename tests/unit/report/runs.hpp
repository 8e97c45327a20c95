#pragma once
// Runs on small meshes, of which reports are made.

#include <filesystem>
#include <string>
#include <vector>

#include <dsc/hooks/curvature_estimator.hpp>
#include <dsc/report/report.hpp>
#include <dsc/run/run_experiment.hpp>

#include "../run/fakes.hpp"

namespace dsc::test {

/// The curvature of a vertex is its x.
class Abscissa final : public hooks::CurvatureEstimator {
public:
    struct Params {};
    static void declare(config::ParamSchema<Params>&) {}
    Abscissa(const Params&, const plugin::Setup&) {}
    void prepare(const hooks::StepContext& context) override { surface_ = &context.surface; }
    void evaluate(hooks::Range range, std::span<double> scalar,
                  std::span<Vec3> vectors) const override {
        for (std::size_t i = 0; i < scalar.size(); ++i) {
            scalar[i] = surface_->positions[range.begin + i].x();
            vectors[i] = Vec3::Zero();
        }
    }

private:
    const surface::SurfaceView* surface_ = nullptr;
};

class Abscissas : public Strategies {
public:
    Abscissas() {
        plugin::Registrar& registrar = *this;
        registrar.add<Abscissa>("abscissa", "x");
    }
};

inline const Abscissas& abscissas() {
    static const Abscissas catalogue;
    return catalogue;
}

/// Runs in `folder`, where the linked-in plugin has a file.
inline run::RunOutcome work(const Folder& folder, const std::string& name, const std::string& text,
                            const std::vector<std::string>& overrides = {}) {
    const Abscissas& catalogue = abscissas();
    const fs::path here = fs::current_path();
    folder.write("libdsc_fake.so", "stands for a plugin");
    const run::LoadedExperiment loaded =
        run::load_experiment(folder.write("test.yaml", text), overrides, catalogue.loader());
    fs::current_path(folder.path());
    run::RunOptions options;
    options.folder = folder.path() / name;
    options.command = {"dsc", "run", "<b>bold</b>.yaml"};
    options.make_report = report::report_html;
    const run::RunOutcome outcome = run::run_experiment(loaded, catalogue, options);
    fs::current_path(here);
    return outcome;
}

inline std::string cloud_of_a_cube() {
    std::string text;
    for (int i = 0; i <= 4; ++i)
        for (int j = 0; j <= 4; ++j)
            for (int k = 0; k <= 4; ++k) {
                if (i % 4 != 0 && j % 4 != 0 && k % 4 != 0) continue;
                text += std::to_string(10 + i) + " " + std::to_string(20 + j) + " " +
                        std::to_string(30 + k) + "\n";
            }
    return text;
}

/// Four steps towards a cube of edge 4 at (12, 22, 32); normalised its half-edge is 0.4.
inline std::string with_cloud(const Folder& folder, const std::string& output) {
    return minimal + "input: {cloud: {file: \"" + folder.write("cloud.xyz", cloud_of_a_cube()) +
           "\"}, normalize: {scale: 0.4}}\n" + output;
}

inline std::size_t count(const std::string& text, const std::string& part) {
    std::size_t found = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
        ++found;
    return found;
}

}  // namespace dsc::test
