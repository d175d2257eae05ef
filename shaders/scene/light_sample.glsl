// What sampling a light from a point gives.
#include "shared/wavefront.h"

struct LightSample {
    vec3 end;      // of the shadow ray
    vec3 wi;       // unit, towards the light
    vec3 radiance; // arriving from wi; of a delta light its irradiance on a plane across wi; 0: it does not shine this way
    float pdf;     // per solid angle; 1 for a delta light
    bool isDelta;  // a BSDF ray cannot find it
    SurfaceId surface; // that the shadow ray ends on, or kNoSurface
};

const LightSample kNoLightSample = LightSample(vec3(0.0), vec3(0.0, 0.0, 1.0), vec3(0.0), 1.0, true, kNoSurface);
