#include "dsc/conformance/check.hpp"

#include <algorithm>
#include <sstream>

#include <fmt/format.h>

#include <dsc/base/error.hpp>
#include <dsc/config/spelling.hpp>
#include <dsc/plugin/fingerprint.hpp>

#include "fixtures.hpp"
#include "process.hpp"
#include "test_table.hpp"

namespace dsc::conformance {
namespace {

namespace fs = std::filesystem;

std::string described(const StrategyName& strategy) {
    return std::string(plugin::kind_name(strategy.kind)) + " '" + strategy.id + "'";
}

Verdict run_here(const Test& test, const fs::path& file, const StrategyName* strategy,
                 const Notes& notes, const CheckOptions& options) {
    try {
        test.run(Subject(file, strategy, notes, options));
        return {Status::pass, ""};
    } catch (const Skipped& skipped) {
        return {Status::skip, skipped.what()};
    } catch (const Warned& warned) {
        return {Status::warn, warned.what()};
    } catch (const std::exception& error) {
        return {Status::fail, error.what()};
    } catch (...) {
        return {Status::fail, "it throws something that is not a std::exception"};
    }
}

/// Whether the calls of a test include those of an earlier one, whose outcome reports their crash.
bool repeats(const std::string& test, const std::string& earlier) {
    return earlier == "param.default" ||
           (test == "err.throw" && (earlier == "mesh.hostile" || earlier == "cloud.hostile"));
}

class Check {
public:
    Check(const fs::path& file, const CheckOptions& options)
        : options_(options),
          file_(real(file)),
          notes_(options.notes.empty() ? notes_beside(file_)
                                       : read_notes(fs::absolute(options.notes))) {
        for (const std::string& id : options.only) require_test(id);
        report_.file = file_;
        report_.level = options.level;
        report_.seed = options.seed;
    }

    Report run() {
        for (const Test& test : test_table()) {
            if (test.info.of_library) run(test, nullptr);
        }
        const bool loads =
            std::none_of(report_.outcomes.begin(), report_.outcomes.end(), [](const Outcome& o) {
                return (o.test == "lib.entry" || o.test == "lib.bind") && is_failure(o.status);
            });
        if (!loads) return std::move(report_);
        prepare_fixtures();
        for (const StrategyName& strategy : strategies()) {
            for (const Test& test : test_table()) {
                if (!test.info.of_library && test.is_for(strategy.kind)) run(test, &strategy);
            }
        }
        return std::move(report_);
    }

private:
    static fs::path real(const fs::path& file) {
        std::error_code error;
        fs::path path = fs::canonical(file, error);
        if (error)
            throw PluginError("plugin.open", file.string(),
                              fmt::format("cannot be opened ({})", error.message()),
                              "check its name and permissions");
        return path;
    }

    static void require_test(const std::string& id) {
        std::vector<std::string> ids;
        for (const Test& test : test_table()) ids.push_back(test.info.id);
        if (std::find(ids.begin(), ids.end(), id) != ids.end()) return;
        throw UsageError("usage.test", "dsc plugin check", fmt::format("there is no test '{}'", id),
                         config::did_you_mean(id, ids) + "dsc plugin check --list shows all");
    }

    bool wanted(const Test& test) const {
        if (options_.only.empty()) return test.info.level <= options_.level;
        return std::find(options_.only.begin(), options_.only.end(), test.info.id) !=
               options_.only.end();
    }

    std::chrono::milliseconds limit() const {
        const bool slow = plugin::core_fingerprint().find("san=none") == std::string_view::npos;
        return slow ? 10 * options_.limit : options_.limit;
    }

    Verdict verdict(const Test& test, const StrategyName* strategy) const {
        if (strategy != nullptr) {
            const StrategyNotes* notes = find(notes_, strategy->kind, strategy->id);
            if (notes != nullptr && notes->waive.count(test.info.id) != 0)
                return {Status::skip, "waived: " + notes->waive.at(test.info.id)};
        }
        const auto body = [&] { return run_here(test, file_, strategy, notes_, options_); };
        if (options_.in_process) return body();
        for (const auto& [earlier, who] : crashed_) {
            if (strategy != nullptr && described(*strategy) == who &&
                repeats(test.info.id, earlier))
                return {Status::skip, "it crashes; see " + earlier};
        }
        Verdict verdict = run_in_child(body, limit(), beyond_input(test));
        if (verdict.status != Status::crash) return verdict;
        verdict.message += "; for a debugger: --in-process --only " + test.info.id;
        return verdict;
    }

