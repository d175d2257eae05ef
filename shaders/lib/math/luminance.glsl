// How bright a colour looks.
#ifndef LAVALIGHT_LUMINANCE_GLSL
#define LAVALIGHT_LUMINANCE_GLSL

// Luminance of linear Rec. 709. Source: ITU-R BT.709-6, section 3.2.
float luminance(vec3 color) {
    return dot(color, vec3(0.2126, 0.7152, 0.0722));
}

#endif
