// You learn how to read a point cloud and reconstruct it, as the command `dsc reconstruct` does.
#include <iostream>

#include <dsc/base/error.hpp>
#include <dsc/cloud/read.hpp>
#include <dsc/host/host.hpp>
#include <dsc/run/reconstruct.hpp>
#include <dsc/run/run_experiment.hpp>

using namespace dsc;

void reconstruct(const std::string& file, const std::string& folder) {
    const cloud::Cloud cloud = cloud::read_cloud(file);
    std::cout << "points: " << cloud.points.size() << "\n";

    // The experiment of `dsc reconstruct --detail low`: the strategies and their parameters.
    const config::ConfigNode experiment =
        run::reconstruction_of(std::filesystem::absolute(file), {.detail = cloud::Detail::low});

    // The experiment is checked against the strategies that the plugins offer.
    host::Host host;
    const auto load_plugins =
        [&](const std::vector<std::string>&) -> const config::StrategyLookup& {
        host.load_all(host::search_path({}));
        return host;
    };
    const run::LoadedExperiment loaded = run::resolve_experiment(experiment, load_plugins);

    // The folder receives surface, volume, figures and a report.
    const run::RunOutcome outcome =
        run::run_experiment(loaded, host, {.folder = folder, .threads = 2, .picture = false});
    const surface::SurfaceReport& surface = outcome.surface.report;
    std::cout << (surface.closed_manifold() ? "closed" : "open") << " surface of genus "
              << surface.genus << ", volume " << surface.volume << "\n"
              << "written to " << outcome.surfaces.front().string() << "\n";
}

int main(int argc, char** argv) {
    if (argc != 3) {
        std::cerr << "usage: reconstruct_a_cloud CLOUD FOLDER\n";
        return 2;
    }
    try {
        reconstruct(argv[1], argv[2]);
    } catch (const Error& error) {  // what() states the place, the cause and the remedy
        std::cerr << error.what() << "\n";
        return static_cast<int>(error.exit_code());
    }
}
