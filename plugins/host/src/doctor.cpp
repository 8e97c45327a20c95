#include "dsc/host/doctor.hpp"

#include <algorithm>

#include <fmt/format.h>

#include <dsc/base/error.hpp>
#include <dsc/host/host.hpp>
#include <dsc/plugin/script_loader.hpp>

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
        if (plugin::is_script(real_)) {
            examine_script();
        } else {
            examine_library();
        }
        step("register", [this] { return examine_strategies(); });
        step("names", [this] { return examine_names(); });
        return std::move(all_);
    }

private:
    void examine_script() {
        step("load", [this] {
            try {
                Host().load(real_);
            } catch (const PluginError& error) {
                if (error.code() != "plugin.enroll") throw;
            }
            return std::string("a Python file, it runs to its end");
        });
    }

    void examine_library() {
        step("library", [this] {
            entry_ = read_entry(real_);
            return fmt::format("a shared library with the symbol {}", plugin::entry_symbol);
        });
        step("build", [this] { return examine_build(); });
        note_soft_differences();
        step("load", [this] {
            rehearsed_ = scan({&real_, 1}).front();
            if (rehearsed_ && rehearsed_->error.code() != "plugin.enroll") throw rehearsed_->error;
            return std::string("opened in a child process, nothing missing");
        });
    }

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

    std::string examine_build() const {
        require_fitting(entry_, real_);
        const plugin::PluginEntry& entry = entry_.entry;
        return fmt::format("plugin '{}' {}, licence {}, ABI {}.{}, fits this dsc",
                           text_of(entry.name), text_of(entry.version), text_of(entry.license),
                           entry.abi_major, entry.abi_minor);
    }

    void note_soft_differences() {
        if (failed_) return;
        for (const auto& d : plugin::compare_fingerprints(text_of(entry_.entry.fingerprint),
                                                          plugin::core_fingerprint())) {
            all_.push_back({"build", Result::note,
                            fmt::format("{} is '{}', that of dsc is '{}'; this is harmless", d.key,
                                        d.plugin, d.host)});
        }
    }

    std::string examine_strategies() {
        if (rehearsed_) throw rehearsed_->error;
        Host alone;
        alone.load(real_);
        std::string text;
        for (const plugin::StrategyInfo& info : alone.list()) {
            text += text.empty() ? "" : ", ";
            text +=
                fmt::format("{} '{}'", plugin::kind_name(info.strategy->kind), info.strategy->id);
        }
        return text;
    }

    // The plugins that a run would also find. One of them may be this same file, or an older build
    // of it.
    std::string examine_names() const {
        Host together;
        together.load(real_);
        together.load_all(search_, OnFault::collect);
        for (const Fault& fault : together.faults()) {
            if (fault.error.code() == "plugin.duplicate") throw fault.error;
        }
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
