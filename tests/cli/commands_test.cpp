// The commands on good and on wrong calls.
#include <algorithm>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include "process.hpp"

using dsc::test::Cli;
using dsc::test::Result;
using nlohmann::json;

TEST_CASE("--version, --help on stdout; wrong calls are one line and exit 2") {
    const Cli cli;
    const Result version = cli.dsc({"--version"});
    CHECK(version.code == 0);
    CHECK(version.out.substr(0, 4) == "dsc ");
    CHECK(version.out.find("fingerprint abi_major=") != std::string::npos);
    CHECK(cli.dsc({"--help"}).code == 0);
    CHECK(cli.dsc({"run", "--help"}).out.find("--time-budget") != std::string::npos);
    for (const std::vector<std::string>& wrong : std::vector<std::vector<std::string>>{
             {"walk"},
             {"run"},
             {"run", "a.yaml", "--fast"},
             {"run", "--resume"},
             {"run", "a.yaml", "--threads", "0"},
             {"run", "a.yaml", "--progress", "loud"},
             {"run", "a.yaml", "-v", "-q"},
             {"run", "a.yaml", "--time-budget", "soon"},
             {"reconstruct"},
             {"sample", "teapot", "-o", "a.xyz"},
             {"sample", "cup", "-n", "10", "-o", "a.xyz"},
             {"render", "a.obj"},
             {"report"},
             {"plugin"},
             {"plugin", "describe", "point_clod"},
             {"sweep"},
             {"sweep", "expand"},
             {"sweep", "expand", "a.yaml"},
             {"sweep", "collect"},
             {"sweep", "collect", "nowhere"},
         }) {
        CAPTURE(wrong);
        const Result result = cli.dsc(wrong);
        CHECK(result.code == 2);
        CHECK(result.out.empty());
        CHECK(result.err.substr(0, 7) == "error: ");
        CHECK(std::count(result.err.begin(), result.err.end(), '\n') == 1);
    }
    const Result bare = cli.dsc({});
    CHECK(bare.code == 2);
    CHECK(bare.out == cli.dsc({"--help"}).out);
    CHECK(cli.dsc({"help"}).out == bare.out);
    CHECK(cli.dsc({"help", "run"}).out == cli.dsc({"run", "--help"}).out);
    CHECK(cli.dsc({"help", "plugin", "check"}).out == cli.dsc({"plugin", "check", "--help"}).out);
    CHECK(cli.dsc({"version"}).out == version.out);
    CHECK(cli.dsc({"help", "recon"}).code == 2);
    const auto said = [&](const std::vector<std::string>& words) { return cli.dsc(words).err; };
    CHECK(said({"recon"}) ==
          "error: dsc: there is no command 'recon'; did you mean 'reconstruct'?; see dsc --help\n");
    CHECK(said({"rnu", "a.yaml"}) ==
          "error: dsc: there is no command 'rnu'; did you mean 'run'?; see dsc --help\n");
    CHECK(said({"plugin", "lst"}) == "error: dsc plugin: there is no command 'lst'; did you mean "
                                     "'list'?; see dsc plugin --help\n");
    CHECK(said({"frobnicate"}).find("; the commands are run, reconstruct, ") != std::string::npos);
    CHECK(said({"reconstruct", "c.ply", "--detial", "low"}) ==
          "error: dsc reconstruct has no option '--detial'; did you mean '--detail'?; see dsc "
          "reconstruct --help\n");
    CHECK(said({"reconstruct", "c.ply", "-detail=low"}) ==
          "error: dsc reconstruct has no option '-detail'; did you mean '--detail'?; see dsc "
          "reconstruct --help\n");
    CHECK(said({"sample", "torus", "--nose", "0.1", "-o", "a.xyz"}) ==
          "error: dsc sample has no option '--nose'; did you mean '--noise'?; see dsc sample "
          "--help\n");
    CHECK(said({"reconstruct", "c.ply", "--detail", "hi"}) ==
          "error: --detail: 'hi' is not one of low, medium, high; see dsc reconstruct --help\n");
    CHECK(said({"run", "a.yaml", "--threads", "0"}) ==
          "error: --threads: '0' is not a number from 1 to 1024; see dsc run --help\n");
    CHECK(said({"sample", "torus", "--noise", "2", "-o", "a.xyz"}) ==
          "error: --noise: '2' is not a number from 0 to 1; see dsc sample --help\n");
    CHECK(said({"reconstruct"}) ==
          "error: the argument CLOUD is missing; see dsc reconstruct --help\n");
    CHECK(said({"schema", "x"}) ==
          "error: the command does not accept 'x'; see dsc schema --help\n");
    CHECK(said({"run", "a.yaml", "-o"}) == "error: --output needs a value; see dsc run --help\n");
    CHECK(said({"run", "a.yaml", "-o", "a", "-o", "b"}) ==
          "error: --output may be given only once; see dsc run --help\n");
    CHECK(said({"reconstruct", "c.ply", "--edge-length", "-3"}) ==
          "error: --edge-length: '-3' is not a number above 0; see dsc reconstruct --help\n");
    CHECK(said({"reconstruct", "c.ply", "--vertices", "500", "--edge-length", "1"}) ==
          "error: --edge-length and --vertices cannot be used together; see dsc reconstruct "
          "--help\n");
    CHECK(cli.dsc({"plugin", "describe", "point_clod"}).err ==
          "error: dsc plugin describe: 'point_clod' is not the name of a strategy; did you mean "
          "'point_cloud'? dsc "
          "plugin list shows all strategies\n");
    CHECK(cli.dsc({"plugin", "describe", "rotate", "--kind", "filter"}).err ==
          "error: dsc plugin describe: 'rotate' is not the name of a strategy of kind filter; dsc "
          "plugin list shows all strategies\n");
}

