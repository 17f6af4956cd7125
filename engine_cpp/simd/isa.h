// SPDX-License-Identifier: GPL-3.0-or-later
// One source, three object files: kernels are compiled at width 1, 8 and 16 and chosen at run time.
// A kernel file is compiled with -DCARDIOID_WIDTH=1|8|16; everything in it lives in CD_ISA_NS, so that no
// inline function compiled for AVX-512 can be picked by the linker for a smaller machine.
#pragma once

#ifndef CARDIOID_WIDTH
#define CARDIOID_WIDTH 1
#endif

#if CARDIOID_WIDTH == 1
#define CD_ISA_NS isa_w1
#elif CARDIOID_WIDTH == 8
#define CD_ISA_NS isa_w8
#elif CARDIOID_WIDTH == 16
#define CD_ISA_NS isa_w16
#else
#error "CARDIOID_WIDTH must be 1, 8 or 16"
#endif
