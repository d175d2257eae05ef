#version 460
// A vertex of each path of a class of materials: the host has traced the path's ray.
#include "scene/records.glsl"
#include "scene/scatter.glsl"
#include "scene/tally.glsl"

layout(local_size_x = 64) in;

void main() {
    if (!hasRecord())
        return;
    const uint record = recordAtHand();
    const uint slot = slotOfRecord(record);
    const Ray ray = readRay(record);
    Path path = readPath(record);
    path.bsdfPdf = pdfOfFinding(ray, path.bsdfPdf);
    const NextRays next = scatterAt(readHit(record), ray, slot, range.bounce, path);
    if (next.isCut)
        tallyCutPaths(1u, fixedThroughput(path.throughput));
    if (next.crowdedSolid > 0u)
        tallyCrowded(1u, next.crowdedSolid);
    const bool emits = path.radiance != vec3(0.0);
    const vec3 origin = next.wantsShadowRay && !recordsHave(kRecordShadowOrigin) ? next.shadow.origin : next.ray.origin;
    const SurfaceId from = next.wantsShadowRay ? next.shadow.fromSurface : next.ray.fromSurface;
    const uint flags = (next.goesOn ? kRecordGoesOn : 0u) | (next.wantsShadowRay ? kRecordHasShadowRay : 0u) |
                       (emits ? kRecordEmits : 0u) | (isSurface(from) ? kRecordOnSurface : 0u);
    writePlane(kPlaneOrigin, record, origin, slot | flags);
    if (emits)
        writePlane(kPlaneEmitted, record, path.radiance, 0u);
    if (next.goesOn)
        writeNext(record, next.ray, path);
    if (next.wantsShadowRay) {
        writePlane(kPlaneShadow, record, next.shadow.direction, next.shadow.toSurface.primitive);
        writePlane(kPlaneContribution, record, next.shadow.contribution, 0u);
        if (recordsHave(kRecordShadowOrigin))
            writePlane(kPlaneShadowOrigin, record, next.shadow.origin, 0u);
    }
}
