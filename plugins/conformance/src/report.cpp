#include <array>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <dsc/conformance/check.hpp>
#include <dsc/text/words.hpp>

namespace dsc::conformance {
namespace {

constexpr std::array all_statuses = {Status::pass, Status::warn,  Status::skip,
                                     Status::fail, Status::crash, Status::timeout};

std::string xml(std::string_view text) {
    std::string out;
    for (const char c : text) {
        switch (c) {
            case '<': out += "&lt;"; break;
            case '>': out += "&gt;"; break;
            case '&': out += "&amp;"; break;
            case '"': out += "&quot;"; break;
            default:
                // XML 1.0 has no other control characters.
                out += static_cast<unsigned char>(c) < 0x20 && c != '\n' && c != '\t' ? '?' : c;
        }
    }
    return out;
}

std::string junit_case(const Report& report, const Outcome& o) {
    const std::string owner =
        o.strategy.empty() ? report.plugin : report.plugin + ": " + o.strategy;
    std::string out = fmt::format("  <testcase classname=\"{}\" name=\"{}\" time=\"{:.3f}\"",
                                  xml(owner), o.test, o.seconds);
    if (o.status == Status::pass) return out + "/>\n";
    out += ">\n";
    if (o.status == Status::skip) {
        out += fmt::format("    <skipped message=\"{}\"/>\n", xml(o.message));
    } else if (o.status == Status::warn) {
        out += fmt::format("    <system-out>warning: {}</system-out>\n", xml(o.message));
    } else {
        const char* element = o.status == Status::fail ? "failure" : "error";
        out += fmt::format("    <{} message=\"{}\" type=\"{}\"/>\n", element, xml(o.message),
                           text::lower_case(name(o.status)));
    }
    return out + "  </testcase>\n";
}

}  // namespace

std::string text(const Outcome& o) {
    const std::string owner = o.strategy.empty() ? "library" : o.strategy;
    std::string line = fmt::format("{:<8}{:<17}{:<34}", name(o.status), o.test, owner);
    if (!o.message.empty()) line += " " + o.message;
    while (!line.empty() && (line.back() == ' ' || line.back() == '\n')) line.pop_back();
    return line + "\n";
}

std::string text(const Report& report) {
    std::string out;
    for (const Outcome& o : report.outcomes) out += text(o);
    return out + sums(report);
}

std::string sums(const Report& report) {
    std::string out =
        fmt::format("{} {} at level {}, seed {}:", report.file.filename().string(),
                    report.passed() ? "passes" : "FAILS", name(report.level), report.seed);
    for (const Status status : all_statuses) {
        if (report.count(status) > 0)
            out += fmt::format(" {} {}", report.count(status), text::lower_case(name(status)));
    }
    return out + "\n";
}

std::string json(const Report& report) {
    nlohmann::ordered_json outcomes = nlohmann::ordered_json::array();
    for (const Outcome& o : report.outcomes) {
        outcomes.push_back({{"test", o.test},
                            {"strategy", o.strategy},
                            {"status", text::lower_case(name(o.status))},
                            {"message", o.message},
                            {"seconds", o.seconds}});
    }
    return nlohmann::ordered_json{{"file", report.file.string()},
                                  {"plugin", report.plugin},
                                  {"level", std::string(name(report.level))},
                                  {"seed", report.seed},
                                  {"passed", report.passed()},
                                  {"outcomes", outcomes}}
               .dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) +
           "\n";
}

std::string junit(const Report& report) {
    double seconds = 0;
    for (const Outcome& o : report.outcomes) seconds += o.seconds;
    std::string out = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";
    out += fmt::format("<testsuite name=\"dsc plugin check {}\" tests=\"{}\" failures=\"{}\" "
                       "errors=\"{}\" skipped=\"{}\" time=\"{:.3f}\">\n",
                       xml(report.file.filename().string()), report.outcomes.size(),
                       report.count(Status::fail),
                       report.count(Status::crash) + report.count(Status::timeout),
                       report.count(Status::skip), seconds);
    for (const Outcome& o : report.outcomes) out += junit_case(report, o);
    return out + "</testsuite>\n";
}

}  // namespace dsc::conformance
