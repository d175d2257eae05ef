// Mathematical constants.
const float kPi = 3.14159265358979323846;
const float kInvPi = 0.31830988618379067154;
// GLSL does not take uintBitsToFloat for a constant initialiser.
#define kInfinity uintBitsToFloat(0x7f800000u)
