// The host opens the backends of the core for every program that links it.
#include <doctest/doctest.h>

#include <dsc/base/backend.hpp>
#include <dsc/base/error.hpp>

TEST_CASE("each backend is opened, and always the same") {
    for (const char* name : {"pcl", "vtk", "embree"}) {
        CAPTURE(name);
        const void* const table = dsc::load_backend(name);
        CHECK(table != nullptr);
        CHECK(dsc::load_backend(name) == table);
    }
}

TEST_CASE("a backend that is missing is named with its file and a remedy") {
    try {
        dsc::load_backend("that_nobody_wrote");
        FAIL("it was found");
    } catch (const dsc::Error& error) {
        CHECK(error.code() == "backend.load");
        CHECK(error.place().find("libdsc_that_nobody_wrote.so") != std::string::npos);
        CHECK(error.cause().find("it cannot be loaded") != std::string::npos);
        CHECK_FALSE(error.remedy().empty());
    }
}
