#pragma once

#include <cstdio>
#include <cstdlib>

/// Programmer errors end the process: they say the code is wrong, never the input.
#define RADFARM_CHECK(condition)                                                          \
  do {                                                                                    \
    if (!(condition)) {                                                                   \
      std::fprintf(stderr, "%s:%d: CHECK failed: %s\n", __FILE__, __LINE__, #condition); \
      std::abort();                                                                       \
    }                                                                                     \
  } while (false)

/// The same in inner loops, built only with RADFARM_CHECKS (presets dev, asan, tsan).
#ifdef RADFARM_CHECKS
#define RADFARM_DCHECK(condition) RADFARM_CHECK(condition)
#else
#define RADFARM_DCHECK(condition) \
  do {                            \
  } while (false && (condition))
#endif
