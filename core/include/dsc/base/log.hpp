#pragma once
// Messages of the library: the application installs a sink for them; the library never prints.

#include <functional>
#include <string_view>

namespace dsc {

enum class LogLevel { debug, info, warning, error };

using LogSink = std::function<void(LogLevel, std::string_view)>;

/// Installs the sink; an empty one drops all messages (the default). [setup]
void set_log_sink(LogSink sink);

/// Passes one line without newline to the sink. Safe from any thread. [parallel]
void log(LogLevel level, std::string_view message);

}  // namespace dsc
