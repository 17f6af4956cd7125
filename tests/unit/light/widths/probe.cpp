// SPDX-License-Identifier: GPL-3.0-or-later
// Compiled at every width: samples and densities of a table as plain numbers.
#include "light/emit.h"
#include "light/kernels.h"

namespace cardioid::CD_ISA_NS {

/// n receivers and random numbers (9 floats each: p, n, u) to 10 floats each: wi, distance, radiance, pdf, valid, emitter.
void probe_light(const light::LightData& lights, int n, const float* in, float* out) {
    for (int k = 0; k < n; k += W) {
        float rows[9][W];
        for (int f = 0; f < 9; ++f) {
            for (int i = 0; i < W; ++i) rows[f][i] = in[(k + i < n ? k + i : n - 1) * 9 + f];
        }
        const LightReceiver at{{load(rows[0]), load(rows[1]), load(rows[2])},
                               {load(rows[3]), load(rows[4]), load(rows[5])}};
        const Mask active = first_lanes(n - k);
        const LightSample s = sample_light(lights, at, {load(rows[6]), load(rows[7])}, active);
        const Float results[10] = {s.wi.x,
                                   s.wi.y,
                                   s.wi.z,
                                   s.distance,
                                   s.radiance.r,
                                   s.radiance.g,
                                   s.radiance.b,
                                   s.pdf,
                                   select(s.valid, Float(1.0f), Float(0.0f)),
                                   to_float(s.emitter)};
        for (int f = 0; f < 10; ++f) {
            for (int i = 0; i < W && k + i < n; ++i) out[(k + i) * 10 + f] = results[f][i];
        }
    }
}

/// n emitters and places in the cube (5 floats each) to 16 floats each: origin, direction, normal, flux, density, t_min, t_max,
/// valid.
void probe_emission(const light::LightData& lights, int n, const float* in, float* out) {
    for (int k = 0; k < n; k += W) {
        float rows[5][W];
        for (int f = 0; f < 5; ++f) {
            for (int i = 0; i < W; ++i) rows[f][i] = in[(k + i < n ? k + i : n - 1) * 5 + f];
        }
        const PhotonRay r = emit_photon(lights, to_int(load(rows[0])), {load(rows[1]), load(rows[2])},
                                        {load(rows[3]), load(rows[4])}, first_lanes(n - k));
        const Float results[16] = {r.origin.x,    r.origin.y,    r.origin.z, r.direction.x,
                                   r.direction.y, r.direction.z, r.normal.x, r.normal.y,
                                   r.normal.z,    r.flux.r,      r.flux.g,   r.flux.b,
                                   r.density,     r.t_min,       r.t_max,    select(r.valid, Float(1.0f), Float(0.0f))};
        for (int f = 0; f < 16; ++f) {
            for (int i = 0; i < W && k + i < n; ++i) out[(k + i) * 16 + f] = results[f][i];
        }
    }
}

}  // namespace cardioid::CD_ISA_NS
