// Names the file that is being loaded if the user has to end the program.
#include "load_guard.hpp"

#include <string_view>

#include <dsc/base/error.hpp>

#include "crash_guard.hpp"
#include "crash_text.hpp"
#include "exit_guard.hpp"
#include "standard_streams.hpp"

namespace dsc::app {
namespace {

void on_interrupt(int number) {
    CrashText text;
    if (!text.call()) {
        ::signal(number, SIG_DFL);
        ::raise(number);
        return;
    }
    for (const std::string_view part : {std::string_view("error: "), text.view(),
                                        std::string_view(" did not end and was interrupted; "
                                                         "correct the file\n")})
        tell(part);
    end_now(static_cast<int>(ExitCode::stopped));
}

}  // namespace

LoadGuard::LoadGuard() {
    guard_crashes({});
    struct sigaction action {};
    action.sa_handler = on_interrupt;
    ::sigaction(SIGINT, &action, &before_);
    if (before_.sa_handler == SIG_IGN) ::sigaction(SIGINT, &before_, nullptr);
}

LoadGuard::~LoadGuard() { ::sigaction(SIGINT, &before_, nullptr); }

}  // namespace dsc::app