TEST_CASE("a configuration that is too large is a wrong experiment, read from a file as well") {
    const Cli cli;
    std::string text = "dsc: 1\nschedule:\n";
    while (text.size() < 1100000) text += "  - {steps: 1}\n";
    cli.write("large.yaml", text);
    const Result result = cli.dsc({"run", "large.yaml", "--check"});
    CHECK(result.code == 3);
    CHECK(result.err.find("large.yaml: error: the configuration is larger than ") !=
          std::string::npos);
    cli.write("part.yaml", "include: large.yaml\ndsc: 1\n");
    CHECK(cli.dsc({"run", "part.yaml", "--check"}).code == 3);
}

TEST_CASE("info of a run folder, and render as its report has it") {
    const Cli cli;
    cli.write("a.yaml", "dsc: 1\ninput: {cloud: {sample: {shape: sphere, n: 500}}, normalize: "
                        "{}}\ninitial_mesh: {type: grid, cells: 10}\n"
                        "velocity: {type: point_cloud, curvature: {type: "
                        "implicit_fairing}}\nimprovement: {type: dsc}\nschedule: [{steps: 2}]\n");
    REQUIRE(cli.dsc({"run", "a.yaml", "-o", "r", "-q"}).code == 0);
    const json run = json::parse(cli.dsc({"info", "r", "--json"}).out);
    CHECK(run.at("kind") == "run");
    CHECK(run.at("state") == "done");
    CHECK(run.at("exit_code") == 0);
    CHECK(run.at("result").size() >= 2);
    CHECK(run.at("summary").is_object());
    CHECK(cli.dsc({"info", "r", "--require-solid"}).code == 0);
    cli.write("r/status.json", "{\"format\": \"dsc-run-1\", \"state\": \"running\"}");
    CHECK(json::parse(cli.dsc({"info", "r", "--json"}).out).at("state") == "killed");
    CHECK(cli.dsc({"info", "."}).code == 6);
    const Result picture = cli.dsc({"render", "r", "-o", "r.png"});
    CHECK(picture.err ==
          "info: z points up, as in the report of the run; --up y lets y point up\n");
    REQUIRE(cli.dsc({"render", "r", "-o", "z.png", "--up", "z"}).err.empty());
    CHECK(cli.read("r.png") == cli.read("z.png"));
    CHECK(cli.dsc({"render", "r/result/surface.obj", "-o", "y.png"}).err ==
          "info: y points up; use --up z for a model whose height is along z\n");
    CHECK(cli.read("y.png") != cli.read("z.png"));
}

