#pragma once
// Judges repair requests on several threads before their turn. A refusal that is certain then need
// not be found again in the order of the list (method.md, section 10).

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <dsc/base/workers.hpp>

#include "kernel/operations.hpp"

namespace dsc::kernel {

class Foresights {
public:
    /// The bench that will execute the requests.
    explicit Foresights(const Workbench& bench) : bench_(bench) {}

    /// Begins with a list of requests, which must stay as it is. `workers`: null for one thread,
    /// which foresees nothing. [step]
    void start(std::span<const repair::Request> requests, Workers* workers);
    /// What is certain of request i now. Call it in ascending order, before the request is
    /// executed. [step]
    Foresight of(std::size_t i);
    /// Forgets all that depends on dates. Between two lists of requests. [step]
    void forget_dates() { judges_.clear(); }

private:
    static constexpr std::size_t most = 1024, block = 32;  // requests that are judged together, and
                                                           // by one thread
    struct Judged {
        std::size_t request;
        Foresight known;
        std::array<mesh::VertexId, 4> vertices;  // of the tet; only if something is known
    };

    bool holds(const Judged& judged) const;
    void look(std::size_t first);
    void judge(Workbench& bench, Judged& judged) const;
    void prefetch_tets(std::size_t i, std::size_t end) const;
    void prefetch_stars(std::size_t i) const;

    const Workbench& bench_;
    std::span<const repair::Request> requests_;
    Workers* workers_ = nullptr;
    std::vector<std::unique_ptr<Workbench>> judges_;  // per block
    std::vector<Judged> judged_;                      // in ascending order of the requests
    std::size_t next_ = 0;                            // of judged_, that nobody has asked for
    std::size_t end_ = 0;                             // of the requests that have been looked at
    std::uint32_t date_ = 0;                          // the change clock when they were judged
};

}  // namespace dsc::kernel
