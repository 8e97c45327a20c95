#include "test_table.hpp"

namespace dsc::conformance {

void add(std::vector<Test>& table, TestInfo info, void (*run)(const Subject&),
         std::vector<plugin::Kind> kinds) {
    Test& test = table.emplace_back();
    test.info = std::move(info);
    test.run = run;
    test.kinds = std::move(kinds);
}

const std::vector<Test>& test_table() {
    static const std::vector<Test> table = [] {
        std::vector<Test> all;
        add_library_tests(all);
        add_schema_tests(all);
        add_parameter_tests(all);
        add_output_tests(all);
        add_determinism_tests(all);
        add_geometry_tests(all);
        add_state_tests(all);
        add_prepare_tests(all);
        add_hostile_tests(all);
        add_policy_tests(all);
        add_resource_tests(all);
        add_long_tests(all);
        return all;
    }();
    return table;
}

std::vector<TestInfo> tests() {
    std::vector<TestInfo> all;
    for (const Test& test : test_table()) all.push_back(test.info);
    return all;
}

}  // namespace dsc::conformance
