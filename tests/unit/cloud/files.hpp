#pragma once
// A folder for the small files of a test, and the texts of errors.

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>

#include <dsc/base/error.hpp>

namespace test {

/// Removed with all its files at the end.
class Folder {
public:
    Folder() {
        std::string pattern =
            (std::filesystem::temp_directory_path() / "dsc_cloud_XXXXXX").string();
        if (!::mkdtemp(pattern.data())) std::abort();
        path_ = pattern;
    }
    ~Folder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;

    std::filesystem::path path(std::string_view name) const { return path_ / name; }
    std::filesystem::path write(std::string_view name, std::string_view bytes) const {
        std::filesystem::remove(path(name));  // ext4 waits for the disk when a file is cut to
                                              // nothing and rewritten
        std::ofstream(path(name), std::ios::binary)
            .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
        return path(name);
    }
    /// `text` with the folder's path cut out, so that a message can be compared whole.
    std::string strip(std::string text) const {
        const std::string prefix = path_.string() + "/";
        for (std::size_t at = text.find(prefix); at != std::string::npos; at = text.find(prefix))
            text.erase(at, prefix.size());
        return text;
    }

private:
    std::filesystem::path path_;
};

inline std::string slurp(const std::filesystem::path& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

/// "CODE EXIT: MESSAGE" of the error that `call` throws; "no error" if none.
template <class Call>
std::string error_of(const Call& call) {
    try {
        call();
    } catch (const dsc::Error& error) {
        return error.code() + " " + std::to_string(static_cast<int>(error.exit_code())) + ": " +
               error.what();
    }
    return "no error";
}

}  // namespace test
