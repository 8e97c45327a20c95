#pragma once
// Calls of strategies whose answers are discarded if one of them was told to stop: it may have
// returned early, with a part of its answer.

#include <initializer_list>
#include <span>
#include <vector>

#include <dsc/base/error.hpp>
#include <dsc/base/progress.hpp>

#include "saved_run.hpp"

namespace dsc::run {

class RevocableCalls {
public:
    /// `cancel`: the token of the run, or null.
    explicit RevocableCalls(const CancelToken* cancel) : cancel_(cancel), token_(cancel) {}

    /// The token for the contexts of the calls.
    const CancelToken& token() const { return token_; }
    /// Whether the run shall stop.
    bool stop_asked() const { return token_.requested(); }
    /// The states that the callees of discarded calls had before; else empty.
    std::span<const StrategyState> states_before() const { return before_; }

    /// Makes `calls`, which change nothing except the `callees` themselves. False if a strategy was
    /// told to stop: then what it answered, or threw, must not be used. [step]
    template <class Calls>
    bool complete(std::initializer_list<const hooks::Strategy*> callees, const Calls& calls) {
        before_.clear();
        if (cancel_ != nullptr) {
            for (const hooks::Strategy* callee : callees) before_.push_back(state_of(*callee));
        }
        try {
            calls();
        } catch (const Error&) {
            if (!token_.told()) throw;
        }
        if (token_.told()) return false;
        before_.clear();
        return true;
    }

private:
    const CancelToken* cancel_;
    CancelToken token_;
    std::vector<StrategyState> before_;
};

}  // namespace dsc::run
