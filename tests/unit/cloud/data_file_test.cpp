#include <cstdlib>
#include <optional>

#include <doctest/doctest.h>

#include <dsc/cloud/data_file.hpp>
#include <dsc/cloud/shapes.hpp>

#include "files.hpp"

namespace {
/// Sets DSC_SHARE and puts the old value back.
class Share {
public:
    explicit Share(const std::string& value) {
        if (const char* old = std::getenv("DSC_SHARE")) old_ = old;
        ::setenv("DSC_SHARE", value.c_str(), 1);
    }
    ~Share() {
        if (old_)
            ::setenv("DSC_SHARE", old_->c_str(), 1);
        else
            ::unsetenv("DSC_SHARE");
    }
    Share(const Share&) = delete;
    Share& operator=(const Share&) = delete;

private:
    std::optional<std::string> old_;
};
}  // namespace

TEST_CASE("data files are found in the source tree of the build") {
    const Share empty("");  // as good as unset
    CHECK(std::filesystem::equivalent(
        dsc::cloud::data_file("teapot.bpt"),
        std::filesystem::path(DSC_SOURCE_DIR) / "share/data/teapot.bpt"));
    const std::string error = test::error_of([] { dsc::cloud::data_file("none.bpt"); });
    CHECK(error.find("io.data_file 6: none.bpt: this data file of the project is not at /") == 0);
    CHECK(error.find("share/data/none.bpt; set the environment variable DSC_SHARE to the folder "
                     "that contains data/none.bpt") != std::string::npos);
}

TEST_CASE("DSC_SHARE decides where data files are") {
    const test::Folder folder;
    const Share share(folder.path("s").string());
    const auto teapot_error = [&] {
        return folder.strip(test::error_of([] { dsc::cloud::shape_mesh("teapot"); }));
    };
    CHECK(teapot_error() ==
          "io.data_file 6: teapot.bpt: this data file of the project is not at s/data/teapot.bpt; "
          "set the environment variable DSC_SHARE to the folder that contains data/teapot.bpt");
    std::filesystem::create_directories(folder.path("s/data"));
    folder.write("s/data/teapot.bpt", "31\n");
    CHECK(teapot_error() == "io.syntax 6: s/data/teapot.bpt:1: the teapot has 32 patches; restore "
                            "the file from the source tree");
    folder.write("s/data/teapot.bpt", "32\n3 3\n1 2\n");
    CHECK(teapot_error() == "io.syntax 6: s/data/teapot.bpt:3: the line does not have 3 numbers; "
                            "restore the file from the source tree");
}
