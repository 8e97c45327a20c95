// Requests that are judged before their turn have the outcomes of requests that are not.
#include "kernel/foresights.hpp"

#include <doctest/doctest.h>

#include <dsc/base/random.hpp>
#include <dsc/geometry/quality.hpp>

#include "shapes.hpp"

using namespace dsc;
using namespace dsc::kernel;
using repair::Operation;

namespace {

// Mostly edge removals and collapses, near each other, so that an early one changes what later ones
// would find.
std::vector<repair::Request> random_requests(const mesh::Complex& c, RandomStream& random) {
    std::vector<repair::Request> requests;
    const std::size_t first = random.index(c.tet_slots());
    for (int n = 0; n < 150; ++n) {
        const auto t = static_cast<TetId>((first + random.index(300)) % c.tet_slots());
        if (!c.tet_alive(t)) continue;
        constexpr std::array kinds = {Operation::edge_removal,   Operation::edge_collapse,
                                      Operation::edge_removal,   Operation::edge_collapse,
                                      Operation::interface_flip, Operation::smooth_laplacian};
        repair::Request request = repair::on_tet(c, t, kinds[random.index(kinds.size())]);
        if (request.operation == Operation::smooth_laplacian)
            request.vertices[0] = c.tet(t).v[random.index(4)];
        if (random.index(3) == 0) request.mode = repair::CollapseMode::bounded;
        request.only_below = random.index(5) == 0 ? 0.6F : 2.0F;
        request.accept_above = static_cast<float>(random.uniform(0.0, 0.5));
        requests.push_back(request);
    }
    return requests;
}

void set_limits(Workbench& bench) {
    const double length = mesh::mean_interface_edge(bench.complex);
    bench.limits = {length, 1e-3, 0.5 * length, geometry::regular_tet_volume(length), 0.5};
}

}  // namespace

TEST_CASE("foresight: requests that are judged ahead have the same outcomes and the same mesh") {
    std::size_t committed = 0, refused = 0, foreseen = 0, chosen = 0, out_of_date = 0;
    for (const test::LabelledMesh& labelled : test::labelled_meshes()) {
        CAPTURE(labelled.name);
        mesh::Complex plain = labelled.complex, judged = labelled.complex;
        Workbench plain_bench(plain), judged_bench(judged);
        set_limits(plain_bench);
        set_limits(judged_bench);
        Workers workers(3);
        Foresights foresights(judged_bench);
        RandomStream random(RandomKey{13, 0, 0, 0});
        for (int round = 0; round < 25; ++round) {
            const std::vector<repair::Request> requests = random_requests(plain, random);
            foresights.start(requests, &workers);
            Workbench judge(judged);
            judge.limits = judged_bench.limits;
            std::vector<Foresight> at_start;
            for (const repair::Request& request : requests)
                at_start.push_back(foresee(judge, request));
            for (std::size_t i = 0; i < requests.size(); ++i) {
                const Foresight known = foresights.of(i);
                if (known.edges > 0) ++foreseen;
                if (known.choice.a != mesh::none) ++chosen;
                if (known.edges == 0 && at_start[i].edges > 0) ++out_of_date;
                const Outcome expected = execute(plain_bench, requests[i]);
                REQUIRE(execute(judged_bench, requests[i], known) == expected);
                ++(expected.refused() ? refused : committed);
            }
        }
        const mesh::TetMesh a = plain.to_mesh(), b = judged.to_mesh();
        CHECK(a.points == b.points);
        CHECK(a.tets == b.tets);
        CHECK(a.labels == b.labels);
        CHECK(plain.clock() == judged.clock());
    }
    CHECK(committed > 1000);
    CHECK(refused > 1000);
    CHECK(foreseen > 1000);
    CHECK(chosen > 300);
    CHECK(out_of_date > 100);
}

TEST_CASE("foresight: one thread foresees nothing, and nothing is certain of a request that names "
          "its edge") {
    mesh::Complex c = test::labelled_meshes().front().complex;
    Workbench bench(c);
    set_limits(bench);
    std::vector<repair::Request> requests;
    for (TetId t = 0; t < c.tet_slots(); ++t)
        requests.push_back(repair::on_tet(c, t, Operation::edge_collapse));
    REQUIRE(requests.size() > 2048);  // at most 1024 are judged at a time
    Foresights foresights(bench);
    foresights.start(requests, nullptr);
    for (std::size_t i = 0; i < requests.size(); ++i) REQUIRE(foresights.of(i).edges == 0);
    Workers workers(2);
    foresights.start(requests, &workers);
    std::size_t foreseen = 0;
    for (std::size_t i = 0; i < requests.size(); ++i)
        foreseen += foresights.of(i).edges > 0 ? 1 : 0;
    CHECK(foreseen > requests.size() / 10);
    // Requests between them of which nothing can be certain change nothing.
    std::vector<repair::Request> mixed;
    for (const repair::Request& request : requests) {
        mixed.push_back(repair::on_tet(c, request.tet, Operation::interface_flip));
        mixed.push_back(request);
    }
    foresights.start(mixed, &workers);
    std::size_t again = 0;
    for (std::size_t i = 0; i < mixed.size(); ++i) {
        const std::size_t edges = foresights.of(i).edges;
        if (i % 2 == 0) REQUIRE(edges == 0);
        again += edges > 0 ? 1 : 0;
    }
    CHECK(again == foreseen);
    for (repair::Request& request : requests)
        request.vertices = {c.tet(request.tet).v[0], c.tet(request.tet).v[1], mesh::none};
    foresights.start(requests, &workers);
    for (std::size_t i = 0; i < requests.size(); ++i) REQUIRE(foresights.of(i).edges == 0);
}
