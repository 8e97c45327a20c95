// Backends that cannot be loaded. Those of the project are loaded by every test of the command.
#include <doctest/doctest.h>

#include <dsc/base/backend.hpp>
#include <dsc/base/error.hpp>

TEST_CASE("a backend that is missing is named with its file and a remedy") {
    try {
        dsc::load_backend("that_nobody_wrote");
        FAIL("it was found");
    } catch (const dsc::Error& error) {
        CHECK(error.code() == "backend.load");
        CHECK(error.exit_code() == dsc::ExitCode::internal);
        CHECK(error.place().find("libdsc_that_nobody_wrote.so") != std::string::npos);
        CHECK(error.cause().find("it cannot be loaded") != std::string::npos);
        CHECK_FALSE(error.remedy().empty());
    }
}
