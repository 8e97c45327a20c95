// The files of a command, each read once.
#include "dsc/run/input_files.hpp"

#include <system_error>
#include <utility>

#include <dsc/base/read_file.hpp>
#include <dsc/run/sha256.hpp>

namespace dsc::run {

InputFiles::Entry& InputFiles::entry(const std::filesystem::path& file) {
    std::error_code error;
    const std::filesystem::path whole = std::filesystem::weakly_canonical(file, error);
    return entries_[error ? file : whole];
}

const std::string& InputFiles::sha256(const std::filesystem::path& file) {
    Entry& known = entry(file);
    if (!known.sha256.empty()) return known.sha256;
    std::string content = read_file(file);
    known.sha256 = run::sha256(content);
    if (cloud::is_cloud_file(file)) known.content = std::move(content);
    return known.sha256;
}

const ReadCloud& InputFiles::cloud(const std::filesystem::path& file,
                                   const std::vector<std::string>& columns) {
    Entry& known = entry(file);
    if (known.cloud && known.columns == columns) return *known.cloud;
    std::string content = known.content ? std::move(*known.content) : read_file(file);
    known.content.reset();
    if (known.sha256.empty()) known.sha256 = run::sha256(content);
    ReadCloud read;
    read.cloud = cloud::parse_cloud(file, std::move(content), &read.report, {columns});
    known.columns = columns;
    return known.cloud.emplace(std::move(read));
}

ReadCloud InputFiles::take_cloud(const std::filesystem::path& file,
                                 const std::vector<std::string>& columns) {
    cloud(file, columns);
    Entry& known = entry(file);
    ReadCloud read = std::move(*known.cloud);
    known.cloud.reset();
    return read;
}

}  // namespace dsc::run
