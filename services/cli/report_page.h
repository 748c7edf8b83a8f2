#pragma once

#include <cstddef>
#include <span>
#include <string>

#include <nlohmann/json.hpp>

namespace radfarm::cli {

/// `--report OUT.html`: a report to look at, in one file. The image (a PNG), its measured error and where it lies, where the time
/// went, which effects were simulated and what the others can change, what the next halving of the error would cost, settings.
/// `report` is the report JSON; what it lacks is left out.
std::string report_page(const nlohmann::json& report, std::span<const std::byte> png);

}  // namespace radfarm::cli
