// Runs of experiments and reconstructions, with the calling program's callback.
#include "run.hpp"

#include <memory>
#include <optional>
#include <thread>

#include <pybind11/stl.h>

#include <dsc/base/error.hpp>
#include <dsc/cloud/normalize.hpp>
#include <dsc/cloud/read.hpp>
#include <dsc/config/overrides.hpp>
#include <dsc/report/report.hpp>
#include <dsc/run/reconstruct.hpp>
#include <dsc/run/run_experiment.hpp>

#include "arrays.hpp"
#include "errors.hpp"
#include "nodes.hpp"
#include "outcome.hpp"
#include "session.hpp"

namespace dsc::python {
namespace {

using config::ConfigNode;

constexpr const char* cloud_name = "points";

/// The options that runs and reconstructions share, as the package `dsc` passes them.
struct CallOptions {
    std::string folder;
    bool keep = false;  ///< the folder is the user's
    bool resume = false;
    unsigned threads = 0;
    std::vector<std::string> plugins;
    std::optional<double> time_budget;
    py::object on_step;
    std::vector<std::string> command;
};

CallOptions options_from(const py::dict& given) {
    CallOptions options;
    options.folder = given["folder"].cast<std::string>();
    options.keep = given["keep"].cast<bool>();
    options.resume = given["resume"].cast<bool>();
    options.threads = given["threads"].cast<unsigned>();
    options.plugins = given["plugins"].cast<std::vector<std::string>>();
    options.time_budget = given["time_budget"].cast<std::optional<double>>();
    options.on_step = given["on_step"];
    options.command = given["command"].cast<std::vector<std::string>>();
    return options;
}

/// A number of a row of metrics.csv, from its cell.
py::object number_from(const std::string& cell) {
    if (cell.empty()) return py::none();
    const bool integer = cell.find_first_not_of("0123456789") == std::string::npos;
    return integer ? py::object(py::int_(std::stoull(cell))) : py::float_(std::stod(cell));
}

py::dict dict_from(const run::StepMetrics& row) {
    py::dict dict;
    for (const run::MetricsColumn& column : run::metrics_columns) {
        std::string cell;
        column.append(cell, row);
        dict[py::str(std::string(column.name))] = number_from(cell);
    }
    for (const auto& [name, value] : row.observers) dict[py::str(name)] = value;
    return dict;
}

/// False of Python or of NumPy.
bool is_false(const py::object& value) {
    const auto type = py::str(py::type::of(value).attr("__name__")).cast<std::string>();
    return (type == "bool" || type == "bool_") && !value.cast<bool>();
}

/// Calls the program after each step, and ends the run if the program or the user asks for it.
class Watch {
public:
    explicit Watch(py::object on_step) : on_step_(std::move(on_step)) {}

    const CancelToken& token() const { return token_; }

    void step(const run::StepMetrics& row, std::uint64_t planned) {
        const py::gil_scoped_acquire held;
        try {
            if (PyErr_CheckSignals() != 0) throw py::error_already_set();
            if (on_step_.is_none()) return;
            py::dict dict = dict_from(row);
            dict["planned_steps"] = planned;
            if (is_false(on_step_(dict))) token_.cancel();
        } catch (const py::error_already_set& error) {
            if (!raised_) raised_ = error;
            token_.cancel();
        }
    }

