#version 460
// Adds the finished paths of the wave to the film, one invocation a pixel, exactly: the sink of all films.
const bool kSinkHasLayers = true;
#include "scene/film_sink.glsl"

layout(local_size_x = 64) in;

void main() {
    addSamples();
}
