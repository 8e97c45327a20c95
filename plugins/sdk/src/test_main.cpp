// The main() of doctest, for the tests of this project and for tests that dsc_add_plugin(... TESTS
// ...) declares elsewhere.
#define DOCTEST_CONFIG_IMPLEMENT_WITH_MAIN
#include <doctest/doctest.h>
