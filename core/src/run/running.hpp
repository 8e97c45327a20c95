#pragma once
// The runs of this process, for the case that it ends before they do.

#include <dsc/base/error.hpp>
#include <functional>

namespace dsc::run {

/// A run that goes on, as long as this lives. abandon_runs() calls `abandon`, which may come from any thread. [setup]
class Running {
public:
    using Abandon = std::function<void(const Error&)>;
    explicit Running(Abandon abandon);
    ~Running();
    Running(const Running&) = delete;
    Running& operator=(const Running&) = delete;

private:
    Abandon abandon_;
};

}  // namespace dsc::run
