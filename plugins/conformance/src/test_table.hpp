#pragma once
// The table of tests, in families by their ids; each file <family>_tests.cpp adds its tests.

#include <algorithm>
#include <vector>

#include "subject.hpp"

namespace dsc::conformance {

/// Returns if the test passes; otherwise throws Failed, Skipped or Warned. Any other exception is
/// also a failure.
struct Test {
    TestInfo info;
    void (*run)(const Subject&) = nullptr;
    std::vector<plugin::Kind> kinds;  ///< kinds for which it runs; empty: all

    bool is_for(plugin::Kind kind) const {
        return kinds.empty() || std::find(kinds.begin(), kinds.end(), kind) != kinds.end();
    }
};

void add(std::vector<Test>& table, TestInfo info, void (*run)(const Subject&),
         std::vector<plugin::Kind> kinds = {});

/// Kinds that return a value per vertex.
inline const std::vector<plugin::Kind> per_vertex = {plugin::Kind::velocity,
                                                     plugin::Kind::curvature};

void add_library_tests(std::vector<Test>& table);
void add_schema_tests(std::vector<Test>& table);
void add_parameter_tests(std::vector<Test>& table);
void add_output_tests(std::vector<Test>& table);
void add_determinism_tests(std::vector<Test>& table);
void add_geometry_tests(std::vector<Test>& table);
void add_state_tests(std::vector<Test>& table);
void add_prepare_tests(std::vector<Test>& table);
void add_hostile_tests(std::vector<Test>& table);
void add_policy_tests(std::vector<Test>& table);
void add_resource_tests(std::vector<Test>& table);
void add_long_tests(std::vector<Test>& table);

/// All tests.
const std::vector<Test>& test_table();

}  // namespace dsc::conformance