    /// A read beyond an input is the fault that in.bounds reports, whatever it does to another
    /// test.
    static Verdict beyond_input(const Test& test) {
        return test.info.id == "in.bounds" ? Verdict{Status::fail, ""}
                                           : Verdict{Status::skip, "see in.bounds: "};
    }

    void run(const Test& test, const StrategyName* strategy) {
        if (!wanted(test)) return;
        const auto begin = std::chrono::steady_clock::now();
        const Verdict verdict = this->verdict(test, strategy);
        if (strategy != nullptr && verdict.status == Status::crash)
            crashed_.emplace_back(test.info.id, described(*strategy));
        const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
        report_.outcomes.push_back({test.info.id, strategy == nullptr ? "" : described(*strategy),
                                    verdict.status, verdict.message, seconds.count()});
        if (options_.on_outcome) options_.on_outcome(report_.outcomes.back());
    }

    // A child process lists them, so that the plugin is never loaded into this process.
    std::vector<StrategyName> strategies() {
        const Verdict listed = run_in_child(
            [this] {
                try {
                    host::Host host;
                    host.load(file_);
                    std::string text =
                        host.plugins().front().name + " " + host.plugins().front().version + "\n";
                    for (const plugin::StrategyInfo& info : host.list())
                        text += std::string(plugin::kind_name(info.strategy->kind)) + " " +
                                info.strategy->id + "\n";
                    return Verdict{Status::pass, text};
                } catch (const Error& error) {
                    return Verdict{Status::fail, error.cause()};
                } catch (const std::exception& error) {
                    return Verdict{Status::fail, error.what()};
                }
            },
            limit());
        if (listed.status != Status::pass)
            throw PluginError("check.list", file_.string(),
                              fmt::format("its strategies cannot be listed: {}", listed.message),
                              "dsc plugin doctor FILE shows what is wrong");
        std::istringstream lines(listed.message);
        std::getline(lines, report_.plugin);
        std::vector<StrategyName> found;
        for (std::string kind, id; lines >> kind >> id;)
            found.push_back({plugin::find_kind(kind).value(), id});
        return chosen(found);
    }

    std::vector<StrategyName> chosen(const std::vector<StrategyName>& found) const {
        if (options_.strategies.empty()) return found;
        for (const StrategyName& wanted : options_.strategies) {
            const bool there =
                std::any_of(found.begin(), found.end(), [&](const StrategyName& name) {
                    return name.kind == wanted.kind && name.id == wanted.id;
                });
            if (!there)
                throw UsageError("usage.strategy", file_.string(),
                                 fmt::format("does not contain {}", described(wanted)),
                                 "dsc plugin list --plugin FILE shows its strategies");
        }
        return options_.strategies;
    }

    const CheckOptions& options_;
    fs::path file_;
    Notes notes_;
    std::vector<std::pair<std::string, std::string>> crashed_;  // tests and their strategies
    Report report_;
};

}  // namespace

std::string_view name(Level level) {
    switch (level) {
        case Level::smoke: return "smoke";
        case Level::standard: return "standard";
        case Level::strict: return "strict";
    }
    return "?";
}

std::optional<Level> find_level(std::string_view text) {
    for (const Level level : {Level::smoke, Level::standard, Level::strict}) {
        if (name(level) == text) return level;
    }
    return std::nullopt;
}

std::string_view name(Status status) {
    switch (status) {
        case Status::pass: return "pass";
        case Status::warn: return "warn";
        case Status::skip: return "skip";
        case Status::fail: return "FAIL";
        case Status::crash: return "CRASH";
        case Status::timeout: return "TIMEOUT";
    }
    return "?";
}

bool is_failure(Status status) {
    return status == Status::fail || status == Status::crash || status == Status::timeout;
}

bool Report::passed() const {
    return std::none_of(outcomes.begin(), outcomes.end(),
                        [](const Outcome& o) { return is_failure(o.status); });
}

std::size_t Report::count(Status status) const {
    return static_cast<std::size_t>(
        std::count_if(outcomes.begin(), outcomes.end(),
                      [status](const Outcome& o) { return o.status == status; }));
}

Report check(const fs::path& file, const CheckOptions& options) {
    return Check(file, options).run();
}

}  // namespace dsc::conformance
