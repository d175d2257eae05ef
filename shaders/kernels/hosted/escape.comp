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
    writePlane(kPlaneOrigin, record, vec3(0.0), slotOfRecord(record) | kRecordEmits);
    const vec3 found = escape(ray, range.bounce, path);
    writePlane(kPlaneEmitted, record, found, 0u);
    recordEmission(slotOfRecord(record), range.bounce, found);
}
