// Witnesses of det.clock: the time of day, the date, and how long something took. All of them give
// the same answers twice within a second.
#include <chrono>
#include <ctime>

#include "witness.hpp"

namespace {

class Day final : public witness::Timed {
    using Timed::Timed;
    double factor() const override { return std::time(nullptr) / 86400 % 2 == 0 ? 1.0 : 0.5; }
};

class Month final : public witness::Timed {
    using Timed::Timed;
    double factor() const override {
        const std::time_t now = std::time(nullptr);
        std::tm parts{};
        ::gmtime_r(&now, &parts);
        return 1.0 + parts.tm_mon;
    }
};

// Gives up after a minute of CPU time.
class Budget final : public witness::Timed {
    using Timed::Timed;
    double factor() const override {
        const std::clock_t begin = std::clock();
        double sum = 1.0;
        for (int i = 0; i < 100 && std::clock() - begin < 60 * CLOCKS_PER_SEC; ++i) sum += 0.01;
        return sum;
    }
};

// Works as long as a second has not passed.
class Patience final : public witness::Timed {
    using Timed::Timed;
    double factor() const override {
        const auto begin = std::chrono::steady_clock::now();
        const auto patience = std::chrono::seconds(10);
        double sum = 1.0;
        for (int i = 0; i < 100 && std::chrono::steady_clock::now() - begin < patience; ++i)
            sum += 0.01;
        return sum;
    }
};

class Morning final : public witness::Timed {
    using Timed::Timed;
    double factor() const override {
        const auto now = std::chrono::system_clock::now().time_since_epoch();
        return std::chrono::duration_cast<std::chrono::hours>(now).count() % 24 < 12 ? 1.0 : 0.5;
    }
};

}  // namespace

DSC_PLUGIN("bad_clock", "1.0.0", "MIT", "Witnesses of det.clock") {
    registrar.add<Day>("det_clock", "rests on every second day");
    registrar.add<Month>("det_clock_month", "knows the month");
    registrar.add<Budget>("det_clock_budget", "has a budget of CPU time");
    registrar.add<Patience>("det_clock_patience", "gives up after some seconds");
    registrar.add<Morning>("det_clock_morning", "is fast in the morning");
}