TEST_CASE("sample, info, convert, evaluate and render work together") {
    const Cli cli;
    const Result sample =
        cli.dsc({"sample", "torus", "-n", "300", "-o", "torus.ply", "--mesh", "truth.obj"});
    CHECK(sample.code == 0);
    CHECK(sample.out == "torus.ply\ntruth.obj\n");
    const json cloud = json::parse(cli.dsc({"info", "torus.ply", "--json"}).out);
    CHECK(cloud["kind"] == "cloud");
    CHECK(cloud["points"] == 300);
    const json truth = json::parse(cli.dsc({"info", "truth.obj", "--json", "--require-solid"}).out);
    CHECK(truth["kind"] == "surface");
    CHECK(truth["genus"] == 1);
    CHECK(truth["self_intersections"] == 0);
    CHECK(truth["solid"] == true);

    CHECK(cli.dsc({"convert", "truth.obj", "truth.stl"}).code == 0);
    CHECK(cli.dsc({"convert", "truth.obj", "truth.off"}).code == 0);
    CHECK(cli.dsc({"convert", "truth.off", "back.obj"}).code == 0);
    // A surface gets normals, and is the same besides.
    CHECK(cli.dsc({"convert", "truth.obj", "normals.obj"}).code == 0);
    CHECK(cli.read("back.obj") == cli.read("normals.obj"));
    CHECK(cli.read("back.obj").find("\nvn ") != std::string::npos);
    CHECK(json::parse(cli.dsc({"info", "back.obj", "--json"}).out)["volume"] == truth["volume"]);
    CHECK(cli.dsc({"convert", "torus.ply", "torus.xyz"}).code == 0);
    CHECK(cli.dsc({"convert", "truth.obj", "truth.obj"}).code == 2);
    CHECK(cli.dsc({"convert", "truth.obj", "truth.vtu"}).code == 2);
    CHECK(cli.dsc({"convert", "truth.obj", "truth.doc"}).code == 2);

    const Result same = cli.dsc({"evaluate", "truth.obj", "--truth", "back.obj", "--cloud",
                                 "torus.ply", "--samples", "2000", "--json"});
    CHECK(same.code == 0);
    const json figures = json::parse(same.out);
    CHECK(figures["truth"]["chamfer_percent"].get<double>() < 1e-9);
    CHECK(figures["truth"]["f_score_1_percent"] == 1.0);
    CHECK(figures["cloud"]["cloud_to_surface"]["mean"].get<double>() < 0.01);
    CHECK(figures["formulas"]["truth"].contains("chamfer_percent"));
    CHECK(cli.dsc({"evaluate", "truth.obj"}).code == 2);
    CHECK(cli.dsc({"evaluate", "truth.obj", "--cloud", "torus.ply"})
              .out.find("vertex_to_cloud.mean") != std::string::npos);

    CHECK(cli.dsc({"render", "truth.obj", "-o", "a.png", "--view", "top", "--size", "64x48",
                   "--edges"})
              .code == 0);
    CHECK(cli.read("a.png").substr(1, 3) == "PNG");
    cli.write("tet.ply", "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty "
                         "float y\nproperty float z\nproperty float gap\n"
                         "property double support\nelement face 4\nproperty list uchar int "
                         "vertex_indices\nend_header\n0 0 0 nan 1\n1 0 0 2 1\n"
                         "0 1 0 3 1\n0 0 1 0.5 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n");
    const Result coloured =
        cli.dsc({"render", "tet.ply", "-o", "gap.png", "--size", "64x48", "--colour", "gap"});
    CHECK(coloured.out == "gap.png\ngap: 0.5 and less is blue, 2 and more is red\n");
    CHECK(cli.dsc({"render", "tet.ply", "-o", "a.png", "--size", "64x48"}).code == 0);
    CHECK(cli.read("gap.png") != cli.read("a.png"));
    const Result unknown = cli.dsc({"render", "tet.ply", "-o", "b.png", "--colour", "age"});
    CHECK(unknown.code == 2);
    CHECK(unknown.err.find("tet.ply: the vertices have no property 'age' of type float; choose one "
                           "of these: gap, support") != std::string::npos);
    CHECK(cli.dsc({"render", "truth.obj", "-o", "b.png", "--colour", "gap"}).code == 2);
    CHECK(cli.dsc({"render", "truth.obj", "-o", "a.jpg"}).code == 2);
    CHECK(cli.dsc({"render", "truth.obj", "-o", "a.png", "--size", "big"}).code == 2);
    CHECK(cli.dsc({"render", "torus.xyz", "-o", "a.png"}).code == 2);
    CHECK(cli.dsc({"render", "truth.obj", "-o", "none/a.png"}).code == 6);
    CHECK(cli.dsc({"render", ".", "-o", "a.png"}).code == 6);
}

