// param.*: a strategy works with all parameters that its schema accepts.
#include <fmt/core.h>

#include <dsc/base/error.hpp>

#include "test_table.hpp"

namespace dsc::conformance {
namespace {

using config::ConfigNode;

// A set of parameters that the schema accepts either works, with finite answers, or leads to an
// exception.
void try_out(const Subject& subject, const Variation& variation) {
    ConfigNode resolved;
    try {
        resolved = subject.resolve(variation.parameters);
    } catch (const std::exception&) {
        return;  // refused by a condition; schema.reject tests the conditions
    }
    Answers answers;
    try {
        const auto strategy = subject.make(resolved);
        answers = exercise(subject.kind(), *strategy, subject.fixture(), {.seed = subject.seed()});
    } catch (const std::exception&) {
        return;
    } catch (...) {
        throw Failed("with " + variation.name +
                     " it throws something that is not a std::exception");
    }
    if (const auto bad = answers.trace.first_not_finite())
        throw Failed(fmt::format("with {} it returns {:f} as {}", variation.name,
                                 answers.trace.values()[*bad], answers.trace.place(*bad)));
}

// Defaults that are left out and defaults that are written out have the same effect.
void defaults(const Subject& subject) {
    const auto run = [&](const ConfigNode& resolved) {
        try {
            const auto strategy = subject.make(resolved);
            return exercise(subject.kind(), *strategy, subject.fixture(), {.seed = subject.seed()})
                .trace;
        } catch (const std::exception& error) {
            throw Failed(std::string("with its default parameters it throws: ") + error.what());
        }
    };
    const ConfigNode& resolved = subject.defaults();
    const Trace explicitly = run(resolved);
    bool required = false;
    for (const config::Field& field : subject.schema().fields())
        required = required || field.required;
    if (required) return;  // there are no defaults to leave out
    subject.require_repeatable();
    // Only for parameters without nested strategies, which have their own defaults.
    if (const auto difference = Trace::difference(explicitly, run(ConfigNode::map())))
        throw Failed("defaults that are written out give different answers from defaults that are "
                     "left out: " +
                     *difference);
}

void parameter_bounds(const Subject& subject) {
    subject.require_finite();
    for (const Variation& v : extremes(subject.schema(), subject.defaults())) try_out(subject, v);
}

void fuzz(const Subject& subject) {
    subject.require_finite();
    for (unsigned i = 0; i < subject.options().fuzz; ++i)
        try_out(subject,
                random_variation(subject.schema(), subject.defaults(), subject.seed() + i));
}

}  // namespace

void add_parameter_tests(std::vector<Test>& table) {
    add(table,
        {"param.default", Level::smoke, false,
         "It works with its defaults, with the same answers whether they are written out or left "
         "out."},
        defaults);
    add(table,
        {"param.bounds", Level::standard, false,
         "It works or throws an exception with every parameter at the ends of its range."},
        parameter_bounds);
    add(table,
        {"param.fuzz", Level::standard, false,
         "It works or throws an exception with random parameters within their ranges."},
        fuzz);
}

}  // namespace dsc::conformance
