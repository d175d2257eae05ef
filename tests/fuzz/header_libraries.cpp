// The header libraries with the fuzzer's instrumentation, which Debian's packages of them lack. The linker
// takes these functions instead of the packages'.
#define STB_IMAGE_IMPLEMENTATION
#define TINYGLTF_IMPLEMENTATION
#include <tiny_gltf.h> // includes stb_image.h, which has no guard of its own
