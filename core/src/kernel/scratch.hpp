#pragma once
// Arrays that an operation reuses from call to call, so that it allocates nothing after they have
// grown.

#include <memory>

namespace dsc::kernel {

// Each type is defined in the one source file that uses it, so no other file can read or write its
// arrays.
struct EdgeScratch;
struct CollapseScratch;
struct SmoothScratch;
struct VertexSplitScratch;
struct CompoundScratch;
struct MoveScratch;
struct RelabelScratch;
struct RegionScratch;
struct CreaseScratch;

/// Holds the arrays of one operation; they are made at its first call.
template <class T>
class Scratch {
public:
    Scratch() = default;
    Scratch(const Scratch&) = delete;
    Scratch& operator=(const Scratch&) = delete;

    T& get() {
        if (!arrays_) arrays_ = std::make_shared<T>();
        return *arrays_;
    }

private:
    std::shared_ptr<T> arrays_;  // shared_ptr destroys a type that is not known here
};

}  // namespace dsc::kernel
