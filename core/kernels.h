#pragma once

/// Attributes of loops over numbers in which the time of a training goes.

/// One function compiled for each kind of x86-64 processor, of which the loader takes the widest that the computer has.
/// Not by clang: version 14 makes only the first of the functions where a header declares them, which ends with an
/// illegal instruction on a processor without AVX-512. What it compiles is for any processor, and slower.
#if defined(__x86_64__) && !defined(__clang__)
#define DAUMIER_FOR_EACH_PROCESSOR __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define DAUMIER_FOR_EACH_PROCESSOR
#endif

/// A part of such a function, compiled with it.
#define DAUMIER_INLINE inline __attribute__((always_inline))
