/// Wide registers for loops whose result does not depend on them.
// SPDX-License-Identifier: MIT
#pragma once

/// Compiles a function for AVX2 as well, where compiler and system can choose between the two when the program starts. For
/// functions in which every sum has its own place and its own order, so that the result is the same to the bit.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_THREAD__)
#define MESHREEL_WIDE __attribute__((target_clones("avx2", "default")))
#else
#define MESHREEL_WIDE
#endif

/// The same for AVX-512 too: for loops of square roots and quotients, which it doubles.
#if defined(__x86_64__) && defined(__GNUC__) && __GNUC__ >= 12 && !defined(__clang__) && !defined(__SANITIZE_THREAD__)
#define MESHREEL_WIDEST __attribute__((target_clones("arch=x86-64-v4", "avx2", "default")))
#else
#define MESHREEL_WIDEST MESHREEL_WIDE
#endif