TEST_CASE("report: folders that are no run's are refused, nothing is written") {
    const Cli cli;
    const Result missing = cli.dsc({"report", "nowhere"});
    CHECK(missing.code == 6);
    CHECK(missing.err == "error: nowhere: is not a folder; name the folder of a run that has ended "
                         "(dsc run CONFIG -o DIR)\n");
    cli.write("notes/status.json", "{}");
    CHECK(cli.dsc({"report", "notes"}).code == 6);
    CHECK(cli.dsc({"report", "notes", "nowhere"}).code == 6);
    CHECK_FALSE(cli.exists("notes/report.html"));
    CHECK_FALSE(cli.exists("comparison.html"));
}

TEST_CASE("info --require-solid: exit 5 for an open surface, with the figures") {
    const Cli cli;
    cli.write("open.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\n");
    const Result result = cli.dsc({"info", "open.obj", "--require-solid"});
    CHECK(result.code == 5);
    CHECK(result.out.find("boundary_edges        3\n") != std::string::npos);
    CHECK(result.err.find("error: open.obj: is not a valid solid") == 0);
    CHECK(cli.dsc({"info", "open.obj"}).code == 0);
    cli.write("closed.obj", cli.read("open.obj") + "f 2 3 4\n");
    CHECK(cli.dsc({"info", "closed.obj", "--require-solid"}).code == 0);
}

TEST_CASE("schema: JSON on stdout and nothing else") {
    const Cli cli;
    const Result result = cli.dsc({"schema"});
    CHECK(result.code == 0);
    CHECK(result.err.empty());
    const json schema = json::parse(result.out);
    CHECK(schema["$schema"] == "http://json-schema.org/draft-07/schema#");
    CHECK(schema["definitions"]["velocity.rotate"]["properties"]["degrees"]["maximum"] == 180);
    CHECK(cli.dsc({"schema", "--plugin", "missing.so"}).code == 4);
}

TEST_CASE("plugin list, describe in four forms, path") {
    const Cli cli;
    const Result list = cli.dsc({"plugin", "list"});
    CHECK(list.code == 0);
    for (const char* id : {"point_cloud", "angular_defect", "implicit_fairing", "average_area",
                           "grid", "voxel_grid"}) {
        CHECK(list.out.find(id) != std::string::npos);
    }
    CHECK(json::parse(cli.dsc({"plugin", "list", "--json"}).out).size() >= 10);
    const Result text = cli.dsc({"plugin", "describe", "point_cloud"});
    CHECK(text.code == 0);
    CHECK(text.out.find("alpha: real, [0, 2], default 0.2") != std::string::npos);
    const json described =
        json::parse(cli.dsc({"plugin", "describe", "point_cloud", "--format", "json"}).out);
    CHECK(described["kind"] == "velocity");
    CHECK(described["parameters"][0]["name"] == "alpha");
    CHECK(described["parameters"][0]["default"] == 0.2);
    // The block is an experiment's: it is accepted where it belongs.
    const Result yaml = cli.dsc({"plugin", "describe", "point_cloud", "--format", "yaml"});
    cli.write(
        "block.yaml",
        "dsc: 1\nschedule: [{steps: 1}]\ninitial_mesh: {type: grid}\nimprovement: {type: dsc}\n" +
            yaml.out);
    CHECK(cli.dsc({"run", "block.yaml", "--check"}).code == 0);
    CHECK(cli.dsc({"plugin", "describe", "point_cloud", "--format", "md"})
              .out.find("# velocity `point_cloud`\n") == 0);
    CHECK(cli.dsc({"plugin", "path"}).out.find("(installed folder)") != std::string::npos);
}

