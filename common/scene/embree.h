#pragma once

// The only difference between Embree 3 and 4 that radfarm meets, and the device, in one place. Included by ray_caster.cpp and
// disc_caster.cpp alone.
#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

namespace radfarm::rtc {

#if defined(__x86_64__)
// Hits differ in their last bits between AVX-512, AVX2 and the older sets: one is fixed for all machines.
inline constexpr const char* kDeviceConfig = "isa=avx2,threads=0";
#else
inline constexpr const char* kDeviceConfig = "threads=0";
#endif
inline RTCDevice new_device() { return rtcNewDevice(kDeviceConfig); }

#if RTC_VERSION_MAJOR >= 4
using Context = RTCRayQueryContext;  // the first member of a struct that carries more
inline void start(Context& context) { rtcInitRayQueryContext(&context); }
inline void intersect(RTCScene scene, Context& context, RTCRayHit& ray_hit) {
  RTCIntersectArguments arguments;
  rtcInitIntersectArguments(&arguments);
  arguments.context = &context;
  rtcIntersect1(scene, &ray_hit, &arguments);
}
inline void occluded(RTCScene scene, Context& context, RTCRay& ray) {
  RTCOccludedArguments arguments;
  rtcInitOccludedArguments(&arguments);
  arguments.context = &context;
  rtcOccluded1(scene, &ray, &arguments);
}
#else
using Context = RTCIntersectContext;
inline void start(Context& context) { rtcInitIntersectContext(&context); }
inline void intersect(RTCScene scene, Context& context, RTCRayHit& ray_hit) { rtcIntersect1(scene, &context, &ray_hit); }
inline void occluded(RTCScene scene, Context& context, RTCRay& ray) { rtcOccluded1(scene, &context, &ray); }
#endif

}  // namespace radfarm::rtc
