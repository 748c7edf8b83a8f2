#pragma once

#include <string>

namespace radfarm {

/// 128 bits from the system's random source, as 32 hexadecimal digits: ids and lease tokens that cannot be guessed.
std::string random_token();

}  // namespace radfarm
