#pragma once

// The only difference between Embree 3 and 4 that radfarm meets, in one place. Included by ray_caster.cpp alone.
#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

namespace radfarm::rtc {

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
