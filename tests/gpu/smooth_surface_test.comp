#version 460
// Lifts points of triangles to the smooth surface that the normals at their corners stand for.
#include "lib/math/smooth_surface.glsl"

struct Question {
    vec3 corners[3]; // the array's elements take 16 bytes each
    vec3 normals[3];
    vec3 b;
};

layout(local_size_x = 64) in;
layout(set = 0, binding = 20, std430) readonly buffer In { Question questions[]; };
layout(set = 0, binding = 21, std430) writeonly buffer Out { vec4 lifts[]; };

void main() {
    const uint i = gl_GlobalInvocationID.x;
    if (i >= lifts.length())
        return;
    const Question q = questions[i];
    const mat3 corners = mat3(q.corners[0], q.corners[1], q.corners[2]);
    const mat3 normals = mat3(q.normals[0], q.normals[1], q.normals[2]);
    const vec3 ng = normalize(cross(corners[1] - corners[0], corners[2] - corners[0]));
    lifts[i] = vec4(liftToSmoothSurface(corners * q.b, q.b, corners, normals, ng), 0.0);
}
