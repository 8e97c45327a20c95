#pragma once
// What the programs with a JSON report have in common.

#include <cstdio>
#include <fstream>
#include <string>

#include <nlohmann/json.hpp>

#include <dsc/base/error.hpp>

namespace dsc::bench {

/// Writes the report; nothing if no file is wanted. Throws IoError "bench.json".
inline void write_report(const std::string& file, const nlohmann::ordered_json& report) {
    if (file.empty()) return;
    std::ofstream out(file);
    out << report.dump(2) << '\n';
    if (!out.flush()) throw IoError("bench.json", file + ": cannot be written");
}

/// The exit code of `work`, or that of its error after its message.
template <class Work>
int run_program(const char* name, Work&& work) {
    try {
        return work();
    } catch (const Error& error) {
        std::fprintf(stderr, "%s: %s\n", name, error.what());
        return static_cast<int>(error.exit_code());
    }
}

}  // namespace dsc::bench
