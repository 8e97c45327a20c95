// out.*, in.bounds: what a strategy writes and where, and what it must not change or read.
#include <fmt/core.h>

#include <dsc/base/log.hpp>

#include "guarded_input.hpp"
#include "process.hpp"
#include "test_table.hpp"

namespace dsc::conformance {
namespace {

void finite(const Subject& subject) {
    const Answers answers = subject.answers();
    if (const auto bad = answers.trace.first_not_finite())
        throw Failed(
            fmt::format("{:f} as {}", answers.trace.values()[*bad], answers.trace.place(*bad)));
}

void complete(const Subject& subject) {
    const Answers answers = subject.answers();
    if (const auto bad = answers.trace.first_unwritten())
        throw Failed("it does not write " + answers.trace.place(*bad));
}

void output_bounds(const Subject& subject) {
    for (const std::size_t block : {std::size_t{64}, std::size_t{1}}) {
        const Answers answers = subject.answers({.block = block});
        require(answers.outside.empty(), "it writes outside its output, in " + answers.outside);
    }
}

void inputs(const Subject& subject) {
    const Answers answers = subject.answers();
    require(answers.changed.empty(), "it changes its input: " + answers.changed);
}

void output_attributes(const Subject& subject) {
    const Answers answers = subject.answers();
    require(answers.unfit.empty(), answers.unfit);
}

void input_bounds(const Subject& subject) {
    if (!input_is_guarded())
        throw Skipped("input is guarded only in a process of its own, without a sanitizer");
    for (const std::size_t block : {std::size_t{64}, std::size_t{1}})
        subject.answers({.block = block});
}

void quiet(const Subject& subject) {
    set_log_sink([](LogLevel, std::string_view) {});  // messages through the log are allowed
    const std::size_t before = printed_so_far();
    subject.answers();
    const bool silent = printed_so_far() == before;
    require(silent,
            "it prints text; strategies must use dsc::log for messages: " + printed_since(before));
}

}  // namespace

void add_output_tests(std::vector<Test>& table) {
    add(table, {"out.finite", Level::smoke, false, "No answer is NaN or infinite."}, finite);
    add(table, {"out.complete", Level::smoke, false, "Every entry of an output is written."},
        complete, per_vertex);
    add(table, {"out.bounds", Level::standard, false, "Nothing outside an output is written."},
        output_bounds, per_vertex);
    add(table, {"out.const", Level::standard, false, "No bit of the input changes."}, inputs);
    add(table,
        {"out.attributes", Level::standard, false,
         "Published attributes have one value per vertex, and valid names that differ."},
        output_attributes, {plugin::Kind::velocity, plugin::Kind::refinement});
    add(table, {"in.bounds", Level::smoke, false, "Nothing beyond the end of an input is read."},
        input_bounds,
        {plugin::Kind::velocity, plugin::Kind::curvature, plugin::Kind::refinement,
         plugin::Kind::improvement, plugin::Kind::observer, plugin::Kind::filter});
    add(table, {"out.quiet", Level::standard, false, "Nothing is printed."}, quiet);
}

}  // namespace dsc::conformance
