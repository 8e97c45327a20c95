#include "dsc/host/doctor.hpp"

#include <algorithm>

#include <dsc/base/error.hpp>
#include <dsc/host/host.hpp>

#include "admission.hpp"
#include "entry_file.hpp"

namespace dsc::host {
namespace {

namespace fs = std::filesystem;
using Result = Examination::Result;

class Doctor {
public:
    Doctor(const fs::path& file, std::span<const SearchEntry> search)
        : file_(file), search_(search) {}

    std::vector<Examination> examine() {
        step("file", [this] {
            real_ = real_path(file_);
            return real_.string();
        });
        step("permissions", [this] {
            require_safe_file(real_);
            return std::string("nobody else can write it");
        });
        step("library", [this] {
            entry_ = read_entry(real_);
            return std::string("a shared library with the symbol ") + plugin::entry_symbol;
        });
        step("build", [this] { return judge_build(); });
        note_soft_differences();
        step("load", [this] {
            rehearsed_ = scan({&real_, 1}).front();
            if (rehearsed_ && rehearsed_->code != "plugin.enroll") raise(*rehearsed_);
            return std::string("opened in a child process, nothing missing");
        });
        step("register", [this] { return judge_strategies(); });
        step("names", [this] { return judge_names(); });
        return std::move(all_);
    }

private:
    template <class Body>
    void step(const std::string& name, Body&& body) {
        Examination examination{name, Result::not_reached, "not reached"};
        if (!failed_) {
            try {
                examination.text = body();
                examination.result = Result::ok;
            } catch (const Error& error) {
                examination.text = error.what();
                examination.result = Result::failed;
                failed_ = true;
            }
        }
        all_.push_back(std::move(examination));
    }

    [[noreturn]] static void raise(const Fault& fault) {
        throw PluginError(fault.code, fault.message);
    }

    std::string judge_build() const {
        require_fitting(entry_, real_);
        const plugin::PluginEntry& entry = entry_.entry;
        return "plugin '" + text_of(entry.name) + "' " + text_of(entry.version) + ", licence " +
               text_of(entry.license) + ", ABI " + std::to_string(entry.abi_major) + "." +
               std::to_string(entry.abi_minor) + ", fits this dsc";
    }

    void note_soft_differences() {
        if (failed_) return;
        for (const auto& d : plugin::compare_fingerprints(text_of(entry_.entry.fingerprint),
                                                          plugin::core_fingerprint())) {
            all_.push_back({"build", Result::note,
                            d.key + " is '" + d.plugin + "', that of dsc is '" + d.host +
                                "'; this is harmless"});
        }
    }

    std::string judge_strategies() {
        if (rehearsed_) raise(*rehearsed_);
        Host alone;
        alone.load(real_);
        std::string text;
        for (const plugin::StrategyInfo& info : alone.list()) {
            text += text.empty() ? "" : ", ";
            text += std::string(plugin::kind_name(info.strategy->kind)) + " '" + info.strategy->id +
                    "'";
        }
        return text;
    }

    // The plugins that a run would also find. One of them may be this same file, or an older build
    // of it.
    std::string judge_names() const {
        Host together;
        together.load(real_);
        std::vector<std::string> clashes;
        together.load_all(search_, OnFault::collect);
        for (const Fault& fault : together.faults()) {
            if (fault.code == "plugin.duplicate") clashes.push_back(fault.message);
        }
        if (!clashes.empty()) throw PluginError("plugin.duplicate", clashes.front());
        return "no other plugin on the search path has one of its ids";
    }

    fs::path file_;
    std::span<const SearchEntry> search_;
    fs::path real_;
    EntryBytes entry_;
    std::optional<Fault> rehearsed_;
    std::vector<Examination> all_;
    bool failed_ = false;
};

}  // namespace

std::vector<Examination> examine(const fs::path& file, std::span<const SearchEntry> search) {
    return Doctor(file, search).examine();
}

bool healthy(const std::vector<Examination>& examinations) {
    return std::none_of(examinations.begin(), examinations.end(),
                        [](const Examination& examination) {
                            return examination.result == Result::failed ||
                                   examination.result == Result::not_reached;
                        });
}

}  // namespace dsc::host
