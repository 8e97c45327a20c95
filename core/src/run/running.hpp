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
    using Rescue = std::function<void()>;
    explicit Running(Abandon abandon);
    ~Running();
    Running(const Running&) = delete;
    Running& operator=(const Running&) = delete;

    /// From now on abandon_runs() also calls `rescue`, which saves the present state, if the run
    /// does not change it at that time. Empty: there is nothing to save. [step]
    void set_rescue(Rescue rescue);

private:
    friend void abandon_runs(const Error&, bool);
    Abandon abandon_;
    Rescue rescue_;
};

}  // namespace dsc::run
