#pragma once

#include <string>

#include <nlohmann/json.hpp>

namespace radfarm::cli {

/// What a render ends with: stages with wall and CPU seconds, counts, effects, the audited error with its interval.
/// From the report JSON (DESIGN section 9); what the report does not say is left out. Ends with a line break.
std::string closing_table(const nlohmann::json& report);

/// The audited error in one line, such as "relative error 1.2 % (95 %: 0.9 % to 1.6 %), 256 pixels audited".
std::string accuracy_line(const nlohmann::json& report);

/// What each round of a job that has a target found, whether the target is met, and what halving the error would cost; the last
/// alone where there is none.
std::string rounds_table(const nlohmann::json& report);

/// The effects plan: for each effect id, on or off, measured value, bound of skipping, test, and what is done instead; then what
/// all that is off may change, and the expected cost where the plan has it.
std::string effects_table(const nlohmann::json& plan);

}  // namespace radfarm::cli
