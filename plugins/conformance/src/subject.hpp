#pragma once
// The subject of a test: a library that is loaded into this process, and one of its strategies.

#include <memory>

#include <dsc/conformance/check.hpp>
#include <dsc/host/host.hpp>

#include "exercise.hpp"
#include "fixtures.hpp"
#include "notes.hpp"
#include "parameters.hpp"
#include "verdict.hpp"

namespace dsc::conformance {

class Subject {
public:
    /// If `strategy` is null, the test is for the library, which is not loaded here.
    Subject(std::filesystem::path file, const StrategyName* strategy, const Notes& notes,
            const CheckOptions& options);

    const std::filesystem::path& file() const { return file_; }
    const CheckOptions& options() const { return options_; }
    std::uint64_t seed() const { return options_.seed; }

    // ---- for one strategy

    plugin::Kind kind() const { return record().kind; }
    const plugin::StrategyRecord& record() const;
    const config::Schema& schema() const { return *record().schema; }

    /// The parameters as the schema resolves them. Throws Failed if the schema refuses them,
    /// StrategyError if the validation throws.
    config::ConfigNode resolve(const config::ConfigNode& given) const;
    /// The defaults, with the values of the notes where there is no default. Skips if a parameter
    /// has no value, or if they are refused, which schema.roundtrip reports.
    const config::ConfigNode& defaults() const;
    /// The plugin's own object, without the wrapper that checks it.
    std::unique_ptr<hooks::Strategy> make(const config::ConfigNode& resolved) const;
    std::unique_ptr<hooks::Strategy> make() const { return make(defaults()); }

    /// Answers of a new instance with the default parameters on the ordinary fixture. Skips if it
    /// throws, which param.default reports.
    Answers answers(const Exercise& how = {}) const;
    Answers answers_on(const Fixture& fixture, const Exercise& how = {}) const;
    /// Skips unless two instances give the same answers one after the other, which det.repeat
    /// tests.
    void require_repeatable() const;
    /// Skips unless all answers are written and finite, which out.* test.
    void require_finite() const;

    /// The fixture that most tests use; made once.
    const Fixture& fixture() const;

private:
    std::filesystem::path file_;
    const CheckOptions& options_;
    const StrategyNotes* notes_ = nullptr;
    host::Host host_;
    std::optional<plugin::StrategyInfo> strategy_;
    mutable std::optional<config::ConfigNode> defaults_;
    mutable std::optional<Fixture> fixture_;
};

}  // namespace dsc::conformance
