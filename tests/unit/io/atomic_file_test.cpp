#include <csignal>

#include <sys/resource.h>
#include <sys/stat.h>

#include <doctest/doctest.h>

#include <dsc/base/read_file.hpp>
#include <dsc/base/replace_file.hpp>
#include <dsc/io/atomic_file.hpp>

#include "files.hpp"

using namespace dsc;
using namespace dsc::io;

namespace {
constexpr auto write_x = [](const std::filesystem::path& f) { write_file(f, "x"); };
}

TEST_CASE("a file is replaced whole and nothing is left beside it") {
    const test::Folder folder;
    write_file(folder / "a.txt", "one");
    write_file(folder / "a.txt", std::string("tw\0o", 4));
    CHECK(read_file(folder / "a.txt") == std::string("tw\0o", 4));
    CHECK(folder.files() == 1);
    write_file(folder / "empty", "");
    CHECK(read_file(folder / "empty").empty());
}

TEST_CASE("a path without a folder is written to the current one") {
    const test::Folder folder;
    const auto before = std::filesystem::current_path();
    std::filesystem::current_path(folder.path());
    write_file("plain.txt", "here");
    std::filesystem::current_path(before);
    CHECK(test::content_of(folder / "plain.txt") == "here");
}

TEST_CASE("new files have the permissions that the user's mask leaves") {
    const test::Folder folder;
    const ::mode_t before = ::umask(027);
    write_file(folder / "a", "x");
    ::umask(before);
    struct ::stat facts {};
    REQUIRE(::stat((folder / "a").c_str(), &facts) == 0);
    CHECK((facts.st_mode & 0777) == 0640);
}

TEST_CASE("a symbolic link stays and its target is replaced") {
    const test::Folder folder;
    folder.with("real", "old");
    std::filesystem::create_symlink(folder / "real", folder / "link");
    write_file(folder / "link", "new");
    CHECK(std::filesystem::is_symlink(folder / "link"));
    CHECK(test::content_of(folder / "real") == "new");
}

TEST_CASE("a symbolic link to a file that is not there yet stays, and the file comes into being") {
    const test::Folder folder;
    std::filesystem::create_directory(folder / "disk");
    std::filesystem::create_symlink("disk/real", folder / "link");
    std::filesystem::create_symlink("link", folder / "second");
    write_file(folder / "second", "new");
    CHECK(std::filesystem::is_symlink(folder / "second"));
    CHECK(std::filesystem::is_symlink(folder / "link"));
    CHECK(test::content_of(folder / "disk/real") == "new");
    std::filesystem::create_symlink("round", folder / "round");
    CHECK(test::refusal(folder / "round", write_x).code == "io.write");
}

TEST_CASE("a file that was there keeps its mode and its owner") {
    const test::Folder folder;
    const std::string file = folder.with("a", "old");
    REQUIRE(::chmod(file.c_str(), 0604) == 0);
    const bool other_owner = ::chown(file.c_str(), 4711, 4712) == 0;  // only the superuser may
    write_file(file, "new");
    struct ::stat facts {};
    REQUIRE(::stat(file.c_str(), &facts) == 0);
    CHECK((facts.st_mode & 07777) == 0604);
    if (other_owner) CHECK(facts.st_uid == 4711);
    if (other_owner) CHECK(facts.st_gid == 4712);
    CHECK(test::content_of(file) == "new");
}

TEST_CASE("hard links stay together") {
    const test::Folder folder;
    folder.with("a", "a long old content");
    std::filesystem::create_hard_link(folder / "a", folder / "b");
    write_file(folder / "a", "new");
    CHECK(test::content_of(folder / "b") == "new");
    CHECK(std::filesystem::hard_link_count(folder / "a") == 2);
    CHECK(folder.files() == 2);
}

TEST_CASE("whether a file can be replaced is known before, and nothing changes") {
    const test::Folder folder;
    require_replaceable(folder / "new");
    CHECK(folder.files() == 0);
    folder.with("old", "content");
    require_replaceable(folder / "old");
    CHECK(test::content_of(folder / "old") == "content");
    constexpr auto require = [](const std::filesystem::path& f) { require_replaceable(f); };
    CHECK(test::refusal(folder / "none/a.txt", require).message ==
          test::refusal(folder / "none/a.txt", write_x).message);
    // not even for the superuser
    CHECK(test::refusal("/sys/kernel/x.obj", require).code == "io.write");
    CHECK(test::refusal("/dev/null", require).code == "io.write");
}

TEST_CASE("what cannot be written is named") {
    const test::Folder folder;
    auto found = test::refusal(folder / "none/a.txt", write_x);
    CHECK(found.code == "io.write");
    CHECK(found.message == "FILE: cannot be written: No such file or directory; create the folder "
                           "first or name another one");
    std::filesystem::create_directory(folder / "dir");
    CHECK(test::refusal(folder / "dir", write_x).message == "FILE: is a directory; name a file");
    CHECK(test::refusal("/dev/null", write_x).message ==
          "FILE: is not a regular file; name a file that may be replaced");
    CHECK(test::refusal(folder / std::string(300, 'n'), write_x).code == "io.write");
    CHECK(std::filesystem::exists("/dev/null"));
    if (::geteuid() == 0) {
        MESSAGE("skipped for root, who may write everywhere: read-only folder");
    } else {
        std::filesystem::permissions(folder / "dir", std::filesystem::perms::owner_read |
                                                         std::filesystem::perms::owner_exec);
        found = test::refusal(folder / "dir/a.txt", write_x);
        std::filesystem::permissions(folder / "dir", std::filesystem::perms::owner_all);
        CHECK(found.message ==
              "FILE: cannot be written: Permission denied; name a folder that you may write to");
    }
}

TEST_CASE("a disk that fills up: one message, the old file stays, no temporary file") {
    const test::Folder folder;
    write_file(folder / "a.bin", "old");
    // A limit on the size of files fails in the middle of the writing, as a full disk does.
    struct ::rlimit before {};
    REQUIRE(::getrlimit(RLIMIT_FSIZE, &before) == 0);
    struct ::rlimit small = before;
    small.rlim_cur = 100000;
    const auto handler = std::signal(SIGXFSZ, SIG_IGN);
    REQUIRE(::setrlimit(RLIMIT_FSIZE, &small) == 0);
    const auto found = test::refusal(
        folder / "a.bin", [](const auto& f) { write_file(f, std::string(300000, 'x')); });
    ::setrlimit(RLIMIT_FSIZE, &before);
    std::signal(SIGXFSZ, handler);
    CHECK(found.code == "io.write");
    CHECK(found.message == "FILE: cannot be written: File too large; name another file");
    CHECK(test::content_of(folder / "a.bin") == "old");
    CHECK(folder.files() == 1);
}

TEST_CASE("a device without room") {
    if (!std::filesystem::exists("/dev/full")) return;
    // /dev/full is refused as a device before anything is written to it.
    CHECK(test::refusal("/dev/full", write_x).code == "io.write");
}
