#include "process/end_on_signal.h"

#include <unistd.h>

#include <csignal>

#include "process/exit_code.h"

namespace radfarm {

EndOnSignal::EndOnSignal(const char* program)
    : watcher_({SIGINT, SIGTERM}, [program](int) {
        ::_exit(static_cast<int>(report_error(program, {Code::kCancelled, "cancelled"})));
      }) {}

}  // namespace radfarm
