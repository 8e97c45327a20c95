// Which runs are repeats of each other, and which form pairs.
#include <vector>

#include <doctest/doctest.h>

#include <dsc/statistics/groups.hpp>

using namespace dsc::statistics;

namespace {

Identity run(const std::string& alpha, const std::string& cloud, const std::string& seed) {
    const std::vector<KeyValue> values = {
        {"velocity.alpha", alpha}, {"input.cloud.file", cloud}, {"seed", seed}};
    return identity_of(values);
}

}  // namespace

TEST_CASE("data keys: the cloud and the truth, not the filters") {
    for (const char* path : {"input", "input.cloud", "input.cloud.file", "input.cloud.sample.n",
                             "input.cloud.vary.subsample", "truth"}) {
        CAPTURE(path);
        CHECK(is_data_key(path));
    }
    for (const char* path : {"input.cloud.filters", "input.cloud.filters.0.type",
                             "input.normalize.scale", "velocity.alpha", "inputs", "seed"}) {
        CAPTURE(path);
        CHECK_FALSE(is_data_key(path));
    }
}

TEST_CASE("an identity does not depend on the order of the keys") {
    const std::vector<KeyValue> one = {{"b", "2"}, {"seed", "7"}, {"a", "1"}, {"truth", "t.obj"}};
    const std::vector<KeyValue> other = {{"truth", "t.obj"}, {"a", "1"}, {"b", "2"}, {"seed", "7"}};
    CHECK(identity_of(one).setting == identity_of(other).setting);
    CHECK(identity_of(one).data == "truth=t.obj\n");
    CHECK(identity_of(one).seed == "7");
    CHECK(identity_of({}).setting.empty());
}

TEST_CASE("groups are runs that differ only in the seed; settings go over all clouds") {
    const std::vector<Identity> runs = {run("0.1", "a", "1"), run("0.2", "a", "1"),
                                        run("0.1", "a", "2"), run("0.1", "b", "1"),
                                        run("0.2", "b", "1"), run("0.2", "a", "2")};
    const std::vector<Group> groups = group_runs(runs);
    REQUIRE(groups.size() == 4);
    CHECK(groups[0].runs == std::vector<std::size_t>{0, 2});
    CHECK(groups[1].runs == std::vector<std::size_t>{1, 5});
    CHECK(groups[2].runs == std::vector<std::size_t>{3});
    CHECK(groups[3].runs == std::vector<std::size_t>{4});
    CHECK(groups[0].setting == 0);
    CHECK(groups[1].setting == 1);
    CHECK(groups[2].setting == 0);
    CHECK(groups[3].setting == 1);
}

TEST_CASE("pairs have the same cloud and the same seed") {
    const std::vector<Identity> runs = {
        run("0.1", "a", "1"), run("0.1", "a", "2"), run("0.2", "a", "2"), run("0.2", "a", "3"),
        run("0.1", "b", "1"), run("0.2", "b", "1"), run("0.2", "a", "2"), run("0.1", "a", "2")};
    using Pairs = std::vector<std::pair<std::size_t, std::size_t>>;
    CHECK(pair_runs(runs, runs[0].setting, runs[2].setting) == Pairs{{1, 2}, {4, 5}});
    CHECK(pair_runs(runs, runs[2].setting, runs[0].setting) == Pairs{{2, 1}, {5, 4}});
    CHECK(pair_runs(runs, runs[0].setting, "none").empty());
}
