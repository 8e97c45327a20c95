#include "subject.hpp"

#include <algorithm>

#include <dsc/base/error.hpp>

namespace dsc::conformance {
namespace {

bool nests(const config::Schema& schema) {
    return std::any_of(schema.fields().begin(), schema.fields().end(),
                       [](const config::Field& field) { return !field.kind.empty(); });
}

}  // namespace

Subject::Subject(std::filesystem::path file, const StrategyName* strategy, const Notes& notes,
                 const CheckOptions& options)
    : file_(std::move(file)), options_(options) {
    if (strategy == nullptr) return;
    notes_ = find(notes, strategy->kind, strategy->id);
    host_.load(file_);
    strategy_ = host_.find(strategy->kind, strategy->id);
    if (strategy_ && nests(*strategy_->strategy->schema))
        host_.load_all(options.search, host::OnFault::collect);
}

const plugin::StrategyRecord& Subject::record() const {
    if (!strategy_)
        throw Failed("the strategy is missing: the plugin registers a different set of strategies "
                     "each time");
    return *strategy_->strategy;
}

config::ConfigNode Subject::resolve(const config::ConfigNode& given) const {
    config::Diagnostics diagnostics;
    config::ConfigNode resolved =
        config::validate(given, schema(), host_, diagnostics, "the strategy");
    try {
        diagnostics.throw_if_errors();
    } catch (const ConfigError& error) {
        throw Failed(error.what());
    }
    return resolved;
}

const config::ConfigNode& Subject::defaults() const {
    if (defaults_) return *defaults_;
    const config::ConfigNode given = notes_ != nullptr && notes_->parameters.is_map()
                                         ? notes_->parameters
                                         : config::ConfigNode::map();
    for (const config::Field& field : schema().fields()) {
        if (field.required && given.find(field.name) == nullptr) {
            throw Skipped("parameter '" + field.name + "' has no default; set its value in " +
                          file_.stem().string() + ".check.yaml beside the plugin");
        }
    }
    try {
        defaults_ = resolve(given);
    } catch (const std::exception&) {
        throw Skipped("the default parameters are refused; see schema.roundtrip");
    }
    return *defaults_;
}

std::unique_ptr<hooks::Strategy> Subject::make(const config::ConfigNode& resolved) const {
    const plugin::Setup setup(host_, std::string(plugin::kind_name(kind())));
    return record().make(resolved, setup);
}

Answers Subject::answers(const Exercise& how) const { return answers_on(fixture(), how); }

Answers Subject::answers_on(const Fixture& on, const Exercise& how) const {
    try {
        const auto strategy = make();
        return exercise(kind(), *strategy, on, how);
    } catch (const Skipped&) {
        throw;
    } catch (const std::exception& error) {
        throw Skipped(std::string("it throws; see param.default: ") + error.what());
    }
}

void Subject::require_repeatable() const {
    if (Trace::difference(answers().trace, answers().trace))
        throw Skipped("two runs with the same seed differ; see det.repeat");
}

void Subject::require_finite() const {
    const Answers given = answers();
    if (given.trace.first_not_finite() || given.trace.first_unwritten())
        throw Skipped("not all answers are numbers; see out.finite and out.complete");
}

const Fixture& Subject::fixture() const {
    if (!fixture_) fixture_ = ordinary();
    return *fixture_;
}

}  // namespace dsc::conformance
