#pragma once
// What the tests of this module share: an environment, a fake set of strategies, the text of an
// error.

#include <array>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <dsc/base/error.hpp>
#include <dsc/config/params.hpp>
#include <dsc/config/yaml.hpp>

namespace test {

using dsc::config::ConfigNode;

/// An environment with these variables and no others.
inline dsc::config::YamlOptions with_variables(std::map<std::string, std::string> variables) {
    dsc::config::YamlOptions options;
    options.environment = [variables = std::move(variables)](const std::string& name) {
        const auto found = variables.find(name);
        return found == variables.end() ? std::nullopt : std::optional<std::string>(found->second);
    };
    return options;
}

inline ConfigNode parse(const std::string& text) {
    return dsc::config::parse_yaml(text, "a.yaml", with_variables({{"HOME", "/home/ada"}}));
}

/// The message of the ConfigError that `action` throws, "no error" without one.
template <class Action>
std::string error_of(Action action) {
    try {
        action();
    } catch (const dsc::ConfigError& error) {
        return error.what();
    }
    return "no error";
}

template <class Action>
std::string code_of(Action action) {
    try {
        action();
    } catch (const dsc::Error& error) {
        return error.code();
    }
    return "no error";
}

/// A folder of its own for files, removed at the end.
class Folder {
public:
    explicit Folder(const std::string& name)
        : path_(std::filesystem::temp_directory_path() /
                ("dsc_config_" + name + "_" + std::to_string(process()))) {
        std::filesystem::create_directories(path_);
    }
    ~Folder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;

