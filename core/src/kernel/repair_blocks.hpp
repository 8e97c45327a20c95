#pragma once
// Executes a long list of requests in blocks of space, several at a time. The result depends only
// on the complex and the list, never on the number of threads (method.md, section 10).

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include <dsc/base/workers.hpp>

#include "kernel/destinations.hpp"
#include "kernel/operations.hpp"
#include "kernel/vertex_fields.hpp"

namespace dsc::kernel {

/// A request belongs to the block that owns its tet. Each block executes its requests in the order
/// of the list, with a lane and a bench of its own. A request that needs more than the block is
/// deferred before it has changed anything. What is deferred runs in blocks with other borders, and
/// the rest at the end one after the other.
class RepairBlocks {
public:
    /// Shorter lists, and lists that are short beside the number of vertices, are not split: they
    /// run in their order.
    static constexpr std::size_t least_split = 512;

    /// `bench` is that of the serial work.
    RepairBlocks(Workbench& bench, VertexFields& fields, Destinations& destinations)
        : bench_(bench), fields_(fields), destinations_(destinations), blocks_(bench.complex) {}

    /// Request i of the list has been executed when the change clock of its neighbourhood was
    /// `date`.
    using Executed = std::function<void(std::uint32_t i, Outcome outcome, std::uint32_t date)>;

    /// Executes every request once and reports it, in an order in which the dates of a
    /// neighbourhood ascend. `workers`: null for one thread. [step]
    void run(std::span<const repair::Request> requests, Workers* workers, const Executed& executed);

private:
    struct Part;

    unsigned levels() const;
    void assign(std::span<const repair::Request> requests, Workers* workers, unsigned wave);
    VertexId home_of(const repair::Request& request) const;
    void open(std::size_t block, std::span<const repair::Request> requests);
    void work(std::size_t block, std::span<const repair::Request> requests);
    void close(std::size_t block, const Executed& executed);

    Workbench& bench_;
    VertexFields& fields_;
    Destinations& destinations_;
    SpaceBlocks blocks_;
    std::vector<std::shared_ptr<Part>> parts_;
    std::vector<std::uint32_t> waiting_;  // requests, ascending
    std::vector<std::uint8_t> numbers_;   // per entry of waiting_: its block
    std::vector<VertexId> samples_;
};

}  // namespace dsc::kernel
