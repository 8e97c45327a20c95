// dsc_protocol: the thesis' protocol of three times fifty steps, phase by phase; then what a
// settled, an idle and a one-vertex step cost. CPU seconds of one thread. On the built-in teapot,
// or with --data on $DSC_DATA/NAME.obj.
#include <array>
#include <cstdio>
#include <fstream>
#include <string>

#include <nlohmann/json.hpp>

#include <dsc/base/error.hpp>
#include <dsc/mesh/validate.hpp>

#include "idle.hpp"
#include "pipeline.hpp"
#include "program.hpp"
#include "resources.hpp"

namespace {

using namespace dsc;
using namespace dsc::bench;
using Json = nlohmann::ordered_json;

constexpr std::size_t settled_steps = 20;
constexpr std::size_t settled_vertices = 2400;  // of the settled step that the targets name
constexpr unsigned most_refinements = 8;

struct Arguments {
    std::string name = "teapot";
    bool data = false;
    bool idle = true;
    std::uint64_t steps = 0;
    std::string json, csv;
};

constexpr const char* usage =
    "dsc_protocol [--data] [--name teapot|bunny|cow] [--no-idle] [--steps N] [--csv FILE] [--json "
    "FILE]\n"
    "  --data    on $DSC_DATA/NAME.obj instead of the built-in teapot\n"
    "  --no-idle without the settled, idle and one-vertex steps at 2,400 interface vertices\n"
    "  --steps   no more than the first N\n"
    "  --csv     a row a step\n  --json    the summary\n";

Arguments parse(int argc, char** argv) {
    Arguments arguments;
    for (int i = 1; i < argc; ++i) {
        const std::string word = argv[i];
        const auto value = [&] {
            if (++i == argc) throw UsageError("bench.usage", word + " needs a value\n" + usage);
            return std::string(argv[i]);
        };
        if (word == "--data")
            arguments.data = true;
        else if (word == "--no-idle")
            arguments.idle = false;
        else if (word == "--name")
            arguments.name = value();
        else if (word == "--steps")
            arguments.steps = std::strtoull(value().c_str(), nullptr, 10);
        else if (word == "--csv")
            arguments.csv = value();
        else if (word == "--json")
            arguments.json = value();
        else
            throw UsageError("bench.usage", "unknown argument " + word + "\n" + usage);
    }
    if (!arguments.data && arguments.name != "teapot") {
        throw UsageError("bench.usage", "--name needs --data: only the teapot is built in\n");
    }
    return arguments;
}

struct Rows {
    std::vector<StepCost> steps;

    std::vector<double> seconds(std::size_t first, std::size_t last) const {
        std::vector<double> out;
        for (std::size_t i = first; i < std::min(last, steps.size()); ++i)
            out.push_back(steps[i].seconds.sum());
        return out;
    }
};

void write_csv(const std::string& file, const Rows& rows) {
    std::ofstream out(file);
    out << "step,interface_vertices,tets,rounds,tried,committed,events,dropped_motion,velocity_s,"
           "move_s,"
           "improve_s,refine_s\n";
    for (std::size_t i = 0; i < rows.steps.size(); ++i) {
        const StepCost& c = rows.steps[i];
        out << i + 1 << ',' << c.interface_vertices << ',' << c.tets << ',' << c.rounds << ','
            << c.tried << ',' << c.committed << ',' << c.events << ',' << c.dropped_motion << ','
            << c.seconds.velocity << ',' << c.seconds.move << ',' << c.seconds.improve << ','
            << c.seconds.refine << '\n';
    }
    if (!out.flush()) throw IoError("bench.csv", file + ": cannot be written");
}

Json summary(const Rows& rows, const mesh::Complex& complex) {
    Phases sum;
    double vertices = 0.0, tets = 0.0;
    for (const StepCost& cost : rows.steps) {
        sum += cost.seconds;
        vertices += static_cast<double>(cost.interface_vertices);
        tets += static_cast<double>(cost.tets);
    }
    const std::size_t count = rows.steps.size();
    const mesh::InterfaceCounts counts = mesh::count_interface(complex);
    return {{"steps", count},
            {"seconds",
             {{"velocity", sum.velocity},
              {"move", sum.move},
              {"improve", sum.improve},
              {"refine", sum.refine},
              {"sum", sum.sum()}}},
            {"step_ms",
             {{"first ten", 1e3 * median(rows.seconds(0, 10))},
              {"median", 1e3 * median(rows.seconds(0, count))},
              {"p95", 1e3 * quantile(rows.seconds(0, count), 0.95)},
              {"max", 1e3 * quantile(rows.seconds(0, count), 1.0)},
              {"last twenty",
               1e3 * median(rows.seconds(count - std::min(count, settled_steps), count))}}},
            {"mean_interface_vertices", vertices / static_cast<double>(count)},
            {"us_per_vertex_and_step", 1e6 * sum.sum() / vertices},
            {"tets_per_interface_vertex", tets / vertices},
            {"interface_vertices", counts.vertices},
            {"shells", counts.shells},
            {"genus", counts.genus()},
            {"valid", mesh::validate(complex).valid()},
            {"peak_rss_mb", peak_rss_mb()}};
}

// The end of the run refined until its interface has the wanted number of vertices, then moved on
// until it is at rest.
Json settled(Protocol& protocol) {
    for (unsigned i = 0;
         i < most_refinements && protocol.body().view().vertex_count() < settled_vertices; ++i)
        protocol.refine_again();
    for (std::size_t i = 0; i < settled_steps; ++i) protocol.step();
    Rows rows;
    for (std::size_t i = 0; i < settled_steps; ++i) rows.steps.push_back(protocol.step());
    Json out = {{"interface_vertices", rows.steps.back().interface_vertices},
                {"tets", rows.steps.back().tets},
                {"step_ms", 1e3 * median(rows.seconds(0, settled_steps))}};
    out["quiet_steps"] = quiet_steps(protocol.body());
    return out;
}

void print(const Json& node, const std::string& indent = "  ") {
    for (const auto& [key, value] : node.items()) {
        if (value.is_object()) {
            std::printf("%s%s\n", indent.c_str(), key.c_str());
            print(value, indent + "  ");
        } else if (value.is_number_float()) {
            std::printf("%s%-28s %.4g\n", indent.c_str(), key.c_str(), value.get<double>());
        } else {
            std::printf("%s%-28s %s\n", indent.c_str(), key.c_str(), value.dump().c_str());
        }
    }
}

int work(const Arguments& arguments) {
    const Plugins plugins;
    Json out;
    {
        Protocol protocol(plugins, thesis(plugins, arguments.name, arguments.data));
        Rows rows;
        protocol.run_to(arguments.steps > 0 ? arguments.steps : protocol.steps(),
                        [&](std::uint64_t, const StepCost& cost) { rows.steps.push_back(cost); });
        out["cloud"] = arguments.data ? arguments.name : "built-in teapot";
        out["protocol"] = summary(rows, protocol.body().deformer().complex());
        if (!arguments.csv.empty()) write_csv(arguments.csv, rows);
        if (arguments.idle) out["settled"] = settled(protocol);
    }
    if (arguments.idle) out["exterior"] = exteriors(plugins);
    print(out, "");
    write_report(arguments.json, out);
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    return dsc::bench::run_program("dsc_protocol", [&] { return work(parse(argc, argv)); });
}