    std::filesystem::path write(const std::string& name, const std::string& text) const {
        const std::filesystem::path file = path_ / name;
        std::filesystem::create_directories(file.parent_path());
        std::ofstream(file, std::ios::binary) << text;
        return file;
    }
    const std::filesystem::path& path() const { return path_; }
    /// The text with this folder's name as DIR.
    std::string shown(std::string text) const {
        for (std::size_t at = 0; (at = text.find(path_.string(), at)) != std::string::npos;) {
            text.replace(at, path_.string().size(), "DIR");
        }
        return text;
    }

private:
    /// Differs between the processes of a parallel test run, which share the folder for temporary
    /// files.
    static long process() {
        std::error_code ignored;
        const auto self = std::filesystem::read_symlink("/proc/self", ignored);
        return ignored ? 0 : std::stol(self.string());
    }
    std::filesystem::path path_;
};

enum class Area { mixed, ring };

struct ImplicitFairing {
    Area area = Area::mixed;
    static void declare(dsc::config::ParamSchema<ImplicitFairing>& s) {
        s.choice("area", &ImplicitFairing::area, {{"mixed", Area::mixed}, {"ring", Area::ring}})
            .doc("Area that a vertex stands for.");
    }
};

struct AngularDefect {
    bool per_area = false;
    static void declare(dsc::config::ParamSchema<AngularDefect>& s) {
        s.boolean("per_area", &AngularDefect::per_area).doc("Divide by the area.");
    }
};

struct PointCloud {
    double alpha = 0.2;
    double beta = 0.0;
    int k = 8;
    std::optional<double> radius;
    dsc::config::StrategyConfig curvature;
    static void declare(dsc::config::ParamSchema<PointCloud>& s) {
        s.real("alpha", &PointCloud::alpha)
            .range(0, 1)
            .open_low()
            .unit("dimensionless")
            .doc("Fraction of the distance moved per step.");
        s.real("beta", &PointCloud::beta).at_least(0).doc("Weight of the curvature.");
        s.integer("k", &PointCloud::k).range(1, 512).doc("Neighbours.");
        s.real("radius", &PointCloud::radius).greater(0).unit("length").doc("Search radius.");
        s.strategy("curvature", &PointCloud::curvature, "curvature")
            .optional()
            .doc("Estimator of the curvature.");
        s.check([](const PointCloud& p) { return p.beta == 0 || !p.curvature.empty(); },
                "beta above 0 needs a curvature");
        s.deprecated("neighbours", "k");
    }
};

struct Normal {
    double speed = 1;
    static void declare(dsc::config::ParamSchema<Normal>& s) {
        s.real("speed", &Normal::speed).unit("length").doc("Way along the normal.");
    }
};

struct Topology {
    bool open = true;
    double thickness = 0.6;
    static void declare(dsc::config::ParamSchema<Topology>& s) {
        s.boolean("open", &Topology::open).doc("Open handles.");
        s.real("thickness", &Topology::thickness)
            .at_least(0)
            .unit("mean edges")
            .doc("Largest thickness.");
    }
};

struct Phase {
    std::optional<int> steps;
    int every = 0;
    static void declare(dsc::config::ParamSchema<Phase>& s) {
        s.integer("steps", &Phase::steps).at_least(1).doc("Number of steps.");
        s.integer("every", &Phase::every).at_least(0).doc("Steps between refinements.");
        s.check([](const Phase& p) { return p.every == 0 || p.steps; }, "'every' needs 'steps'");
    }
};

/// A small experiment with most types of field.
struct Experiment {
    std::string name = "unnamed";
    std::uint32_t seed = 1;
    std::optional<std::string> cloud;
    std::array<double, 3> axis{0, 0, 1};
    std::vector<double> levels{0.5, 1.0};
    std::vector<std::string> surface{"obj"};
    std::vector<int> sizes;
    Topology topology{true, 0.7};
    std::vector<Phase> schedule;
    dsc::config::StrategyConfig velocity;
    std::vector<dsc::config::StrategyConfig> estimators;
    static void declare(dsc::config::ParamSchema<Experiment>& s) {
        s.string("name", &Experiment::name).doc("Name of the run.");
        s.integer("seed", &Experiment::seed).doc("Seed of all random numbers.");
        s.file("cloud", &Experiment::cloud).extensions({".obj", ".ply"}).doc("The cloud.");
        s.vec3("axis", &Experiment::axis).doc("Up.");
        s.reals("levels", &Experiment::levels).range(0, 2).size(0, 4).doc("Levels.");
        s.strings("surface", &Experiment::surface).choices({"obj", "ply", "off"}).doc("Formats.");
        s.integers("sizes", &Experiment::sizes).at_least(1).doc("Sizes.");
        s.object("topology", &Experiment::topology, Topology::declare).doc("Events.");
        s.list("schedule", &Experiment::schedule, Phase::declare).doc("Phases.");
        s.strategy("velocity", &Experiment::velocity, "velocity").doc("Velocity field.");
        s.strategies("estimators", &Experiment::estimators, "curvature")
            .doc("Estimators to report.");
    }
};

/// Two velocities and two curvatures.
class FakeLookup : public dsc::config::StrategyLookup {
public:
    FakeLookup() {
        PointCloud::declare(point_cloud_);
        Normal::declare(normal_);
        ImplicitFairing::declare(fairing_);
        AngularDefect::declare(defect_);
    }
    const dsc::config::Schema* find_schema(const std::string& kind,
                                           const std::string& id) const override {
        if (kind == "velocity" && id == "point_cloud") return &point_cloud_.schema();
        if (kind == "velocity" && id == "normal") return &normal_.schema();
        if (kind == "curvature" && id == "implicit_fairing") return &fairing_.schema();
        if (kind == "curvature" && id == "angular_defect") return &defect_.schema();
        return nullptr;
    }
    std::vector<std::string> ids(const std::string& kind) const override {
        if (kind == "velocity") return {"normal", "point_cloud"};
        if (kind == "curvature") return {"angular_defect", "implicit_fairing"};
        return {};
    }

private:
    dsc::config::ParamSchema<PointCloud> point_cloud_;
    dsc::config::ParamSchema<Normal> normal_;
    dsc::config::ParamSchema<ImplicitFairing> fairing_;
    dsc::config::ParamSchema<AngularDefect> defect_;
};

/// The resolved experiment; throws ConfigError with all faults.
inline ConfigNode resolve(const ConfigNode& node) {
    dsc::config::ParamSchema<Experiment> schema;
    Experiment::declare(schema);
    dsc::config::Diagnostics diagnostics;
    ConfigNode resolved = dsc::config::validate(node, schema.schema(), FakeLookup(), diagnostics);
    diagnostics.throw_if_errors();
    return resolved;
}

/// The message at an experiment's text; "no error" if it is sound.
inline std::string error_in(const std::string& text) {
    return error_of([&] { resolve(parse(text)); });
}

}  // namespace test
