#include "pipeline/fingerprint.h"

#include <cmath>

#include "base/digest.h"

#ifndef RADFARM_VERSION
#define RADFARM_VERSION "0.1.0"
#endif

namespace radfarm {
namespace {

constexpr int kTableSize = 512;

/// The functions that the renderer calls, over arguments that no compiler can fold: libm's last bits are what differs.
template <typename Float>
void add_libm(Sha256& hash) {
  for (int i = 0; i < kTableSize; ++i) {
    volatile Float opaque = static_cast<Float>(i);
    const Float x = (opaque + Float(0.37)) / Float(41);
    const Float y = Float(1.5) - x;
    for (const Float value : {std::sin(x), std::cos(x), std::tan(x), std::exp(y), std::log(x), std::pow(x, y),
                              std::atan2(y, x), std::acos(x / Float(13)), std::sqrt(x), std::cbrt(x), x * y + y / x}) {
      hash.update_value(value);
    }
  }
}

}  // namespace

std::string build_id() {
  std::string id = "radfarm " RADFARM_VERSION ", " __VERSION__;
#ifdef __AVX512F__
  id += ", avx512";
#elif defined(__AVX2__)
  id += ", avx2";
#endif
#ifdef __FMA__
  id += "+fma";
#endif
#ifdef RADFARM_CHECKS
  id += ", checks";
#endif
  return id;
}

std::string numeric_fingerprint() {
  Sha256 hash;
  hash.update(build_id());
  add_libm<float>(hash);
  add_libm<double>(hash);
  return hash.hex();
}

}  // namespace radfarm
