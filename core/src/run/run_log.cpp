// Writes metrics.csv and events.jsonl.
#include "run_log.hpp"

#include <dsc/base/error.hpp>

namespace dsc::run {

RunLog::RunLog(const std::filesystem::path& folder, const cloud::Transform& to_normalised)
    : metrics_file_(folder / "metrics.csv"),
      events_file_(folder / "events.jsonl"),
      metrics_(metrics_file_, std::ios::binary | std::ios::trunc),
      events_(events_file_, std::ios::binary | std::ios::trunc),
      to_normalised_(to_normalised) {
    write(metrics_, metrics_file_, "");
    write(events_, events_file_, "");
}

RunLog::RunLog(const std::filesystem::path& folder, const cloud::Transform& to_normalised,
               const LogState& from)
    : metrics_file_(folder / "metrics.csv"),
      events_file_(folder / "events.jsonl"),
      to_normalised_(to_normalised),
      columns_(from.columns) {
    cut(metrics_file_, from.metrics_bytes);
    cut(events_file_, from.events_bytes);
    metrics_.open(metrics_file_, std::ios::binary | std::ios::app);
    events_.open(events_file_, std::ios::binary | std::ios::app);
    write(metrics_, metrics_file_, "");
    write(events_, events_file_, "");
}

void RunLog::cut(const std::filesystem::path& file, std::uint64_t bytes) {
    std::error_code error;
    const std::uintmax_t size = std::filesystem::file_size(file, error);
    if (!error && size >= bytes) std::filesystem::resize_file(file, bytes, error);
    if (error || size < bytes)
        throw IoError("run.resume", file.string(), "",
                      "is shorter than it was at the checkpoint, or cannot be written",
                      "run without --resume to start again");
}

LogState RunLog::state() {
    const auto bytes = [](std::ofstream& stream) {
        return static_cast<std::uint64_t>(stream.tellp());
    };
    return {bytes(metrics_), bytes(events_), columns_.value_or(0)};
}

void RunLog::add(const StepMetrics& row) {
    if (!columns_ && row.step == 0) {
        waiting_ = row;
        return;
    }
    std::string text;
    if (!columns_) {
        columns_ = row.observers.size();
        text = csv_header(row);
        if (waiting_) text += csv_row(*waiting_, *columns_);
        waiting_.reset();
    }
    write(metrics_, metrics_file_, text + csv_row(row, *columns_));
}

void RunLog::add(const kernel::Event& event) {
    write(events_, events_file_, event_line(event, to_normalised_));
}

void RunLog::add(const ClassFigures& figures) { write(events_, events_file_, class_line(figures)); }

void RunLog::close() {
    if (waiting_) write(metrics_, metrics_file_, csv_header(*waiting_) + csv_row(*waiting_));
    waiting_.reset();
    metrics_.close();
    events_.close();
    if (!metrics_ || !events_) write(metrics_, metrics_file_, "");
}

void RunLog::write(std::ofstream& stream, const std::filesystem::path& file,
                   const std::string& text) {
    stream << text << std::flush;
    if (!stream)
        throw IoError("io.write", file.string(), "", "cannot be written",
                      "check the folder and the space on the disk");
}

}  // namespace dsc::run
