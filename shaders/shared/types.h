// The one place where GLSL and C++ differ: the names of scalar and vector types in the shared headers.
#ifndef LAVALIGHT_SHARED_TYPES_H
#define LAVALIGHT_SHARED_TYPES_H

#ifdef __cplusplus
#include <cstdint>

#include <glm/glm.hpp>

#define LAVALIGHT_SHARED_BEGIN namespace lavalight {
#define LAVALIGHT_SHARED_END }
#define SHARED_CONST constexpr
#define SHARED_FUNCTION constexpr

LAVALIGHT_SHARED_BEGIN
using uint = uint32_t;
using vec2 = glm::vec2;
using vec3 = glm::vec3;
using vec4 = glm::vec4;
using uvec2 = glm::uvec2;
using uvec4 = glm::uvec4;
LAVALIGHT_SHARED_END
#else
#define LAVALIGHT_SHARED_BEGIN
#define LAVALIGHT_SHARED_END
#define SHARED_CONST const
#define SHARED_FUNCTION
#endif

#endif
