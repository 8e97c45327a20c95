// The sink of the library's messages.
#include "dsc/base/log.hpp"

#include <mutex>

namespace dsc {
namespace {
struct Sink {
    std::mutex mutex;
    LogSink write;
};
Sink& sink() {
    static Sink instance;
    return instance;
}
}  // namespace

void set_log_sink(LogSink write) {
    const std::lock_guard lock(sink().mutex);
    sink().write = std::move(write);
}

void log(LogLevel level, std::string_view message) {
    const std::lock_guard lock(sink().mutex);
    if (sink().write) sink().write(level, message);
}

}  // namespace dsc
