// Path state and queues of a wave: records that the kernels hand to each other.
#ifndef LAVALIGHT_SHARED_WAVEFRONT_H
#define LAVALIGHT_SHARED_WAVEFRONT_H

#include "shared/interior_list.h"
#include "shared/surface_id.h"
#include "shared/types.h"

LAVALIGHT_SHARED_BEGIN

SHARED_CONST uint kWorkgroupSize = 64u;

// The ray a slot's path goes on with. The direction has unit length.
struct Ray {
    vec3 origin;
    SurfaceId fromSurface; // surface that the ray starts on, or kNoSurface
    vec3 direction;
    float originCosine; // cosine between the direction and the shading normal where the ray starts
    uint receiver;      // packed (scene/receiver.glsl): what the light tree was asked for there
    InteriorList interior; // solids that it runs through, with kFeatureSolids
};

// The first meeting of a ray with the scene.
struct Hit {
    float t; // distance; infinite: nothing was hit, and the rest is undefined
    uint record; // the triangle's record, in the order of the accelerator: scene/triangle_record.glsl tells what surface it is
    vec2 barycentrics; // b1, b2: the point is (1 - b1 - b2) v0 + b1 v1 + b2 v2
};

struct Path {
    vec3 throughput; // product of f |cos| / pdf and 1 / survival so far
    float bsdfPdf;   // solid-angle pdf of the current ray as MIS takes it; 0: camera ray or delta lobe
    vec3 radiance;   // collected so far
    float etaScale;  // product of eta^2 over refractions: undoes the scaling of radiance for roulette; or one of these:
};

// Path::etaScale of a path that is over: its camera ray met nothing.
SHARED_CONST float kUncovered = 0.0f;
// Path::etaScale of a path that is over: the ground caught it. throughput.x is the luminance of a light sample there, and
// throughput.y of what arrives of it.
SHARED_CONST float kCaught = -1.0f;

// A shadow ray with what it will add to its slot if nothing lies between t = 0 and 1 (the direction spans the whole
// way to the light).
struct ShadowRay {
    vec3 origin;
    SurfaceId fromSurface; // surface that the ray starts on, or kNoSurface
    vec3 direction;
    SurfaceId toSurface; // surface that the ray ends on
    vec3 contribution;
    float unused;
};

// Where an invocation of the fused kernel stands with its slots, from dispatch to dispatch.
struct Lane {
    Ray ray;
    uint slot;
    uint wave;    // wave that the rest tells of
    uint bounce;  // 0: no path is under way
    uint started; // slots of which the camera ray was traced
    uint waiting; // paths that were put by after their first vertex
    uint resumed; // waiting paths that have been taken up again
    uint unused0;
    uint unused1;
};

// A path put by; the rest of it is with its slot.
struct WaitingPath {
    Ray ray; // ray that the path goes on with
    uint slot;
    uint unused0;
    uint unused1;
    uint unused2;
};

// Vertices that an invocation of the fused kernel goes on for in one dispatch. Mesa 22.3's lavapipe ends all loops of an
// invocation, without a word, after 65,535 turns in sum; on 300,000 triangles some 130 vertices were too many.
SHARED_CONST uint kVerticesPerDispatch = 16u;

// What the fused kernel counts over the dispatches of a wave.
struct LaneCounters {
    uint indirectRays;
    uint shadowRays;
    uint unfinished; // lanes that want another dispatch; cleared before each
    uint unused;
};

// Queue lengths of one bounce. Counters of all bounces are cleared once per wave.
struct BounceCounters {
    uint rays;
    uint shadowRays;
};

// VkDispatchIndirectCommand, padded to 16 bytes.
struct DispatchSize {
    uint x;
    uint y;
    uint z;
    uint unused;
};

// The slots of one wave: slot = pixel * sampleCount + sample, both counted from the first of the wave. Neighbouring slots
// so share a pixel, and the vector units of a device trace nearly the same camera ray.
struct WaveRange {
    uint firstPixel; // within the image, row by row from the top
    uint pixelCount;
    uint firstSample;
    uint sampleCount;
    uint bandFirstPixel; // the film at hand starts with this pixel
    uint bounce;
    uint slotsPerLane; // fused kernel: how many an invocation takes, one after another
    uint wave;         // fused kernel: lanes of another wave start anew
    uint groupStride;  // fused kernel: workgroup i takes the lanes of group i * groupStride, modulo their number
    uint firstRecord;  // hosted: the dispatch takes these records
    uint recordCount;
};

LAVALIGHT_SHARED_END

#endif
