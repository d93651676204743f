// SPDX-License-Identifier: Apache-2.0
#pragma once

// The processor's own vector instructions, where they go beyond the compiler's vector types.
#if defined(__AVX__) && !defined(__CUDACC__)
// GCC 12 takes the undefined registers of its own header for a mistake (GCC bug 105593).
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wuninitialized"
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#include <immintrin.h>
#pragma GCC diagnostic pop
#endif
