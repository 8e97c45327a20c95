// dsc sample
#include <memory>

#include <dsc/cloud/shapes.hpp>
#include <dsc/cloud/write.hpp>
#include <dsc/io/write.hpp>

#include "commands.hpp"
#include "files.hpp"
#include "standard_streams.hpp"

namespace dsc::app {
namespace {

struct SampleArguments {
    std::string shape;
    std::uint64_t n = 0;
    std::uint64_t seed = 1;
    double noise = 0.0;
    double outliers = 0.0;
    std::string output;
    std::string mesh;
};

int execute(const SampleArguments& arguments) {
    require_output(arguments.output, "");
    if (!arguments.mesh.empty()) require_output(arguments.mesh, arguments.output);
    const cloud::Cloud cloud = cloud::sample_shape(arguments.shape, arguments.n, arguments.seed,
                                                   arguments.noise, arguments.outliers);
    std::vector<std::string> written = {arguments.output};
    if (!arguments.mesh.empty()) {
        cloud::ShapeMesh truth = cloud::shape_mesh(arguments.shape);
        io::write_surface(arguments.mesh, {std::move(truth.points), std::move(truth.faces)});
        written.push_back(arguments.mesh);
    }
    cloud::write_cloud(arguments.output, cloud);
    for (const std::string& file : written) data_out() << file << "\n";
    return 0;
}

}  // namespace

void add_sample(CLI::App& app, Context& context) {
    CLI::App* command = app.add_subcommand(
        "sample", "Sample a cloud of a built-in shape: teapot, sphere, torus or box_tunnel");
    const auto arguments = std::make_shared<SampleArguments>();
    command->add_option("SHAPE", arguments->shape, "Shape: teapot, sphere, torus or box_tunnel")
        ->required();
    command->add_option("-n", arguments->n, "Number of points")
        ->required()
        ->check(CLI::Range(1, 100000000));
    command
        ->add_option("-o,--output", arguments->output,
                     "Cloud to write: .obj .ply .pcd .xyz .txt .asc .pts .csv")
        ->required();
    command
        ->add_option("--noise", arguments->noise,
                     "Standard deviation of the noise, in diagonals of the bounding box")
        ->check(CLI::Range(0.0, 1.0));
    command
        ->add_option("--outliers", arguments->outliers,
                     "Fraction of the points that get random places in the box")
        ->check(CLI::Range(0.0, 1.0));
    command->add_option("--seed", arguments->seed, "Seed of the random numbers")
        ->capture_default_str();
    command->add_option("--mesh", arguments->mesh,
                        "Also write the true surface: .obj, .ply, .off or .stl");
    set_action(*command, context, [arguments] { return execute(*arguments); });
}

}  // namespace dsc::app
