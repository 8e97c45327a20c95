// The clocks of det.clock: a strategy that reads a clock shows itself at every time of every day.
#include <algorithm>
#include <ctime>
#include <functional>
#include <string>

#include <doctest/doctest.h>

#include "clock_shift.hpp"

namespace {

/// What a strategy may do with the time: the answers of two times are the same or not.
using Answer = std::function<int(const std::tm&)>;

int answer_at(const Answer& answer, std::time_t time) {
    std::tm parts{};
    gmtime_r(&time, &parts);
    return answer(parts);
}

/// Whether the answer is another one by one of the clocks that differ from `time` by constants.
bool shows(const Answer& answer, std::time_t time) {
    const int now = answer_at(answer, time);
    return std::any_of(dsc::conformance::other_times.begin(), dsc::conformance::other_times.end(),
                       [&](const auto& shift) {
                           return shift.seconds_more == 0 &&
                                  answer_at(answer, time + shift.seconds) != now;
                       });
}

struct Reader {
    std::string what;
    Answer answer;
};

}  // namespace

TEST_CASE("whenever det.clock runs, a strategy that reads the time or the date shows itself") {
    const Reader readers[] = {
        {"before and after noon", [](const std::tm& t) { return t.tm_hour / 12; }},
        {"office hours", [](const std::tm& t) { return t.tm_hour >= 9 && t.tm_hour < 17; }},
        {"the hours before midnight", [](const std::tm& t) { return t.tm_hour >= 19; }},
        {"the halves of an hour", [](const std::tm& t) { return t.tm_min / 30; }},
        {"every second day", [](const std::tm& t) { return t.tm_yday % 2; }},
        {"the weekend", [](const std::tm& t) { return t.tm_wday == 0 || t.tm_wday == 6; }},
        {"the month", [](const std::tm& t) { return t.tm_mon; }},
        {"summer", [](const std::tm& t) { return t.tm_mon >= 5 && t.tm_mon < 8; }},
        {"every second year", [](const std::tm& t) { return t.tm_year % 2; }}};
    constexpr std::time_t begin = 1767225600;  // 2026-01-01
    constexpr std::time_t five_years = 1826 * 86400L;
    for (const Reader& reader : readers) {
        INFO("it looks at ", reader.what);
        std::size_t missed = 0;
        std::time_t first = 0;
        for (std::time_t time = begin; time < begin + five_years; time += 7 * 60 + 3) {
            if (shows(reader.answer, time)) continue;
            if (missed++ == 0) first = time;
        }
        CAPTURE(first);
        CHECK(missed == 0);
    }
}
