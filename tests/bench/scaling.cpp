// dsc_scaling: how cost and memory grow with the interface. Spheres of N interface vertices, twenty
// identical steps relative to their edges, and the slope of log cost over log N. The measured steps
// lie inside the function dsc_measured:
//   valgrind --tool=callgrind --toggle-collect=dsc_measured dsc_scaling --n 2000
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <sstream>
#include <string>

#include <sys/wait.h>
#include <unistd.h>

#include <nlohmann/json.hpp>

#include <dsc/base/error.hpp>
#include <dsc/base/heap.hpp>
#include <dsc/mesh/validate.hpp>
#include <dsc/run/sha256.hpp>

#include "exchange.hpp"
#include "pipeline.hpp"
#include "program.hpp"
#include "resources.hpp"

namespace {

using namespace dsc;
using namespace dsc::bench;
using Json = nlohmann::ordered_json;

constexpr double radius = 1.2;  // in the box [-1.5, 1.5]^3
constexpr double stride = 0.1;  // of L, each step
constexpr double pi = 3.14159265358979323846;

constexpr const char* usage =
    "dsc_scaling [--n LIST] [--steps N] [--max-tets N] [--threads N] [--validate] [--json FILE] "
    "[--mesh TYPE [key=value ...]]\n"
    "  --n         interface vertices, by commas; default 2000,6000,20000,60000,200000\n"
    "  --max-tets  grids that would have more are left out; default 10000000\n"
    "  --threads   that share the work of a step; step_ms is CPU time, wall_ms is what they save; "
    "default 1\n"
    "  --validate  check every invariant at the end\n"
    "  --mesh      initial mesh strategy; {edge} in a value is the edge that gives N vertices, "
    "{cells} the cells of\n"
    "              a grid. Default: grid, a sphere of radius 1.2; comes last\n";

struct Arguments {
    std::vector<double> n = {2e3, 6e3, 2e4, 6e4, 2e5};
    unsigned steps = 20;
    double max_tets = 1e7;
    unsigned threads = 1;
    bool validate = false;
    std::string json;
    std::string mesh = "grid";
    std::vector<std::string> parameters;
};

Arguments parse(int argc, char** argv) {
    Arguments arguments;
    for (int i = 1; i < argc; ++i) {
        const std::string word = argv[i];
        const auto value = [&] {
            if (++i == argc) throw UsageError("bench.usage", word + " needs a value\n" + usage);
            return std::string(argv[i]);
        };
        const auto number = [&](const std::string& text) {
            char* end = nullptr;
            const double x = std::strtod(text.c_str(), &end);
            if (end == text.c_str() || *end != '\0' || !(x >= 1.0)) {
                throw UsageError("bench.usage",
                                 word + ": '" + text + "' is not a number of at least 1\n" + usage);
            }
            return x;
        };
        if (word == "--n") {
            arguments.n.clear();
            std::istringstream list(value());
            for (std::string part; std::getline(list, part, ',');)
                arguments.n.push_back(number(part));
        } else if (word == "--steps") {
            arguments.steps = static_cast<unsigned>(number(value()));
        } else if (word == "--max-tets") {
            arguments.max_tets = number(value());
        } else if (word == "--threads") {
            arguments.threads = static_cast<unsigned>(number(value()));
        } else if (word == "--validate") {
            arguments.validate = true;
        } else if (word == "--json") {
            arguments.json = value();
        } else if (word == "--mesh") {
            arguments.mesh = value();
            while (i + 1 < argc) arguments.parameters.emplace_back(argv[++i]);
        } else {
            throw UsageError("bench.usage", "unknown argument " + word + "\n" + usage);
        }
    }
    return arguments;
}

// A triangle has half a vertex; its area is that of an equilateral one.
double edge_for(double n) {
    return std::sqrt(4.0 * pi * radius * radius / (2.0 * n) / (std::sqrt(3.0) / 4.0));
}

// The stair-stepped sphere of a grid of c cells has 1.41 r^2 c^2 vertices (1,266 at c = 30, r = 1).
int cells_for(double n) {
    return static_cast<int>(std::lround(std::sqrt(n / (1.407 * radius * radius))));
}

void replace_all(std::string& text, const std::string& from, const std::string& to) {
    for (std::size_t at = text.find(from); at != std::string::npos;
         at = text.find(from, at + to.size())) {
        text.replace(at, from.size(), to);
    }
}

config::StrategyConfig mesh_for(const Arguments& arguments, double n) {
    std::vector<std::string> parameters = arguments.parameters;
    if (parameters.empty()) {
        const std::string size = arguments.mesh == "grid" ? "cells={cells}" : "cell={edge}";
        parameters = {"shape=sphere", "radius=1.2", size};
    }
    for (std::string& parameter : parameters) {
        replace_all(parameter, "{edge}", std::to_string(edge_for(n)));
        replace_all(parameter, "{cells}", std::to_string(cells_for(n)));
    }
    return strategy(arguments.mesh, parameters);
}

// SHA-256 of points, tets and labels: equal for the same bits.
std::string digest(const mesh::TetMesh& mesh) {
    std::string bytes;
    const auto append = [&bytes](const auto& list) {
        bytes.append(reinterpret_cast<const char*>(list.data()), list.size() * sizeof list[0]);
    };
    append(mesh.points);
    append(mesh.tets);
    append(mesh.labels);
    return run::sha256(bytes);
}

// One sphere: built, then moved on in a straight line by the same part of its edges each step. The
// first step, which looks at the whole mesh and lets the arrays grow, is not measured.
Json measure(const Arguments& arguments, double n) {
    const Plugins plugins;
    const double rss_before = rss_mb();
    double build_seconds = cpu_seconds();
    const config::StrategyConfig improvement = strategy("dsc", {});
    Workers workers(arguments.threads);
    Body body(initial_complex(plugins, mesh_for(arguments, n)),
              plugins.host().create<hooks::Improvement>(improvement, "improvement"), nullptr,
              &workers);
    build_seconds = cpu_seconds() - build_seconds;
    const Vec3 way = stride * body.deformer().target_length() * Vec3(1.0, 0.6, 0.35).normalized();
    const auto onward = [&](const hooks::StepContext&, std::span<Vec3> out) {
        std::fill(out.begin(), out.end(), way);
    };
    body.step(onward);
    const double exchange_before = arguments.threads > 1 ? exchange_ns() : 0.0;
    const auto start = std::chrono::steady_clock::now();
    double vertices = 0.0, tets = 0.0, rounds = 0.0, dropped = 0.0;
    Phases sum;
    measured([&] {
        for (unsigned i = 0; i < arguments.steps; ++i) {
            const StepCost cost = body.step(onward);
            sum += cost.seconds;
            vertices += static_cast<double>(cost.interface_vertices) / arguments.steps;
            tets += static_cast<double>(cost.tets) / arguments.steps;
            rounds += static_cast<double>(cost.rounds) / arguments.steps;
            dropped +=
                cost.dropped_motion /
                (way.norm() * static_cast<double>(cost.interface_vertices) * arguments.steps);
        }
    });
    const double wall =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    Json row = {{"n", vertices},
                {"tets", tets},
                {"tets_per_vertex", tets / vertices},
                {"build_s", build_seconds},
                {"step_ms", 1e3 * sum.sum() / arguments.steps},
                {"wall_ms", 1e3 * wall / arguments.steps},
                {"us_per_vertex_and_step", 1e6 * sum.sum() / arguments.steps / vertices},
                {"rounds", rounds},
                {"dropped_part", dropped},
                {"rss_mb", rss_mb() - rss_before},
                {"kb_per_vertex", 1e3 * (rss_mb() - rss_before) / vertices},
                {"peak_rss_mb", peak_rss_mb()},
                {"digest", digest(body.deformer().complex().to_mesh())}};
    if (arguments.threads > 1) row["exchange_ns"] = {exchange_before, exchange_ns()};
    if (arguments.validate) row["valid"] = mesh::validate(body.deformer().complex()).valid();
    return row;
}

// In a process of its own, so that its peak of memory is its own.
Json measure_apart(const Arguments& arguments, double n) {
    std::array<int, 2> ends{};
    if (pipe(ends.data()) != 0)
        throw IoError("bench.pipe", "no pipe to the measuring process could be made");
    const pid_t child = fork();
    if (child < 0) throw IoError("bench.fork", "the measuring process could not be started");
    if (child == 0) {
        close(ends[0]);
        std::string text;
        try {
            text = measure(arguments, n).dump();
        } catch (const std::exception& error) {
            text = Json{{"error", error.what()}}.dump();
        }
        const bool written =
            write(ends[1], text.data(), text.size()) == static_cast<ssize_t>(text.size());
        _exit(written ? 0 : 1);
    }
    close(ends[1]);
    std::string text;
    std::array<char, 4096> buffer{};
    for (ssize_t got = 0; (got = read(ends[0], buffer.data(), buffer.size())) > 0;)
        text.append(buffer.data(), static_cast<std::size_t>(got));
    close(ends[0]);
    int status = 0;
    waitpid(child, &status, 0);
    if (text.empty()) return Json{{"error", "the measuring process ended without a result"}};
    return Json::parse(text);
}

// Slope of log y over log x by least squares.
double exponent(const std::vector<double>& x, const std::vector<double>& y) {
    double mean_x = 0.0, mean_y = 0.0;
    const auto count = static_cast<double>(x.size());
    for (std::size_t i = 0; i < x.size(); ++i) {
        mean_x += std::log(x[i]) / count;
        mean_y += std::log(y[i]) / count;
    }
    double xy = 0.0, xx = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        xy += (std::log(x[i]) - mean_x) * (std::log(y[i]) - mean_y);
        xx += (std::log(x[i]) - mean_x) * (std::log(x[i]) - mean_x);
    }
    return xy / xx;
}

