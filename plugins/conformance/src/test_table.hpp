#pragma once
// The tests by the families of their ids; each file <family>_tests.cpp adds its own.

#include <vector>

#include "subject.hpp"

namespace dsc::conformance {

/// Passes by returning; otherwise throws Failed, Skipped or Warned. Any other exception is a failure, too.
struct Test {
    TestInfo info;
    void (*run)(const Subject&);
};

void add_library_tests(std::vector<Test>& table);
void add_schema_tests(std::vector<Test>& table);
void add_parameter_tests(std::vector<Test>& table);
void add_output_tests(std::vector<Test>& table);
void add_determinism_tests(std::vector<Test>& table);
void add_geometry_tests(std::vector<Test>& table);
void add_state_tests(std::vector<Test>& table);
void add_hostile_tests(std::vector<Test>& table);
void add_policy_tests(std::vector<Test>& table);
void add_resource_tests(std::vector<Test>& table);

/// All of them.
const std::vector<Test>& test_table();

}  // namespace dsc::conformance
