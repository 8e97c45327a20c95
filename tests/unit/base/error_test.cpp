#include <dsc/base/error.hpp>

#include <doctest/doctest.h>

TEST_CASE("an input error names file, place, cause and remedy") {
    const dsc::IoError error("io.syntax", "cloud.obj", "12", "'v 1 2' has two coordinates", "a vertex needs three");
    CHECK(std::string(error.what()) == "cloud.obj:12: 'v 1 2' has two coordinates; a vertex needs three");
    CHECK(error.exit_code() == dsc::ExitCode::io);
    CHECK(error.code() == "io.syntax");
}
