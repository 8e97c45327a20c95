# The headers that the jumbo build for tests parses once: one set for plugins, one for tests. The options of a set are those of
# its users, otherwise the compiler does not take it.
file(CONFIGURE OUTPUT precompiled.cpp CONTENT "// Carries the precompiled headers.\n")

add_library(dsc_plugin_headers OBJECT ${CMAKE_CURRENT_BINARY_DIR}/precompiled.cpp)
target_compile_options(dsc_plugin_headers PRIVATE -ffp-contract=off)
target_link_libraries(dsc_plugin_headers PRIVATE dsc::core dsc_flags)
set_target_properties(dsc_plugin_headers PROPERTIES CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
target_precompile_headers(dsc_plugin_headers PRIVATE <algorithm> <cmath> <map> <string> <vector> <dsc/plugin/plugin.hpp>)

# Tests are parts of programs, hence -fPIE.
add_library(dsc_test_headers OBJECT ${CMAKE_CURRENT_BINARY_DIR}/precompiled.cpp)
target_compile_options(dsc_test_headers PRIVATE -O1 -fPIE)
target_link_libraries(dsc_test_headers PRIVATE dsc::sdk doctest::doctest dsc_flags)
target_precompile_headers(dsc_test_headers PRIVATE <algorithm> <cmath> <filesystem> <map> <sstream> <string> <vector>
  <doctest/doctest.h> <dsc/host/host.hpp> <dsc/plugin/plugin.hpp> <dsc/sdk/filters.hpp> <dsc/sdk/steps.hpp> <dsc/sdk/surfaces.hpp>)
