// Where a light with a range ends. Based on: KHR_lights_punctual, "Range Property", the recommended attenuation.
#ifndef LAVALIGHT_RANGE_WINDOW_GLSL
#define LAVALIGHT_RANGE_WINDOW_GLSL

// Factor of the light at the square root of `distance2`: 1 at the light, 0 from its range on.
float rangeWindow(float distance2, float inverseRange2) {
    const float part2 = distance2 * inverseRange2;
    return clamp(1.0 - part2 * part2, 0.0, 1.0);
}

#endif
