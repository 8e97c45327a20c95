// The exceptions of the library.
#include "dsc/base/error.hpp"

namespace dsc {

// Out-of-line destructors place the type information of every class in this library, so that the
// host can catch a type that a plugin throws.
Error::~Error() = default;
UsageError::~UsageError() = default;
ConfigError::~ConfigError() = default;
PluginError::~PluginError() = default;
StrategyError::~StrategyError() = default;
GeometryError::~GeometryError() = default;
IoError::~IoError() = default;
CancelledError::~CancelledError() = default;

namespace {

std::string message_of(std::string_view place, std::string_view cause, std::string_view remedy) {
    std::string text(place);
    if (!place.empty()) text += ": ";
    text += cause;
    if (!remedy.empty()) text.append("; ").append(remedy);
    return text;
}

std::string place_of(std::string_view file, std::string_view line) {
    std::string place(file);
    if (!line.empty()) place.append(":").append(line);
    return place;
}

}  // namespace

Error::Error(ExitCode exit_code, std::string code, std::string_view place, std::string_view cause,
             std::string_view remedy)
    : std::runtime_error(message_of(place, cause, remedy)),
      exit_code_(exit_code),
      code_(std::move(code)),
      place_(place),
      cause_(cause),
      remedy_(remedy) {}

IoError::IoError(std::string code, std::string_view file, std::string_view line,
                 std::string_view cause, std::string_view remedy)
    : Error(ExitCode::io, std::move(code), place_of(file, line), cause, remedy) {}

}  // namespace dsc
