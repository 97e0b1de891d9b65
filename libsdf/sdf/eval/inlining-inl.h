// SDF_INLINE: how functions on SIMD lanes are inlined.
#pragma once

#include <hwy/base.h>

// By GCC, an export with a proof is a fifth faster where all is inlined. Clang decides by itself: it would
// take minutes to compile functions of that length.
#if HWY_COMPILER_CLANG
#define SDF_INLINE inline
#else
#define SDF_INLINE HWY_INLINE
#endif
