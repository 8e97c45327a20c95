// Backends without a host, and with one. The real one is tested by tests/unit/host.
#include <doctest/doctest.h>

#include <dsc/base/backend.hpp>
#include <dsc/base/error.hpp>

TEST_CASE("without a host, the error names the library and what to link; with one, it is asked") {
    try {
        dsc::load_backend("pcl");
        FAIL("it was found");
    } catch (const dsc::Error& error) {
        CHECK(error.code() == "backend.load");
        CHECK(error.exit_code() == dsc::ExitCode::internal);
        CHECK(error.place() == "libdsc_pcl.so");
        CHECK(error.remedy() == "link dsc::host too");
    }
    static const int table = 7;
    dsc::set_backend_opener(
        [](const std::string& name) -> const void* { return name == "pcl" ? &table : nullptr; });
    CHECK(dsc::load_backend("pcl") == &table);
    CHECK(dsc::load_backend("vtk") == nullptr);
    dsc::set_backend_opener(nullptr);
}
