// Writes, checks and selects the checkpoints of a run.
#include "checkpoints.hpp"

#include <algorithm>
#include <vector>

#include <fmt/format.h>

#include <dsc/base/error.hpp>
#include <dsc/base/log.hpp>
#include <dsc/base/read_file.hpp>
#include <dsc/base/state.hpp>
#include <dsc/io/atomic_file.hpp>
#include <dsc/plugin/fingerprint.hpp>
#include <dsc/run/sha256.hpp>

namespace dsc::run {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view magic = "dsc-checkpoint-3";
constexpr std::size_t seal_size = 64;  // number of hex digits of a SHA-256

std::string name_of(std::uint64_t steps) { return fmt::format("step_{:010}.dscstate", steps); }

/// Oldest first, because the names contain their steps with leading zeros.
std::vector<fs::path> files_of(const fs::path& folder) {
    std::vector<fs::path> files;
    std::error_code error;
    for (auto i = fs::directory_iterator(folder, error); !error && i != fs::directory_iterator();
         i.increment(error)) {
        const std::string name = i->path().filename().string();
        if (name.rfind("step_", 0) == 0 && i->path().extension() == ".dscstate")
            files.push_back(i->path());
    }
    std::sort(files.begin(), files.end());
    return files;
}

std::string packed(const Checkpoint& c) {
    StateWriter out;
    out.text(magic);
    out.text(plugin::core_fingerprint());
    out.text(c.hash);
    out.value(c.steps);
    out.value(c.seconds);
    out.value(c.log);
    out.text(c.state);
    std::string bytes = out.take();
    return bytes + sha256(bytes);
}

[[noreturn]] void unusable(const std::string& cause) {
    throw IoError("checkpoint.unusable", "checkpoint", "", cause,
                  "start the run again without --resume");
}

Checkpoint unpacked(const std::string& file) {
    if (file.size() < seal_size) unusable("it is truncated");
    const std::string_view bytes(file.data(), file.size() - seal_size);
    if (sha256(bytes) != file.substr(bytes.size()))
        unusable("it is damaged: its SHA-256 does not match");
    StateReader in(bytes);
    if (in.text() != magic) unusable("it was written by another version");
    if (in.text() != plugin::core_fingerprint()) unusable("it was written by another build of dsc");
    Checkpoint c;
    c.hash = in.text();
    in.value(c.steps);
    in.value(c.seconds);
    in.value(c.log);
    c.state = in.text();
    return c;
}

}  // namespace

void Checkpoints::write(const Checkpoint& checkpoint) const {
    std::error_code error;
    fs::create_directories(folder_, error);
    if (error)
        throw IoError("run.folder", folder_.string(), "",
                      fmt::format("cannot be created: {}", error.message()),
                      "choose another folder with -o or make this one writable");
    io::write_file(folder_ / name_of(checkpoint.steps), packed(checkpoint));
    std::vector<fs::path> files = files_of(folder_);
    for (std::size_t i = 0; i + keep_ < files.size(); ++i) fs::remove(files[i], error);
}

std::optional<Checkpoint> Checkpoints::last(const std::string& hash,
                                            const std::function<void(const Checkpoint&)>& require,
                                            std::string* reason) const {
    std::vector<fs::path> files = files_of(folder_);
    std::vector<std::string> refused;
    for (auto file = files.rbegin(); file != files.rend(); ++file) {
        try {
            Checkpoint checkpoint = unpacked(read_file(*file));
            if (checkpoint.hash != hash) unusable("it belongs to another experiment");
            require(checkpoint);
            for (const std::string& text : refused)
                log(LogLevel::warning, fmt::format("{}; using the previous one", text));
            return checkpoint;
        } catch (const Error& error) {
            refused.push_back(fmt::format("{} cannot be used: {}", file->string(), error.cause()));
        }
    }
    if (!refused.empty()) *reason = refused.front();
    return std::nullopt;
}

}  // namespace dsc::run
