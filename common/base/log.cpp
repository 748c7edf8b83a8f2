#include "base/log.h"

#include <cstdlib>
#include <string>

#include <spdlog/sinks/stdout_sinks.h>

namespace radfarm {

void start_logging(std::string_view program, spdlog::level::level_enum level) {
  auto logger = std::make_shared<spdlog::logger>(std::string(program), std::make_shared<spdlog::sinks::stderr_sink_mt>());
  logger->set_pattern("%Y-%m-%dT%H:%M:%S.%eZ %l %n[%P] %v", spdlog::pattern_time_type::utc);
  const char* wanted = std::getenv("RADFARM_LOG");
  logger->set_level(wanted == nullptr ? level : spdlog::level::from_str(wanted));
  spdlog::set_default_logger(std::move(logger));
}

}  // namespace radfarm
