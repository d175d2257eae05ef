// Where the smooth surface lies that a mesh stands for: above the triangle, as far as the normals at its corners say.
// Based on: Hanika, "Hacking the Shadow Terminator", Ray Tracing Gems II, 2021, chapter 4; with one change: a corner's plane
// counts less where its normal leaves the triangle's by more than 41 degrees, and nothing from 53 on. There the normals do not
// stand for a smooth surface: a cube whose corners share normals would have its faces lifted by two thirds of its half side.
#ifndef LAVALIGHT_SMOOTH_SURFACE_GLSL
#define LAVALIGHT_SMOOTH_SURFACE_GLSL

#include "shared/scene.h"

// From p up to the plane through a corner, along the corner's normal n; 0 where that plane lies below p.
vec3 liftToCorner(vec3 p, vec3 corner, vec3 n, vec3 ng) {
    const float trust = clamp((dot(n, ng) - kLeastTrustedCosine) / 0.15, 0.0, 1.0);
    return trust * max(0.0, dot(corner - p, n)) * n;
}

// From the point p of a triangle, with barycentrics b, up to the smooth surface; all normals of unit length on one side.
vec3 liftToSmoothSurface(vec3 p, vec3 b, mat3 corners, mat3 normals, vec3 ng) {
    return b.x * liftToCorner(p, corners[0], normals[0], ng) + b.y * liftToCorner(p, corners[1], normals[1], ng) +
           b.z * liftToCorner(p, corners[2], normals[2], ng);
}

#endif
