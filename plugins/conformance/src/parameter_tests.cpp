// param.*: a strategy works with all parameters that its schema accepts.
#include <dsc/base/error.hpp>

#include "test_table.hpp"

namespace dsc::conformance {
namespace {

using config::ConfigNode;

// A set of parameters that the schema accepts either works, with finite answers, or is refused by an exception.
void try_out(const Subject& subject, const Variation& variation) {
    ConfigNode resolved;
    try {
        resolved = subject.resolve(variation.parameters);
    } catch (const std::exception&) {
        return;  // refused by a cross check; schema.reject judges the judging
    }
    Answers answers;
    try {
        const auto strategy = subject.make(resolved);
        answers = exercise(subject.kind(), *strategy, subject.fixture(), {.seed = subject.seed()});
    } catch (const std::exception&) {
        return;
    } catch (...) {
        throw Failed("with " + variation.name + " it throws something that is no std::exception");
    }
    if (const auto bad = answers.trace.first_not_finite())
        throw Failed("with " + variation.name + " it gives " + std::to_string(answers.trace.values()[*bad]) +
                     " as " + answers.trace.place(*bad));
}

// What nobody says and what is said explicitly come to the same.
void defaults(const Subject& subject) {
    const auto run = [&](const ConfigNode& resolved) {
        try {
            const auto strategy = subject.make(resolved);
            return exercise(subject.kind(), *strategy, subject.fixture(), {.seed = subject.seed()}).trace;
        } catch (const std::exception& error) {
            throw Failed(std::string("with its default parameters it throws: ") + error.what());
        }
    };
    const ConfigNode& resolved = subject.defaults();
    const Trace explicitly = run(resolved);
    bool required = false;
    for (const config::Field& field : subject.schema().fields()) required = required || field.required;
    if (required) return;  // nothing of it goes without saying
    subject.require_repeatable();
    // Only those that the struct of parameters can hold by itself: a nested strategy's defaults are its own.
    if (const auto difference = Trace::difference(explicitly, run(ConfigNode::map())))
        throw Failed("defaults that are written out give other answers than those left out: " + *difference);
}

void parameter_bounds(const Subject& subject) {
    subject.require_finite();
    for (const Variation& v : extremes(subject.schema(), subject.defaults())) try_out(subject, v);
}

void fuzz(const Subject& subject) {
    subject.require_finite();
    for (unsigned i = 0; i < subject.options().fuzz; ++i)
        try_out(subject, random_variation(subject.schema(), subject.defaults(), subject.seed() + i));
}

}  // namespace

void add_parameter_tests(std::vector<Test>& table) {
    add(table,
        {"param.default", Level::smoke, false,
         "It works with its defaults, and the same whether they are written out or left out."},
        defaults);
    add(table,
        {"param.bounds", Level::standard, false,
         "It works, or refuses by an exception, with every parameter at the ends of its range."},
        parameter_bounds);
    add(table,
        {"param.fuzz", Level::standard, false,
         "It works, or refuses by an exception, with random parameters within their ranges."},
        fuzz);
}

}  // namespace dsc::conformance
