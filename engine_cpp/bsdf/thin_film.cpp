// SPDX-License-Identifier: GPL-3.0-or-later
// Interference in a thin film over a dielectric or a metal (Belcour & Barla 2017): Airy's sum over path differences, each
// integrated over the spectrum by a table (tables.h).
#include "bsdf/fresnel.h"
#include "bsdf/table_lookup.h"

namespace cardioid::CD_ISA_NS {

namespace {

/// One boundary for both polarisations: reflectance, and the phase shift as a point of the unit circle.
struct Boundary {
    Float s, p;
    Float s_re, s_im, p_re, p_im;
    Float cos_t;
    Mask total;
};

Boundary dielectric_boundary(Float c, Float eta) {
    const Float eta2 = eta * eta, g2 = eta2 - 1.0f + c * c, one = 1.0f, zero = 0.0f;
    const Float cos_t = safe_sqrt(g2) / eta;
    const Float s = (c - eta * cos_t) / max(c + eta * cos_t, 1e-20f);
    const Float p = (eta * c - cos_t) / max(eta * c + cos_t, 1e-20f);
    const Mask total = g2 <= zero;
    const auto sign = [&](Float x) { return select(x >= zero, one, -one); };
    return {select(total, one, s * s), select(total, one, p * p), sign(s), zero, sign(p), zero, cos_t, total};
}

/// From a film of index `outside` to a metal n + ik. `at_82`: its reflectance at 82°, whose F82 curve then replaces the exact
/// one; negative: exact.
Boundary metal_boundary(Float c, Float outside, Float n, Float k, Float at_82) {
    const Float o2 = outside * outside, n2 = n * n, k2 = k * k, nk = 2.0f * n * k;
    const Float a = n2 - k2 - o2 * (1.0f - c * c), b = sqrt(a * a + nk * nk);
    const Float u2 = max(0.5f * (b + a), 0.0f), v2 = max(0.5f * (b - a), 0.0f), u = sqrt(u2), v = sqrt(v2);
    const auto ratio = [](Float x, Float y) { return x / max(y, 1e-20f); };
    Boundary r;
    r.s = ratio(sqr(outside * c - u) + v2, sqr(outside * c + u) + v2);
    const Float t3 = (n2 - k2) * c, t4 = nk * c;
    r.p = ratio(sqr(t3 - outside * u) + sqr(t4 - outside * v), sqr(t3 + outside * u) + sqr(t4 + outside * v));
    const Mask curve = at_82 >= Float(0.0f);
    if (any(curve)) {
        const Float rn = n / outside, rk2 = k2 / o2;
        const Float f0 = (sqr(rn - 1.0f) + rk2) / (sqr(rn + 1.0f) + rk2);
        constexpr float f = 6.0f / 7.0f, f5 = f * f * f * f * f;
        const Float x = saturate(1.0f - c), x5 = pow5(x);
        const Float bend = (7.0f / (f5 * f)) * (mix(f0, 1.0f, f5) - at_82);
        const Float value = saturate(mix(f0, 1.0f, x5) - bend * c * x5 * x);
        r.s = select(curve, value, r.s);
        r.p = select(curve, value, r.p);
    }
    const auto unit = [](Float x, Float y, Float& re, Float& im) {
        const Float length = sqrt(x * x + y * y);
        const Mask none = length == Float(0.0f);
        re = select(none, Float(1.0f), x / max(length, 1e-30f));
        im = select(none, Float(0.0f), y / max(length, 1e-30f));
    };
    unit(o2 * c * c - u2 - v2, -(2.0f * outside * c * v), r.s_re, r.s_im);
    unit(sqr((n2 + k2) * c) - o2 * (u2 + v2), 2.0f * outside * c * (nk * u - (n2 - k2) * v), r.p_re, r.p_im);
    r.cos_t = 0.0f;
    r.total = mask_of(false);
    return r;
}

Float film_table(int row, Float difference) {
    using namespace cardioid::bsdf;
    return lookup1(k_film_response + row * k_film_size, TableAxis(difference * (1.0f / k_film_reach), k_film_size));
}

/// Airy's sum for channel `channel` and one polarisation; (re, im): the phase shift of one inner round.
Float airy(Float top, Float bottom, Float difference, Float re, Float im, int channel) {
    const Float through = 1.0f - top, both = top * bottom, root = sqrt(both);
    const Float rest = through * through * bottom / max(1.0f - both, 1e-6f);
    Float sum = rest + top, coefficient = rest - through, x = re, y = im;
    for (int m = 1; m < 4; ++m) {
        coefficient *= root;
        const Float d = difference * static_cast<float>(m);
        sum += 2.0f * coefficient * (x * film_table(channel, d) + y * film_table(3 + channel, d));
        const Float turned = x * im + y * re;
        x = x * re - y * im;
        y = turned;
    }
    return sum;
}

/// A film's two boundaries in one channel.
Float film_channel(const Boundary& top, const Boundary& bottom, Float difference, int channel) {
    const Float s = airy(top.s, bottom.s, difference, -top.s_re * bottom.s_re, -top.s_re * bottom.s_im, channel);
    const Float p = airy(top.p, bottom.p, difference, -top.p_re * bottom.p_re, -top.p_re * bottom.p_im, channel);
    return select(top.total | bottom.total, Float(1.0f), saturate(0.5f * (s + p)));
}

/// Index and extinction whose reflectance is r at normal incidence, g at 82° (Gulbrandsen 2014).
struct MetalIndex {
    Float n, k;
};
MetalIndex metal_index(Float f0, Float g) {
    const Float r = min(f0, 0.999f), root = sqrt(max(r, 0.0f));
    const Float n = mix((1.0f + root) / (1.0f - root), (1.0f - r) / (1.0f + r), g);
    return {n, safe_sqrt((r * sqr(n + 1.0f) - sqr(n - 1.0f)) / (1.0f - r))};
}

Spectrum over_metal(const bsdf::Lobe& lobe, int i, const Boundary& top, Float film, Float difference) {
    const Spectrum f0 = load_rgb(lobe.f0, i), f90 = load_rgb(lobe.f90, i);
    const bool physical = lobe.fresnel == bsdf::Fresnel::conductor;
    const Spectrum g = physical ? Spectrum(-1.0f) : fresnel_f82(1.0f / 7.0f, f0, f90);
    const auto channel = [&](Float a, Float b, Float at_82, int k) {
        const MetalIndex m = physical ? MetalIndex{a, b} : metal_index(a, at_82);
        return film_channel(top, metal_boundary(top.cos_t, film, m.n, m.k, at_82), difference, k);
    };
    return {channel(f0.r, f90.r, g.r, 0), channel(f0.g, f90.g, g.g, 1), channel(f0.b, f90.b, g.b, 2)};
}

/// Principled's colour at normal incidence scales the film's, the less the brighter it is.
Spectrum scaled_by_f0(Spectrum f, Spectrum f0, Float eta) {
    const Float real = f0_of_eta(eta);
    const auto scale = [&](Float x, Float wanted) {
        const Float s = saturate((1.0f - x) / (1.0f - real));
        return select(real > Float(1e-5f), x * mix(1.0f, wanted / max(real, 1e-5f), s), x);
    };
    return {scale(f.r, f0.r), scale(f.g, f0.g), scale(f.b, f0.b)};
}

}  // namespace

Spectrum film_reflectance(const bsdf::Lobe& lobe, int i, Float c, Spectrum plain) {
    using bsdf::Fresnel;
    const Float thickness = load(lobe.roughness + i);
    const Mask there = thickness > Float(k_least_film);
    if (none(there)) return plain;
    // Films under a nanometre fade into none.
    const Float t = saturate(thickness), fade = t * t * (3.0f - 2.0f * t);
    const Float film = mix(1.0f, max(load(lobe.film_ior + i), 1e-5f), fade);
    const Boundary top = dielectric_boundary(c, film);
    const Float difference = 2.0f * film * thickness * top.cos_t;
    Spectrum f;
    if (lobe.fresnel == Fresnel::f82 || lobe.fresnel == Fresnel::conductor) {
        f = over_metal(lobe, i, top, film, difference);
    } else {
        const Float eta = load(lobe.eta + i);
        const Boundary bottom = dielectric_boundary(top.cos_t, eta / film);
        f = {film_channel(top, bottom, difference, 0), film_channel(top, bottom, difference, 1),
             film_channel(top, bottom, difference, 2)};
        if (lobe.fresnel == Fresnel::schlick) f = saturate(scaled_by_f0(f, load_rgb(lobe.f0, i), eta));
    }
    return select(there, f, plain);
}

}  // namespace cardioid::CD_ISA_NS
