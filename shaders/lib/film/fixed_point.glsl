// Exact sums: floats added to wide fixed-point integers built from 32-bit words, lowest word first. Those that add have no
// branches: `accumulate` calls them six times in a loop, and SwiftShader's compiler took minutes and 6 GB for the paths
// through twelve of them.
#include "shared/film.h"

struct Shifted {
    uint low;  // the 24-bit mantissa, shifted, spans at most two words
    uint high;
    uint word; // index of the word that `low` belongs to
    bool overflows;
};

// x >= 0 (finite) in units of 2^lowestExponent, rounded to nearest, for a sum of `words` words.
Shifted toFixed(float x, int lowestExponent, uint words) {
    const uint bits = floatBitsToUint(x);
    const uint exponent = bits >> 23u;
    const uint mantissa = exponent == 0u ? bits & 0x7fffffu : (bits & 0x7fffffu) | 0x800000u;
    // x = mantissa * 2^(max(exponent, 1) - 150)
    const int shift = int(max(exponent, 1u)) - 150 - lowestExponent;
    const uint down = uint(clamp(-shift, 1, 31));
    const uint rounded = (mantissa + (1u << (down - 1u))) >> down;
    const uint word = uint(max(shift, 0)) / 32u;
    const uint up = uint(max(shift, 0)) % 32u;
    const uint high = mantissa >> 1u >> (31u - up);
    const bool overflows = word >= words || (word == words - 1u && high != 0u);
    return Shifted(shift < 0 ? rounded : mantissa << up, high, word, overflows);
}

// The word of `s` at position `index`.
uint wordOf(Shifted s, uint index) {
    return (index == s.word ? s.low : 0u) | (index == s.word + 1u ? s.high : 0u);
}

// a + b + carry; the carry out of it goes back into `carry`.
uint addWithCarry(uint a, uint b, inout uint carry) {
    uint first;
    uint second;
    const uint sum = uaddCarry(a, b, first);
    const uint total = uaddCarry(sum, carry, second);
    carry = first + second;
    return total;
}

// a - b for numbers of four words, in two's complement where a is the smaller; of three words, where the fourth are 0 and
// a is not the smaller, too.
uvec4 minus(uvec4 a, uvec4 b) {
    uint carry = 1u; // a - b = a + ~b + 1
    uvec4 difference;
    difference.x = addWithCarry(a.x, ~b.x, carry);
    difference.y = addWithCarry(a.y, ~b.y, carry);
    difference.z = addWithCarry(a.z, ~b.z, carry);
    difference.w = addWithCarry(a.w, ~b.w, carry);
    return difference;
}

// sum += x for a number of four words; false: it left the range and stays at its largest value.
bool addExactly(inout uvec4 sum, float x, int lowestExponent) {
    const Shifted s = toFixed(x, lowestExponent, 4u);
    uint carry = 0u;
    sum.x = addWithCarry(sum.x, wordOf(s, 0u), carry);
    sum.y = addWithCarry(sum.y, wordOf(s, 1u), carry);
    sum.z = addWithCarry(sum.z, wordOf(s, 2u), carry);
    sum.w = addWithCarry(sum.w, wordOf(s, 3u), carry);
    const bool fits = carry == 0u && !s.overflows;
    sum |= fits ? 0u : 0xffffffffu;
    return fits;
}

// sum += x for a number of three words, as above.
bool addExactly(inout uvec3 sum, float x, int lowestExponent) {
    const Shifted s = toFixed(x, lowestExponent, 3u);
    uint carry = 0u;
    sum.x = addWithCarry(sum.x, wordOf(s, 0u), carry);
    sum.y = addWithCarry(sum.y, wordOf(s, 1u), carry);
    sum.z = addWithCarry(sum.z, wordOf(s, 2u), carry);
    const bool fits = carry == 0u && !s.overflows;
    sum |= fits ? 0u : 0xffffffffu;
    return fits;
}

// sum += x for a number of four words in two's complement; false: |x| was limited to kMostSigned.
// -x adds exactly the opposite of x.
bool addSigned(inout uvec4 sum, float x, int lowestExponent) {
    const Shifted s = toFixed(min(abs(x), kMostSigned), lowestExponent, 4u);
    const uint flip = x < 0.0 ? 0xffffffffu : 0u; // a - b = a + ~b + 1
    uint carry = flip & 1u;
    sum.x = addWithCarry(sum.x, wordOf(s, 0u) ^ flip, carry);
    sum.y = addWithCarry(sum.y, wordOf(s, 1u) ^ flip, carry);
    sum.z = addWithCarry(sum.z, wordOf(s, 2u) ^ flip, carry);
    sum.w = addWithCarry(sum.w, wordOf(s, 3u) ^ flip, carry);
    return abs(x) <= kMostSigned;
}

// Value of a number of three words, the lowest bit worth 2^lowestExponent: off by 2 units in the last place at most.
float fromFixed(uvec3 words, int lowestExponent) {
    return ldexp(float(words.z), lowestExponent + 64) +
           (ldexp(float(words.y), lowestExponent + 32) + ldexp(float(words.x), lowestExponent));
}

// Value of a number of four words in two's complement, as close.
float fromSigned(uvec4 words, int lowestExponent) {
    const bool isNegative = (words.w & 0x80000000u) != 0u;
    if (isNegative) {
        uint carry = 1u;
        words.x = addWithCarry(~words.x, 0u, carry);
        words.y = addWithCarry(~words.y, 0u, carry);
        words.z = addWithCarry(~words.z, 0u, carry);
        words.w = ~words.w + carry;
    }
    const float magnitude = ldexp(float(words.w), lowestExponent + 96) + fromFixed(words.xyz, lowestExponent);
    return isNegative ? -magnitude : magnitude;
}
