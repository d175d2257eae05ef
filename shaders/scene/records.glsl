// Paths as records that the host exchanges with the kernels of the schedule "hosted".
#include "scene/frame.glsl"
#include "shared/bindings.h"
#include "shared/records.h"
#include "shared/wavefront.h"

layout(set = 0, binding = BINDING_RECORDS_IN) uniform utextureBuffer recordsIn;
layout(set = 0, binding = BINDING_RECORDS_OUT, std430) writeonly buffer RecordsOut { uvec4 recordsOut[]; };
layout(constant_id = CONSTANT_RECORD_PLANES) const uint kRecordPlanes = 0u;

bool recordsHave(uint plane) {
    return (kRecordPlanes & plane) != 0u;
}

uvec4 readPlane(uint plane, uint record) {
    return texelFetch(recordsIn, int(plane * planeStride(frame.waveSize) + record));
}

void writePlane(uint plane, uint record, uvec4 value) {
    recordsOut[plane * planeStride(frame.waveSize) + record] = value;
}

void writePlane(uint plane, uint record, vec3 xyz, float w) {
    writePlane(plane, record, floatBitsToUint(vec4(xyz, w)));
}

void writePlane(uint plane, uint record, vec3 xyz, uint w) {
    writePlane(plane, record, uvec4(floatBitsToUint(xyz), w));
}

// The record of this invocation, and whether there is one.
uint recordAtHand() {
    return range.firstRecord + gl_GlobalInvocationID.x;
}

bool hasRecord() {
    return gl_GlobalInvocationID.x < range.recordCount;
}

uint slotOfRecord(uint record) {
    return readPlane(kPlaneOrigin, record).w;
}

// The ray as it was traced; where it started, the host knows.
Ray readRay(uint record) {
    const uvec4 direction = readPlane(kPlaneDirection, record);
    const vec3 origin = uintBitsToFloat(readPlane(kPlaneOrigin, record).xyz);
    const uint receiver = recordsHave(kRecordState) ? readPlane(kPlaneState, record).y : 0u;
    InteriorList interior = InteriorList(0u, 0u, 0u);
    if (recordsHave(kRecordInterior)) {
        const uvec4 list = readPlane(kPlaneInterior, record);
        interior = InteriorList(list.x, list.y, list.z);
    }
    return Ray(origin, kNoSurface, uintBitsToFloat(direction.xyz), uintBitsToFloat(direction.w), receiver, interior);
}

// The path, whose radiance the host sums.
Path readPath(uint record) {
    const vec4 throughput = uintBitsToFloat(readPlane(kPlaneThroughput, record));
    const float etaScale = recordsHave(kRecordState) ? uintBitsToFloat(readPlane(kPlaneState, record).x) : 1.0;
    return Path(throughput.xyz, throughput.w, vec3(0.0), etaScale);
}

Hit readHit(uint record) {
    const uvec4 hit = readPlane(kPlaneHit, record);
    return Hit(uintBitsToFloat(hit.x), hit.y, uintBitsToFloat(hit.zw));
}

// The ray that the path goes on with, but for its origin.
void writeNext(uint record, Ray ray, Path path) {
    writePlane(kPlaneDirection, record, ray.direction, ray.originCosine);
    writePlane(kPlaneThroughput, record, path.throughput, path.bsdfPdf);
    if (recordsHave(kRecordState))
        writePlane(kPlaneState, record, uvec4(floatBitsToUint(path.etaScale), ray.receiver, 0u, 0u));
    if (recordsHave(kRecordInterior))
        writePlane(kPlaneInterior, record, uvec4(ray.interior.outer, ray.interior.inner, ray.interior.notes, 0u));
}
