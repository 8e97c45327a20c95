// The exceptions of the library.
#include <dsc/base/error.hpp>

namespace dsc {

// Out-of-line destructors place the type information of every class in this library, so that the host can catch a type that a
// plugin throws.
Error::~Error() = default;
UsageError::~UsageError() = default;
ConfigError::~ConfigError() = default;
PluginError::~PluginError() = default;
StrategyError::~StrategyError() = default;
GeometryError::~GeometryError() = default;
IoError::~IoError() = default;
CancelledError::~CancelledError() = default;

namespace {
std::string place_message(std::string_view file, std::string_view place, std::string_view cause,
                          std::string_view remedy) {
    std::string text{file};
    if (!place.empty()) text.append(":").append(place);
    text.append(": ").append(cause);
    if (!remedy.empty()) text.append("; ").append(remedy);
    return text;
}
}  // namespace

IoError::IoError(std::string code, std::string_view file, std::string_view place, std::string_view cause,
                 std::string_view remedy)
    : Error(ExitCode::io, std::move(code), place_message(file, place, cause, remedy)) {}

}  // namespace dsc
