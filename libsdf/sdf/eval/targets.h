// The instruction sets that the SIMD readings are compiled for; included before Highway. Private to eval.
#pragma once

// Older targets run through Highway's SSE4 path or its portable one; newer ones gain nothing over AVX3.
// Builds with assertions are for checks, and sanitizers take minutes to compile each target: one of each
// width does.
#ifdef NDEBUG
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_AVX3_DL)
#else
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_SSE4 | HWY_AVX3 | HWY_AVX3_DL)
#endif
