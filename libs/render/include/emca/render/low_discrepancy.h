#pragma once

#include <cstdint>

/// The first two dimensions of the Sobol sequence, Owen-scrambled by hashing. Together they are a (0, 2)-sequence:
/// every aligned run of 2^m points has one point in each of the 2^m elementary intervals of equal area. More
/// dimensions are made by padding: independently shuffled and scrambled copies of these two.
/// Source: Burley, "Practical Hash-based Owen Scrambling", JCGT 9(4), 2020.

namespace emca::render {

constexpr std::uint32_t reverseBits(std::uint32_t x) {
    x = (x << 16) | (x >> 16);
    x = ((x & 0x00ff00ffu) << 8) | ((x & 0xff00ff00u) >> 8);
    x = ((x & 0x0f0f0f0fu) << 4) | ((x & 0xf0f0f0f0u) >> 4);
    x = ((x & 0x33333333u) << 2) | ((x & 0xccccccccu) >> 2);
    return ((x & 0x55555555u) << 1) | ((x & 0xaaaaaaaau) >> 1);
}

/// Permutation in which a bit depends on itself, on the seed and on lower bits only: Owen scrambling of reversed bits.
/// Source: Laine and Karras 2011 as in Burley 2020; constants of Vegdahl, "Building a Better LK Hash", 2021.
constexpr std::uint32_t laineKarras(std::uint32_t x, std::uint32_t seed) {
    x ^= x * 0x3d20adeau;
    x += seed;
    x *= (seed >> 16) | 1u;
    x ^= x * 0x05526c56u;
    x ^= x * 0x53a22864u;
    return x;
}

/// Nested uniform (Owen) scrambling of a binary fraction, or of an index, which shuffles the sequence without
/// breaking its aligned runs.
constexpr std::uint32_t owenScramble(std::uint32_t x, std::uint32_t seed) {
    return reverseBits(laineKarras(reverseBits(x), seed));
}

/// Second Sobol dimension of an index, its bits reversed. The generator matrix is Pascal's triangle modulo 2 (Sobol
/// 1967; primitive polynomial x + 1), which is the fivefold Kronecker product of (1 1; 0 1): five steps instead of one
/// per bit. Source: Ahmed, "An Implementation Algorithm of 2D Sobol Sequence Fast, Elegant, and Compact", EGSR 2024.
constexpr std::uint32_t reversedSobol1(std::uint32_t index) {
    index ^= (index >> 16);
    index ^= (index & 0xff00ff00u) >> 8;
    index ^= (index & 0xf0f0f0f0u) >> 4;
    index ^= (index & 0xccccccccu) >> 2;
    index ^= (index & 0xaaaaaaaau) >> 1;
    return index;
}

/// Scrambled points as 32-bit binary fractions.
constexpr std::uint32_t scrambledSobol0(std::uint32_t index, std::uint32_t seed) {
    return reverseBits(laineKarras(index, seed));
}
constexpr std::uint32_t scrambledSobol1(std::uint32_t index, std::uint32_t seed) {
    return reverseBits(laineKarras(reversedSobol1(index), seed));
}

/// The upper 24 bits as a float in [0, 1 - 2^-24].
constexpr float unitFloat(std::uint32_t bits) { return static_cast<float>(bits >> 8) * 0x1p-24f; }

}  // namespace emca::render
