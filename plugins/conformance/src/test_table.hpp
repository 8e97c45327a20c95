#pragma once
// The tests by the families of their ids; each file <family>_tests.cpp adds its own.

#include <algorithm>
#include <vector>

#include "subject.hpp"

namespace dsc::conformance {

/// Passes by returning; otherwise throws Failed, Skipped or Warned. Any other exception is a failure, too.
struct Test {
    TestInfo info;
    void (*run)(const Subject&) = nullptr;
    std::vector<plugin::Kind> kinds;  ///< that it is for; empty: all

    bool is_for(plugin::Kind kind) const {
        return kinds.empty() || std::find(kinds.begin(), kinds.end(), kind) != kinds.end();
    }
};

void add(std::vector<Test>& table, TestInfo info, void (*run)(const Subject&),
         std::vector<plugin::Kind> kinds = {});

/// Kinds with a value for each vertex.
inline const std::vector<plugin::Kind> per_vertex = {plugin::Kind::velocity, plugin::Kind::curvature};

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