    /// Raises what interrupted the run. The GIL must be held.
    void raise_again() {
        if (raised_) throw std::exchange(raised_, std::nullopt).value();
        if (take_interrupted()) {
            PyErr_SetNone(PyExc_KeyboardInterrupt);
            throw py::error_already_set();
        }
    }

private:
    py::object on_step_;
    CancelToken token_;
    std::optional<py::error_already_set> raised_;
};

run::RunOptions run_options(const CallOptions& call, Watch& watch, Outcome& outcome) {
    run::RunOptions options;
    options.folder = call.folder;
    options.picture = options.last_good = call.keep;
    options.resume = call.resume;
    options.threads =
        call.threads != 0 ? call.threads : std::max(1U, std::thread::hardware_concurrency());
    options.time_budget = call.time_budget;
    options.cancel = &watch.token();
    options.command = call.command;
    options.on_step = [&watch](const run::StepMetrics& row, std::uint64_t planned) {
        watch.step(row, planned);
    };
    options.on_result = [&outcome](const run::ResultData& data) { outcome.take(data); };
    if (call.keep) options.make_report = report::report_html;
    return options;
}

/// Runs `body(options)`, which returns a run::RunOutcome, without the GIL.
template <class Body>
std::unique_ptr<Outcome> carry_out(const CallOptions& call, Body&& body) {
    auto outcome = std::make_unique<Outcome>();
    Watch watch(call.on_step);
    take_interrupted();
    try {
        const run::RunOptions options = run_options(call, watch, *outcome);
        const py::gil_scoped_release released;
        outcome->run = body(options);
    } catch (const Error&) {
        watch.raise_again();
        throw;
    }
    watch.raise_again();
    return outcome;
}

cloud::Cloud cloud_from(const py::object& points, const py::object& normals,
                        const py::object& colours) {
    std::vector<Vec3> places = vectors_from(points, "points");
    if (places.empty())
        throw UsageError("array.shape", "points", "has no rows", "give at least four points");
    std::vector<Vec3> directions;
    if (!normals.is_none()) {
        directions = vectors_from(normals, "normals");
        require_size(directions.size(), places.size(), "normals", "points");
    }
    std::vector<cloud::Colour> bytes;
    if (!colours.is_none()) {
        bytes = colours_from(colours, "colors");
        require_size(bytes.size(), places.size(), "colors", "points");
    }
    return cloud::cloud_of(std::move(places), std::move(directions), std::move(bytes), "points");
}

/// "key=value" as on the command line.
std::vector<std::string> overrides_from(const py::dict& given) {
    std::vector<std::string> overrides;
    for (const auto& [key, value] : given) {
        const auto path = py::str(key).cast<std::string>();
        overrides.push_back(path + "=" + config::flow_text(node_from(value, path)));
    }
    return overrides;
}

/// The experiment with a cloud in place of its own input.
ConfigNode with_cloud(const ConfigNode& root, const std::string& file) {
    const ConfigNode* given = root.find("input");
    const ConfigNode input = given != nullptr && given->is_map()
                                 ? *given
                                 : ConfigNode::map({{"normalize", ConfigNode::map()}});
    const ConfigNode* own = input.find("cloud");
    const ConfigNode cloud = (own != nullptr && own->is_map() ? *own : ConfigNode::map())
                                 .without("sample")
                                 .without("columns")
                                 .with("file", ConfigNode(file));
    return root.with("input", input.with("cloud", cloud));
}

std::unique_ptr<Outcome> run_experiment(const py::object& experiment, const py::dict& changes,
                                        const py::object& points, const py::object& normals,
                                        const py::object& colours, const py::dict& given) {
    const CallOptions call = options_from(given);
    const std::vector<std::string> overrides = overrides_from(changes);
    ConfigNode root = py::isinstance<py::dict>(experiment)
                          ? config::apply_overrides(node_from(experiment, ""), overrides)
                          : run::read_experiment(experiment.cast<std::string>(), overrides);
    const auto files = std::make_shared<run::InputFiles>();
    if (!points.is_none()) {
        const auto file = files->add_cloud(cloud_name, cloud_from(points, normals, colours));
        root = with_cloud(root, file.string());
    }
    Session session(call.plugins);
    session.add_own(*files);
    return carry_out(call, [&](const run::RunOptions& options) {
        run::LoadedExperiment loaded = run::resolve_experiment(root, session.loader());
        loaded.files = files;
        return run::run_experiment(loaded, session.host(), options);
    });
}

run::ReconstructOptions reconstruct_options(const py::dict& given) {
    run::ReconstructOptions options;
    options.detail = run::detail_from_name(given["detail"].cast<std::string>()).value();
    options.edge_length = given["edge_length"].cast<std::optional<double>>();
    options.vertices = given["vertices"].cast<std::optional<std::uint64_t>>();
    options.noise = given["noise"].cast<std::optional<double>>();
    options.trim = given["trim"].cast<bool>();
    return options;
}

std::unique_ptr<Outcome> reconstruct(const py::object& points, const py::object& normals,
                                     const py::object& colours, const py::dict& given) {
    const CallOptions call = options_from(given);
    const run::ReconstructOptions wanted = reconstruct_options(given);
    const auto files = std::make_shared<run::InputFiles>();
    const bool from_file = py::isinstance<py::str>(points);
    const auto file = from_file
                          ? std::filesystem::absolute(points.cast<std::string>())
                          : files->add_cloud(cloud_name, cloud_from(points, normals, colours));
    Session session(call.plugins);
    session.add_own(*files);
    return carry_out(call, [&](const run::RunOptions& options) {
        const cloud::Cloud& cloud = files->cloud(file, {}).cloud;
        cloud::require_volume(cloud.points, cloud.source);
        run::ReconstructOutput output;
        if (call.keep) output = {{"obj", "ply"}, {"vtu", "dsc"}, true};
        const ConfigNode root =
            run::with_output(run::reconstruction_of(file.string(), wanted), output);
        run::LoadedExperiment loaded = run::resolve_experiment(root, session.loader());
        loaded.files = files;
        return run::reconstruct(loaded, session.host(), options);
    });
}

}  // namespace

void declare_run(py::module_& module) {
    module.def("run", &run_experiment);
    module.def("reconstruct", &reconstruct);
}

}  // namespace dsc::python
