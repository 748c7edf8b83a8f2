#pragma once

#include <string_view>

#include <spdlog/spdlog.h>

namespace radfarm {

/// Sends this process's log to stderr, one line an event: time, level, program, message. Called once, by main.
/// RADFARM_LOG=trace|debug|info|warn|error|off overrides the level.
void start_logging(std::string_view program, spdlog::level::level_enum level);

}  // namespace radfarm