TEST_CASE("reconstruct: names of outputs are checked before anything is computed") {
    const Cli cli;
    cli.dsc({"sample", "sphere", "-n", "200", "-o", "cloud.obj"});
    CHECK(cli.dsc({"reconstruct", "cloud.obj", "-o", "cloud.obj"}).err ==
          "error: cloud.obj: is the input; give another file with -o\n");
    CHECK(cli.dsc({"reconstruct", "cloud.obj", "-o", "./x/../cloud.obj"}).code == 2);
    CHECK(cli.dsc({"reconstruct", "cloud.obj", "-o", "a.doc"}).err ==
          "error: a.doc: does not have the extension of a format that dsc writes; use .obj, .ply, "
          ".off, .stl, .glb for the surface, .vtu, .dsc, .msh, .mesh for the volume\n");
    CHECK(cli.dsc({"reconstruct", "cloud.obj", "-o", "a.obj", "-o", "a.obj"}).code == 2);
    const Result folder = cli.dsc({"reconstruct", "cloud.obj", "-o", "none/a.obj"});
    CHECK(folder.code == 6);
    CHECK(folder.err ==
          "error: none/a.obj: its folder none does not exist; create the folder first\n");
    CHECK(cli.dsc({"reconstruct", "cloud.obj", "--detail", "ultra"}).code == 2);
}

TEST_CASE("run: overrides, threads, json progress, a time budget") {
    const Cli cli;
    cli.write(
        "a.yaml",
        "dsc: 1\nname: short\ninput: {cloud: {sample: {shape: sphere, n: 500}}, normalize: {}}\n"
        "initial_mesh: {type: grid, cells: 12}\nvelocity: {type: point_cloud}\nimprovement: {type: "
        "dsc}\n"
        "schedule: [{steps: 3}]\n");
    const Result run = cli.dsc(
        {"run", "a.yaml", "schedule.0.steps=2", "--threads", "2", "--progress", "json", "-q"});
    CHECK(run.code == 0);
    CHECK(std::count(run.err.begin(), run.err.end(), '\n') == 3);
    CHECK(json::parse(run.err.substr(0, run.err.find('\n')))["planned"] == 2);
    CHECK(run.out.substr(0, 11) == "runs/short/");
    const std::string folder = run.out.substr(0, run.out.find('\n'));
    CHECK(folder.size() == 11 + 12);
    CHECK(dsc::test::looks_finished(cli.folder() / folder));
    CHECK(cli.dsc({"info", folder + "/result/volume.dsc", "--require-solid"}).code == 0);
    CHECK(cli.dsc({"evaluate", folder, "--cloud", folder + "/result/surface.obj"}).code == 0);
    CHECK(cli.dsc({"render", folder, "-o", "a.png", "--size", "32x32"}).code == 0);
    // Running the resolved experiment gives the same bytes.
    CHECK(cli.dsc({"run", folder + "/config.resolved.yaml", "-o", "again", "-q"}).code == 0);
    CHECK(cli.read("again/result/surface.obj") == cli.read(folder + "/result/surface.obj"));

    const Result stopped =
        cli.dsc({"run", "a.yaml", "-o", "out", "--time-budget", "0.000001s", "-q"});
    CHECK(stopped.code == 75);
    CHECK(cli.read("out/status.json").find("\"state\": \"stopped\"") != std::string::npos);
}
