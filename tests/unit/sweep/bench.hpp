#pragma once
// A folder with an experiment in it, and what becomes of sweep files there.

#include <algorithm>
#include <string>
#include <vector>

#include <dsc/base/error.hpp>
#include <dsc/sweep/sweep.hpp>

#include "../run/fakes.hpp"

namespace dsc::test {

/// A folder with base.yaml in it, and what becomes of sweep files there.
struct Bench {
    Folder folder;
    Strategies strategies;

    Bench() { folder.write("base.yaml", minimal); }

    sweep::Sweep load(const std::string& text) const {
        return sweep::load_sweep(folder.write("sweep.yaml", "sweep: 1\nbase: base.yaml\n" + text));
    }
    std::vector<std::string> experiments(const sweep::Sweep& sweep) const {
        return sweep::sweep_experiments(sweep, strategies.loader(), strategies);
    }
    sweep::Expansion expand(const std::string& text) const {
        const sweep::Sweep sweep = load(text);
        return sweep::expand_sweep(sweep, experiments(sweep), folder.path() / "out");
    }
    std::string table() const { return folder.read("out/jobs.tsv"); }
    /// Message of the Error that `action` ends in, the folder shown as DIR.
    template <class Action>
    std::string fault(Action action) const {
        try {
            action();
        } catch (const Error& error) {
            std::string text = error.what();
            const std::string path = folder.path().string();
            for (std::size_t at = 0; (at = text.find(path)) != std::string::npos;)
                text.replace(at, path.size(), "DIR");
            return text;
        }
        return "no error";
    }
    std::string load_fault(const std::string& text) const {
        return fault([&] { load(text); });
    }
    std::string expand_fault(const std::string& text) const {
        return fault([&] { expand(text); });
    }
};

inline std::vector<std::string> names(const sweep::Sweep& sweep) {
    std::vector<std::string> all;
    for (const sweep::SweepPoint& point : sweep.points) all.push_back(point.name);
    return all;
}

inline bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

inline std::size_t lines(const std::string& text) {
    return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

}  // namespace dsc::test
