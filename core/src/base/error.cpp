#include <dsc/base/error.hpp>

namespace dsc {

// Out-of-line destructors give every class one home for its type information, so that a type thrown by a plugin is
// the type that the host catches.
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
