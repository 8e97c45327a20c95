#pragma once
// The active runs of this process, for the case that the process ends before they do.

#include <functional>

#include <dsc/base/error.hpp>

namespace dsc::run {

/// Registers an active run during its lifetime. abandon_runs() calls `abandon`, possibly from any
/// thread. [setup]
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
