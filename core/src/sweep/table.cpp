// Reads and writes the job table of a sweep.
#include "table.hpp"

#include <algorithm>
#include <memory>
#include <string_view>

#include <dsc/base/error.hpp>
#include <dsc/base/read_file.hpp>
#include <dsc/config/overrides.hpp>
#include <dsc/config/yaml.hpp>

namespace dsc::sweep {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view table_header = "index\tfolder\toverrides";
constexpr std::string_view points = "points/";

[[noreturn]] void refuse(const fs::path& file, std::size_t line, const std::string& cause) {
    throw IoError("sweep.table", file.string(), std::to_string(line), cause,
                  "restore the table as dsc sweep expand wrote it, or expand into another folder");
}

bool is_point_name(std::string_view name) {
    return name.size() == 12 && std::all_of(name.begin(), name.end(), [](char c) {
               return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f');
           });
}

/// The overrides from byte `begin` of a line on.
config::ConfigNode overrides_of(const fs::path& file, std::size_t number, std::string_view text) {
    const auto source = std::make_shared<const config::SourceText>(
        config::SourceText{config::SourceText::Kind::file, file.string(), std::string(text)});
    try {
        const config::ConfigNode map = config::parse_value(source, 0);
        if (map.is_map()) return map;
    } catch (const ConfigError&) {
        // Reported below, with the line of the table.
    }
    refuse(file, number, "the third column is not a map of overrides");
}

SweepJob job_of(const fs::path& file, std::size_t number, std::size_t index,
                std::string_view line) {
    const std::size_t first = line.find('\t');
    const std::size_t second = first == std::string_view::npos ? first : line.find('\t', first + 1);
    if (second == std::string_view::npos)
        refuse(file, number, "not three columns separated by tabs");
    if (line.substr(0, first) != std::to_string(index))
        refuse(file, number, "its index is not " + std::to_string(index));
    const std::string_view folder = line.substr(first + 1, second - first - 1);
    if (folder.substr(0, points.size()) != points || !is_point_name(folder.substr(points.size())))
        refuse(file, number, "the second column is not the folder of a point");
    return {std::string(folder.substr(points.size())),
            overrides_of(file, number, line.substr(second + 1))};
}

}  // namespace

fs::path table_file(const fs::path& folder) { return folder / "jobs.tsv"; }

std::string point_folder(const std::string& name) { return std::string(points) + name; }

std::string table_text(const std::vector<SweepJob>& jobs) {
    std::string text = std::string(table_header) + "\n";
    for (std::size_t i = 0; i < jobs.size(); ++i) {
        text += std::to_string(i) + "\t" + point_folder(jobs[i].name) + "\t" +
                config::flow_text(jobs[i].overrides) + "\n";
    }
    return text;
}

std::vector<SweepJob> read_table(const fs::path& folder) {
    const fs::path file = table_file(folder);
    const std::string text = read_file(file);
    std::vector<SweepJob> jobs;
    std::size_t number = 0;
    for (std::size_t begin = 0; begin < text.size();) {
        const std::size_t end = text.find('\n', begin);
        ++number;
        if (end == std::string::npos) refuse(file, number, "the line has no end");
        const std::string_view line = std::string_view(text).substr(begin, end - begin);
        if (number == 1) {
            if (line != table_header)
                refuse(file, number, "the header is not index, folder, overrides");
        } else {
            jobs.push_back(job_of(file, number, jobs.size(), line));
        }
        begin = end + 1;
    }
    if (number == 0) refuse(file, 1, "the table is empty");
    return jobs;
}

}  // namespace dsc::sweep
