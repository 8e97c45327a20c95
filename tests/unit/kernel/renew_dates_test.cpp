// A run whose dates are renewed on the way has the same result as a run whose dates are not.
#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <doctest/doctest.h>

#include <dsc/base/random.hpp>
#include <dsc/kernel/deformer.hpp>
#include <dsc/mesh/adopt.hpp>
#include <dsc/mesh/date_ranks.hpp>
#include <dsc/surface/surface_view.hpp>

#include "policy.hpp"
#include "shapes.hpp"

using namespace dsc;
using namespace dsc::kernel;
using mesh::TetId;
using mesh::VertexId;

namespace {

constexpr std::uint32_t limit = 1U << 31U;
constexpr int steps = 7;

// A ball that turns and shrinks, with the audit on. Its clock begins at `clock`.
class Run {
public:
    Run(std::uint32_t clock, Workers* workers)
        : workers_(workers), deformer_(ball(clock), audited(), workers) {}

    void step() {
        const mesh::Complex& c = complex();
        surface::build_view(c, view_, workers_, &memory_);
        std::vector<Vec3> displacements;
        for (const Vec3& p : view_.positions) {
            const Vec3 shake(random_.uniform(-1, 1), random_.uniform(-1, 1),
                             random_.uniform(-1, 1));
            displacements.push_back(0.08 * Vec3(-p.y(), p.x(), 0) - 0.03 * p + 0.01 * shake);
        }
        report_ = deformer_.step(view_.vertex_ids, displacements, test::quality_policy());
        surface::build_view(c, view_, workers_, &memory_);
    }
    const mesh::Complex& complex() const { return deformer_.complex(); }
    const surface::SurfaceView& view() const { return view_; }
    const StepReport& report() const { return report_; }

private:
    static mesh::Complex ball(std::uint32_t clock) {
        mesh::Complex c = mesh::adopt(test::ball_grid(28, 0.9), "ball");
        c.advance_clock(clock);
        return c;
    }
    static DeformerOptions audited() {
        DeformerOptions options;
        options.audit = true;
        return options;
    }

    Workers* workers_;
    Deformer deformer_;
    surface::ViewMemory memory_;
    surface::SurfaceView view_;
    StepReport report_;
    RandomStream random_{RandomKey{5, 0, 0, 0}};
};

void require_same(const Run& a, const Run& b) {
    const mesh::TetMesh x = a.complex().to_mesh(), y = b.complex().to_mesh();
    REQUIRE(x.points == y.points);
    REQUIRE(x.tets == y.tets);
    REQUIRE(x.labels == y.labels);
    REQUIRE(a.view().births == b.view().births);
    REQUIRE(a.view().faces == b.view().faces);
    REQUIRE(a.view().face_tets == b.view().face_tets);
    REQUIRE(a.report().rounds == b.report().rounds);
    for (std::size_t i = 0; i < a.report().operations.size(); ++i) {
        REQUIRE(a.report().operations[i].committed == b.report().operations[i].committed);
        REQUIRE(a.report().operations[i].refused == b.report().operations[i].refused);
    }
}

std::vector<std::uint32_t> dates(const mesh::Complex& c) {
    std::vector<std::uint32_t> all = {c.clock(), c.shape_clock()};
    for (TetId t = 0; t < c.tet_slots(); ++t) {
        all.push_back(c.date(t));
        all.push_back(c.birth_date(t));
    }
    for (VertexId v = 0; v < c.vertex_slots(); ++v) {
        all.push_back(c.vertex_date(v));
        all.push_back(c.shape_date(v));
    }
    return all;
}

}  // namespace

TEST_CASE("a run whose clock comes near its end renews the dates, with the same result") {
    Workers two(2);
    for (Workers* workers : {static_cast<Workers*>(nullptr), &two}) {
        Run plain(1, workers);
        std::array<std::uint32_t, steps> clock{};
        for (std::uint32_t& at : clock) {
            plain.step();
            at = plain.complex().clock();
        }
        REQUIRE(plain.view().vertex_count() > 512);  // enough for a star loop of two threads
        for (const int reaches : {0, 2, steps - 2}) {
            CAPTURE(reaches);
            Run same(1, workers),
                late(limit - clock[static_cast<std::size_t>(reaches)] + 1, workers);
            for (int i = 0; i < steps; ++i) {
                same.step();
                late.step();
                require_same(same, late);
                CHECK((late.complex().clock() < limit) == (i != reaches));
            }
            CHECK(late.complex().clock() < clock.back() + 2 * dates(late.complex()).size());
        }
    }
}

TEST_CASE("new dates have the order of the old ones") {
    Run run(limit - 1, nullptr);
    run.step();
    mesh::Complex c = run.complex();
    const std::vector<std::uint32_t> before = dates(c);
    const mesh::DateRanks ranks = c.renew_dates();
    const std::vector<std::uint32_t> after = dates(c);
    CHECK(c.clock() <= before.size() + 3);
    RandomStream random(RandomKey{7, 0, 0, 0});
    std::size_t different = 0;
    for (int i = 0; i < 100000; ++i) {
        const std::size_t a = random.index(before.size()), b = random.index(before.size());
        REQUIRE((before[a] < before[b]) == (after[a] < after[b]));
        different += before[a] != before[b] ? 1 : 0;
        // A date that somebody remembers need not be one of the complex.
        const std::uint32_t known = before[b] + static_cast<std::uint32_t>(random.index(3));
        REQUIRE((before[a] > known) == (after[a] > ranks(known)));
    }
    CHECK(different > 1000);
    CHECK(ranks(0) == 0);
}

TEST_CASE("new dates leave the lists of changes as they are") {
    Run run(limit - 1, nullptr);
    run.step();
    mesh::Complex plain = run.complex();
    LargeVector<TetId> taken;
    std::vector<VertexId> reshaped;
    plain.take_changes(taken);
    plain.take_reshaped(reshaped);
    plain.start_watch();
    std::vector<TetId> star;
    // Moves every vertex from `first` on, with `stride`, to where it is, and relabels a tet of
    // some.
    const auto change = [&star](mesh::Complex& c, VertexId first, VertexId stride) {
        for (VertexId v = first; v < c.vertex_slots(); v += stride) {
            if (!c.vertex_alive(v)) continue;
            c.star(v, star);
            c.move(v, c.position(v), star);
            const TetId tet = star.front();
            if (v % 5 == 0) c.relabel(std::span(&tet, 1), 1 - c.label(tet));
        }
    };
    change(plain, 0, 7);
    mesh::Complex renewed = plain;
    renewed.renew_dates();
    for (mesh::Complex* c : {&plain, &renewed}) change(*c, 2, 11);
    REQUIRE(plain.changes().size() > 1000);
    REQUIRE(plain.changes().size() < plain.tet_count());
    CHECK(std::equal(plain.changes().begin(), plain.changes().end(), renewed.changes().begin(),
                     renewed.changes().end()));
    CHECK(plain.watched().size() == plain.changes().size());
    CHECK(std::equal(plain.watched().begin(), plain.watched().end(), renewed.watched().begin(),
                     renewed.watched().end()));
    std::vector<VertexId> reshaped_after;
    plain.take_reshaped(reshaped);
    renewed.take_reshaped(reshaped_after);
    CHECK(reshaped.size() > 10);
    CHECK(reshaped == reshaped_after);
}
