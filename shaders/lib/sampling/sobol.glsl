// The first two dimensions of Sobol's sequence, shuffled and scrambled after Owen by hashing.
// Based on: Burley, "Practical Hash-based Owen Scrambling", JCGT 9(4), 2020; permutation by Vegdahl, "Building a Better
// LK Hash", 2021.

// A hash whose every bit depends on lower bits and the seed alone: of reversed bits that is Owen's nested scramble.
uint nestedPermutation(uint x, uint seed) {
    x ^= x * 0x3d20adeau;
    x += seed;
    x *= (seed >> 16u) | 1u;
    x ^= x * 0x05526c56u;
    x ^= x * 0x53a22864u;
    return x;
}

// Another order of the points in which every aligned block of 2^k indices stays together, so that each block is a net.
uint shuffledIndex(uint index, uint seed) {
    return bitfieldReverse(nestedPermutation(bitfieldReverse(index), seed));
}

// Owen's scramble of van der Corput's sequence, Sobol's dimension 0: the bits of `index` reversed. Scrambling reverses
// once more, so only one reversal is left.
uint scrambledVanDerCorput(uint index, uint seed) {
    return bitfieldReverse(nestedPermutation(index, seed));
}

// Owen's scramble of Sobol's dimension 1, whose matrix is Pascal's triangle modulo 2: a Kronecker power of (1 1; 0 1), applied
// in five steps instead of 32.
uint scrambledSobol1(uint index, uint seed) {
    index ^= (index & 0xaaaaaaaau) >> 1u;
    index ^= (index & 0xccccccccu) >> 2u;
    index ^= (index & 0xf0f0f0f0u) >> 4u;
    index ^= (index & 0xff00ff00u) >> 8u;
    index ^= index >> 16u;
    return bitfieldReverse(nestedPermutation(index, seed));
}

// Point `index` of a sequence of its own for each `seeds`: x shuffles the order, y and z scramble the dimensions.
uvec2 scrambledSobolPair(uint index, uvec3 seeds) {
    const uint shuffled = shuffledIndex(index, seeds.x);
    return uvec2(scrambledVanDerCorput(shuffled, seeds.y), scrambledSobol1(shuffled, seeds.z));
}
