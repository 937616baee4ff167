// One function compiled for several widths of vectors; the widest that the machine has is taken when the program
// starts. Whole numbers, and real numbers without fused multiply-add, come out the same to the last bit.
#pragma once

#include <cstdlib>  // identifies the C library

// Sanitizers start after such a choice is made; other compilers take the plain function.
#if defined(__x86_64__) && defined(__GNUC__) && __GNUC__ >= 12 && !defined(__clang__) && defined(__GLIBC__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define ESPALIER_VECTOR_CLONES __attribute__((target_clones("arch=x86-64-v4", "avx2", "default")))
#else
#define ESPALIER_VECTOR_CLONES
#endif
