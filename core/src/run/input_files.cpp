// The files of a command, each read once.
#include "dsc/run/input_files.hpp"

#include <system_error>
#include <utility>

#include <dsc/base/error.hpp>
#include <dsc/base/read_file.hpp>
#include <dsc/run/sha256.hpp>

namespace dsc::run {

namespace {

template <class T>
void append(std::string& bytes, const std::vector<T>& values) {
    bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
}

}  // namespace

bool is_memory(const std::filesystem::path& file) {
    const std::string name = file.string();
    return name.size() > memory_folder.size() + 1 && name.rfind(memory_folder, 0) == 0 &&
           name[memory_folder.size()] == '/';
}

std::filesystem::path InputFiles::add_cloud(const std::string& name, cloud::Cloud cloud) {
    const std::filesystem::path file = std::filesystem::path(memory_folder) / name;
    std::string bytes;
    append(bytes, cloud.points);
    append(bytes, cloud.normals);
    append(bytes, cloud.colours);
    Entry& known = entries_[file];
    known = {};
    known.sha256 = run::sha256(bytes);
    known.memory_bytes = bytes.size();
    ReadCloud& read = known.cloud.emplace();
    read.report.format = "memory";
    read.report.points = cloud.points.size();
    read.cloud = std::move(cloud);
    return file;
}

void InputFiles::add_text(const std::filesystem::path& name, const std::string& text) {
    Entry& known = entries_[name];
    known = {};
    known.sha256 = run::sha256(text);
    known.memory_bytes = text.size();
}

bool InputFiles::exists(const std::filesystem::path& file) const {
    std::error_code ignored;
    return entries_.count(file) != 0 || std::filesystem::exists(file, ignored);
}

std::uintmax_t InputFiles::bytes(const std::filesystem::path& file) {
    if (const auto& size = entry(file).memory_bytes) return *size;
    std::error_code error;
    const std::uintmax_t size = std::filesystem::file_size(file, error);
    if (error)
        throw IoError("io.open", file.string(), "", "cannot be read (" + error.message() + ")",
                      "check its permissions");
    return size;
}

InputFiles::Entry& InputFiles::entry(const std::filesystem::path& file) {
    if (const auto known = entries_.find(file); known != entries_.end()) return known->second;
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
    if (known.cloud && (known.memory_bytes || known.columns == columns)) return *known.cloud;
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
    if (known.memory_bytes) return *known.cloud;  // it could not be read again
    ReadCloud read = std::move(*known.cloud);
    known.cloud.reset();
    return read;
}

}  // namespace dsc::run
