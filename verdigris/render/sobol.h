// SPDX-License-Identifier: MIT
// Points that fill a square evenly: the first two dimensions of Sobol's sequence, Owen-scrambled by
// hashing and shuffled anew for every pair of dimensions [Burley2020]. A pure function of sample,
// pair and seed (internal).
#pragma once

#include <cstdint>

namespace verdigris {

struct UnitPoint {
    float x = 0, y = 0;  ///< in [0, 1)
};

inline std::uint32_t reversed_bits(std::uint32_t x) {
    x = __builtin_bswap32(x);
    x = (x & 0x0f0f0f0fu) << 4 | (x >> 4 & 0x0f0f0f0fu);
    x = (x & 0x33333333u) << 2 | (x >> 2 & 0x33333333u);
    return (x & 0x55555555u) << 1 | (x >> 1 & 0x55555555u);
}

/// Mixes 32 bits [Burley2020, after hash prospector].
inline std::uint32_t mixed_bits(std::uint32_t x) {
    x = (x ^ (x >> 16)) * 0x21f0aaadu;
    x = (x ^ (x >> 15)) * 0xd35a2d97u;
    return x ^ (x >> 15);
}
inline std::uint32_t seed_of(std::uint32_t a, std::uint32_t b) {
    return mixed_bits(a * 0x9E3779B9u + mixed_bits(b));
}

/// An Owen scramble of a number whose bits are reversed [Burley2020, Listing 2].
inline std::uint32_t scrambled_reversed(std::uint32_t x, std::uint32_t seed) {
    x += seed;
    x ^= x * 0x6c50b47cu;
    x ^= x * 0xb82f1e52u;
    x ^= x * 0xc7afe638u;
    return x ^ (x * 0x8d22f6e6u);
}

/// Sobol's second dimension with its bits reversed. derived: its generator matrix is Pascal's
/// triangle modulo 2, the fifth Kronecker power of (1 1; 0 1): five steps instead of 32.
inline std::uint32_t second_sobol_reversed(std::uint32_t index) {
    index ^= (index & 0xaaaaaaaau) >> 1;
    index ^= (index & 0xccccccccu) >> 2;
    index ^= (index & 0xf0f0f0f0u) >> 4;
    index ^= (index & 0xff00ff00u) >> 8;
    return index ^ (index & 0xffff0000u) >> 16;
}

/// Point `sample` of the `pair`-th square of the pixel or path that `seed` stands for. Every run of
/// 2^k samples that begins at a multiple of 2^k is stratified in all elementary intervals of area
/// 2^-k.
inline UnitPoint sobol_point(std::uint32_t sample, std::uint32_t pair, std::uint32_t seed) {
    const std::uint32_t own = seed_of(seed, pair);
    const std::uint32_t index = reversed_bits(scrambled_reversed(reversed_bits(sample), own));
    const std::uint32_t x = reversed_bits(scrambled_reversed(index, mixed_bits(own ^ 0x5bd1e995u)));
    const std::uint32_t y = reversed_bits(
        scrambled_reversed(second_sobol_reversed(index), mixed_bits(own ^ 0x1b873593u)));
    return {float(x >> 8) * 0x1.0p-24f, float(y >> 8) * 0x1.0p-24f};
}

}  // namespace verdigris
