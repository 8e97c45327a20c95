#include <doctest/doctest.h>

#include <dsc/base/error.hpp>

TEST_CASE("an input error names file, place, cause and remedy") {
    const dsc::IoError error("io.syntax", "cloud.obj", "12", "'v 1 2' has two coordinates",
                             "a vertex needs three");
    CHECK(std::string(error.what()) ==
          "cloud.obj:12: 'v 1 2' has two coordinates; a vertex needs three");
    CHECK(error.exit_code() == dsc::ExitCode::io);
    CHECK(error.code() == "io.syntax");
    CHECK(error.place() == "cloud.obj:12");
    CHECK(error.cause() == "'v 1 2' has two coordinates");
    CHECK(error.remedy() == "a vertex needs three");
}

TEST_CASE("errors of every family have the same parts, and empty ones leave no mark") {
    const dsc::GeometryError whole("cloud.few", "a.ply", "the cloud has 1 point", "add points");
    CHECK(std::string(whole.what()) == "a.ply: the cloud has 1 point; add points");
    CHECK(std::string(dsc::UsageError("usage.x", "", "no folder", "name one").what()) ==
          "no folder; name one");
    CHECK(std::string(dsc::PluginError("plugin.x", "p", "broken", "").what()) == "p: broken");
    const dsc::ConfigError message("config.x", "a: b; c");
    CHECK(message.place().empty());
    CHECK(message.cause() == "a: b; c");
    CHECK(message.remedy().empty());
}