int work(const Arguments& arguments) {
    Json out = {{"mesh", arguments.mesh}, {"steps", arguments.steps}, {"rows", Json::array()}};
    std::printf("%9s %10s %6s %8s %9s %9s %9s %6s %8s %8s %9s\n", "N", "tets", "tets/N", "build_s",
                "step_ms", "wall_ms", "us/N/step", "rounds", "rss_mb", "kB/N", "peak_mb");
    bool failed = false;
    std::vector<double> n, seconds;
    for (const double wanted : arguments.n) {
        const double cells = cells_for(wanted);
        if (arguments.mesh == "grid" && arguments.parameters.empty() &&
            5.0 * cells * cells * cells > arguments.max_tets) {
            std::printf("%9.0f left out: a grid of %.3g tets\n", wanted,
                        5.0 * cells * cells * cells);
            continue;
        }
        const Json row =
            arguments.n.size() == 1 ? measure(arguments, wanted) : measure_apart(arguments, wanted);
        if (row.contains("error")) {
            std::printf("%9.0f failed: %s\n", wanted, row["error"].get<std::string>().c_str());
            failed = true;
            continue;
        }
        const auto value = [&](const char* key) { return row[key].get<double>(); };
        std::printf("%9.0f %10.0f %6.1f %8.2f %9.2f %9.2f %9.2f %6.1f %8.1f %8.2f %9.1f%s\n",
                    value("n"), value("tets"), value("tets_per_vertex"), value("build_s"),
                    value("step_ms"), value("wall_ms"), value("us_per_vertex_and_step"),
                    value("rounds"), value("rss_mb"), value("kb_per_vertex"), value("peak_rss_mb"),
                    row.value("valid", true) ? "" : " INVALID");
        std::fflush(stdout);
        if (row.contains("exchange_ns")) {
            std::fprintf(stderr,
                         "%9.0f two threads exchanged a line of the caches in %.0f ns before the "
                         "steps, %.0f ns after them\n",
                         value("n"), row["exchange_ns"][0].get<double>(),
                         row["exchange_ns"][1].get<double>());
        }
        failed = failed || !row.value("valid", true);
        n.push_back(value("n"));
        seconds.push_back(value("step_ms"));
        out["rows"].push_back(row);
    }
    if (n.size() > 1) {
        out["exponent"] = exponent(n, seconds);
        std::printf("exponent of CPU time over N: %.3f\n", exponent(n, seconds));
    }
    write_report(arguments.json, out);
    return failed ? 1 : 0;
}

}  // namespace

int main(int argc, char** argv) {
    dsc::give_back_large_blocks();  // as in dsc
    return dsc::bench::run_program("dsc_scaling", [&] { return work(parse(argc, argv)); });
}
