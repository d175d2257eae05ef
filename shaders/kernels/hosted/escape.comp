#version 460
// The end of the paths whose rays met nothing.
#include "scene/records.glsl"
#include "scene/scatter.glsl"

layout(local_size_x = 64) in;

void main() {
    if (!hasRecord())
        return;
    const uint record = recordAtHand();
    const Ray ray = readRay(record);
    Path path = readPath(record);
    path.bsdfPdf = pdfOfFinding(ray, path.bsdfPdf);
    const vec3 found = escape(ray, range.bounce, path);
    writePlane(kPlaneEmitted, record, found, 0u);
    const uint slot = slotOfRecord(record);
    recordEmission(slot, range.bounce, found);

    uint flags = kRecordEmits;
    ShadowRay shadow;
    shadow.origin = vec3(0.0);
    if (meetsGround(ray, range.bounce)) {
        flags |= kRecordIsCaught;
        if (catchLight(ray, slot, path, shadow)) {
            flags |= kRecordHasShadowRay;
            writePlane(kPlaneShadow, record, shadow.direction, shadow.toSurface.primitive);
            if (recordsHave(kRecordShadowOrigin))
                writePlane(kPlaneShadowOrigin, record, shadow.origin, 0u);
        }
        writePlane(kPlaneContribution, record, path.throughput, 0u);
    }
    writePlane(kPlaneOrigin, record, shadow.origin, slot | flags);
}
