#include "support.hpp"

#include <fstream>
#include <iterator>
#include <stdexcept>

#include <stdlib.h>

namespace support {
namespace fs = std::filesystem;

fs::path fixture(const std::string& name) {
    return fs::canonical(fs::path(DSC_TEST_PLUGINS) / ("libdsc_" + name + ".so"));
}

TemporaryFolder::TemporaryFolder() {
    std::string pattern = (fs::temp_directory_path() / "dsc-host-XXXXXX").string();
    if (mkdtemp(pattern.data()) == nullptr) throw std::runtime_error("no temporary folder");
    path_ = fs::canonical(pattern);
}
TemporaryFolder::~TemporaryFolder() {
    std::error_code error;
    fs::remove_all(path_, error);
}

fs::path TemporaryFolder::copy(const std::string& name) const {
    const fs::path to = path_ / fixture(name).filename();
    fs::copy_file(fixture(name), to);
    fs::permissions(to, fs::perms::owner_all | fs::perms::group_read | fs::perms::others_read);
    return to;
}

fs::path TemporaryFolder::write(const std::string& name, const std::string& bytes) const {
    const fs::path to = path_ / name;
    std::ofstream(to, std::ios::binary) << bytes;
    fs::permissions(to, fs::perms::owner_all);
    return to;
}

Refusal refusal(const fs::path& file) {
    dsc::host::Host host;
    try {
        host.load(file);
        return {};
    } catch (const dsc::PluginError& error) {
        if (!host.list().empty() || !host.plugins().empty())
            throw std::logic_error("a refused plugin left something behind");
        return {error.code(), error.what()};
    }
}

std::string read(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

}  // namespace support
