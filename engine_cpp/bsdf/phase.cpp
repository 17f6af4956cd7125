// SPDX-License-Identifier: GPL-3.0-or-later
// Henyey & Greenstein 1941; Rayleigh; Draine 2003 (alpha 0 is Henyey–Greenstein, alpha 1 Cornette–Shanks); Fournier & Forand
// 1994 in Mobley's form of backscatter fraction and index; Mie by Jendersie & d'Eon 2023 (a mix of the first and Draine's).
#include "bsdf/phase.h"

#include "bsdf/fresnel.h"

namespace cardioid::CD_ISA_NS {

namespace {

using bsdf::PhaseKind;

constexpr float k_inv_4pi = 0.25f * k_inv_pi;
constexpr float k_isotropic_g = 1e-3f;

Float clamped_g(Float g) { return clamp(g, -0.999f, 0.999f); }

/// 1 + g² - 2g·cos without cancellation near cos = ±1.
Float hg_distance2(Float g, Float cosine) {
    const Float a = abs(g), c = copysign(1.0f, g) * cosine;
    return sqr(1.0f - a) + 2.0f * a * (1.0f - c);
}

Float hg(Float g, Float cosine) {
    const Float d = hg_distance2(g, cosine);
    return select(abs(g) < Float(k_isotropic_g), Float(k_inv_4pi),
                  k_inv_4pi * (1.0f - g * g) / max(d * sqrt(d), 1e-30f));
}
Float sample_hg(Float g, Float u) {
    const Float even = 1.0f - 2.0f * u;
    const Float k = (1.0f - g * g) / (1.0f - g * even);
    return select(abs(g) < Float(k_isotropic_g), even, (1.0f + g * g - k * k) / (2.0f * g));
}

Float rayleigh(Float cosine) { return 0.1875f * k_inv_pi * (1.0f + cosine * cosine); }
/// Inverts (cos³ + 3cos + 4)/8 by Cardano; the cube root is of a sum without cancellation.
Float sample_rayleigh(Float u) {
    const Float a = 2.0f - 4.0f * u;
    const Float root = pow(abs(a) + sqrt(1.0f + a * a), 1.0f / 3.0f);
    return copysign(root - 1.0f / root, a);
}

// ------------------------------------------------------------------------------------------------------------ Draine

struct Draine {
    Float g, alpha;
    Float norm;  ///< 1 + alpha(1 + 2g²)/3

    Draine(Float g_, Float alpha_) : g(clamped_g(g_)), alpha(max(alpha_, 0.0f)) {
        norm = 1.0f + alpha * (1.0f + 2.0f * g * g) * (1.0f / 3.0f);
    }
    Float value(Float cosine) const { return hg(g, cosine) * (1.0f + alpha * cosine * cosine) / norm; }
    /// Chance of a cosine from -1 up to the given one.
    Float up_to(Float cosine) const {
        const Mask small = abs(g) < Float(0.1f);
        if (all(small)) return series(cosine);
        const Float wide = select(small, Float(0.5f), g);
        const Float f = antiderivative(wide, cosine) - antiderivative(wide, -1.0f);
        return select(small, series(cosine), f * (1.0f - g * g) * 0.5f / norm);
    }

private:
    /// Of (1 + alpha·t²)/(1 + q² - 2qt)^(3/2).
    Float antiderivative(Float q, Float cosine) const {
        const Float a = 1.0f + q * q, s = sqrt(hg_distance2(q, cosine)), k = 0.25f * alpha / (q * q);
        return ((1.0f + k * a * a) / s + k * s * (2.0f * a - s * s * (1.0f / 3.0f))) / q;
    }
    /// The same integral from -1 for small g, where the closed form cancels: 1/(…)^(3/2) = Σ gⁿ P'ₙ₊₁, by parts.
    Float series(Float x) const {
        constexpr int k_terms = 7;
        Float p[k_terms + 3];
        p[0] = 1.0f;
        p[1] = x;
        for (int n = 1; n < k_terms + 2; ++n) {
            const auto m = static_cast<float>(n);
            p[n + 1] = ((2 * m + 1) * x * p[n] - m * p[n - 1]) / (m + 1);
        }
        // ∫ from -1 of P_k; of the constant it is 1 + x.
        const auto whole = [&](int k) {
            return k == 0 ? 1.0f + x : (p[k + 1] - p[k - 1]) / static_cast<float>(2 * k + 1);
        };
        const Float q = select(abs(g) < Float(0.1f), g, Float(0.0f));
        Float sum = 0.0f, power = 1.0f;
        for (int n = 0; n < k_terms; ++n) {
            const auto m = static_cast<float>(n + 1);
            const float at_start = (n + 1) % 2 == 0 ? 1.0f : -1.0f;
            const Float moment = ((m + 1) * whole(n + 2) + m * whole(n)) / (2 * m + 1);
            sum += power * ((1.0f + alpha * x * x) * p[n + 1] - (1.0f + alpha) * at_start - 2.0f * alpha * moment);
            power *= q;
        }
        return 0.5f * (1.0f - q * q) * sum / norm;
    }
};

// ---------------------------------------------------------------------------------------------------- Fournier–Forand

struct FournierForand {
    Float index, v, back;
    FournierForand(Float backscatter, Float n) : index(max(n, 1.001f)) {
        const Float b = clamp(abs(backscatter), 1e-4f, 0.499f), d90 = delta(0.5f), d180 = delta(1.0f);
        v = -log(2.0f * b * (d90 - 1.0f) + 1.0f) / log(d90);
        back = (pow(d180, -v) - 1.0f) / (d180 - 1.0f);
    }
    Float delta(Float sin2_half) const { return 4.0f * sin2_half / (3.0f * sqr(index - 1.0f)); }

    struct At {
        Float density, beyond;  ///< per steradian; chance of a larger cosine
    };
    At at(Float cosine) const {
        const Float s2 = max(0.5f * (1.0f - cosine), 1e-7f);
        const Float d = delta(s2), power = pow(d, v), md = 1.0f - d, mp = 1.0f - power;
        const Mask near_one = abs(md) < Float(1e-3f);
        const Float safe = select(near_one, Float(1.0f), md), inv = 1.0f / s2;
        const Float p = (v * md - mp + (d * mp - v * md) * inv) * k_inv_4pi / (safe * safe * power);
        const Float p1 = v * (v - 1.0f - (v + 1.0f) * inv) * (0.5f * k_inv_4pi) +
                         v * (v + 1.0f) * md * (2.0f * (v - 1.0f) - (2.0f * v + 1.0f) * inv) * (k_inv_4pi / 6.0f);
        const Float c = (1.0f - power * d - mp * s2) / (safe * power);
        const Float c1 = 1.0f + v * (1.0f - s2) * (1.0f - 0.5f * (v + 1.0f) * md);
        return {max(select(near_one, p1, p) + back * (k_inv_4pi * 0.25f) * (3.0f * cosine * cosine - 1.0f), 0.0f),
                select(near_one, c1, c) + back * 0.125f * cosine * (1.0f - cosine * cosine)};
    }
};

/// Cosine at which the rising `up_to` reaches u: Newton's steps, halving the bracket where they leave it.
template <class UpTo, class Density>
Float invert(Float u, Float start, UpTo up_to, Density density) {
    Float low = -1.0f, high = 1.0f, x = start;
    for (int k = 0; k < 24; ++k) {
        const Float f = up_to(x) - u;
        const Mask over = f > Float(0.0f);
        high = select(over, x, high);
        low = select(over, low, x);
        const Float next = x - f / max(k_two_pi * density(x), 1e-6f);
        const Mask inside = (next > low) & (next < high);
        const Float y = select(inside, next, 0.5f * (low + high));
        if (all(abs(y - x) < Float(1e-7f))) return y;
        x = y;
    }
    return x;
}

// --------------------------------------------------------------------------------------------------------------- Mie

struct Mie {
    Float g, g_draine, alpha, share;  ///< share of Draine's part
};

/// Fits by diameter in µm: Rayleigh-like under 0.1, then two ranges in its logarithm, and large droplets.
Mie mie(Float diameter) {
    const Float d = max(diameter, 0.0f), l = log(max(d, 0.01f));
    const Mask tiny = d <= Float(0.1f), small = d < Float(1.5f), medium = d < Float(5.0f);
    const Float large_d = max(d, 5.0f), l2 = max(l, 0.1f);
    Mie m{exp(-0.0990567f / (large_d - 1.67154f)), exp(-2.20679f / (large_d + 3.91029f) - 0.428934f),
          exp(3.62489f - 8.29288f / (large_d + 5.52825f)), exp(-0.599085f / (large_d - 0.641583f) - 0.665888f)};
    const Float wave = cos(5.68947f * (log(l2) - 0.0292149f));
    m.g = select(medium, 0.0604931f * log(l2) + 0.940256f, m.g);
    m.g_draine = select(medium, 0.500411f - 0.081287f / (tan(l2) - 2.0f * l2 + 1.27551f), m.g_draine);
    m.alpha = select(medium, 7.30354f * l + 6.31675f, m.alpha);
    m.share = select(medium, 0.026914f * (l - wave) + 0.3764f, m.share);
    const Float ratio = (l - 0.238604f) * (l + 1.00667f) / (0.507522f - 0.15677f * l);
    const Float phase = 1.19692f * cos(ratio) + 1.37932f * l + 0.0625835f;
    m.g = select(small, 0.862f - 0.143f * l * l, m.g);
    m.g_draine = select(small, 0.379685f * cos(phase) + 0.344213f, m.g_draine);
    m.alpha = select(small, Float(250.0f), m.alpha);
    m.share = select(small, 0.146209f * cos(3.38707f * l + 2.11193f) + 0.316072f + 0.0778917f * l, m.share);
    m.g = select(tiny, 13.8f * d * d, m.g);
    m.g_draine = select(tiny, 1.1456f * d * sin(9.29044f * d), m.g_draine);
    m.share = select(tiny, 0.252977f - 312.983f * pow(d, 4.3f), m.share);
    m.g = clamped_g(m.g);
    m.share = saturate(m.share);
    return m;
}

Float sample_draine(const Draine& d, Float u) {
    return invert(
        u, Float(0.0f), [&](Float x) { return d.up_to(x); }, [&](Float x) { return d.value(x); });
}

Float sample_cosine_of(PhaseKind kind, Vec3 parameter, Float u) {
    switch (kind) {
        case PhaseKind::rayleigh: return sample_rayleigh(u);
        case PhaseKind::draine: return sample_draine({parameter.x, parameter.y}, u);
        case PhaseKind::fournier_forand: {
            const FournierForand f(parameter.x, parameter.y);
            return invert(
                1.0f - u, Float(0.64f), [&](Float x) { return 1.0f - f.at(x).beyond; },
                [&](Float x) { return f.at(x).density; });
        }
        case PhaseKind::mie: {
            const Mie m = mie(parameter.x);
            const Mask draine = u < m.share;
            const Float v = select(draine, u / max(m.share, 1e-6f), (u - m.share) / max(1.0f - m.share, 1e-6f));
            const Float plain = sample_hg(m.g, saturate(v));
            if (none(draine)) return plain;
            return select(draine, sample_draine({m.g_draine, m.alpha}, saturate(v)), plain);
        }
        case PhaseKind::henyey_greenstein: break;
    }
    return sample_hg(clamped_g(parameter.x), u);
}

}  // namespace

Float eval_phase(PhaseKind kind, Vec3 parameter, Float cosine) {
    switch (kind) {
        case PhaseKind::rayleigh: return rayleigh(cosine);
        case PhaseKind::draine: return Draine(parameter.x, parameter.y).value(cosine);
        case PhaseKind::fournier_forand: return FournierForand(parameter.x, parameter.y).at(cosine).density;
        case PhaseKind::mie: {
            const Mie m = mie(parameter.x);
            return mix(hg(m.g, cosine), Draine(m.g_draine, m.alpha).value(cosine), m.share);
        }
        case PhaseKind::henyey_greenstein: break;
    }
    return hg(clamped_g(parameter.x), cosine);
}

PhaseSample sample_phase(PhaseKind kind, Vec3 parameter, Vec3 wo, Float u0, Float u1) {
    const Float cosine = clamp(sample_cosine_of(kind, parameter, u0), -1.0f, 1.0f);
    Float s, c;
    sincos(k_two_pi * u1, s, c);
    const Float sine = safe_sqrt(1.0f - cosine * cosine);
    const Vec3 wi = Frame(-wo).to_world({sine * c, sine * s, cosine});
    return {wi, eval_phase(kind, parameter, cosine)};
}

Float mean_cosine(PhaseKind kind, Vec3 parameter) {
    const auto draine = [](Float g, Float alpha) {
        const Float gg = g * g;
        return g * (1.0f + alpha * (3.0f + 2.0f * gg) * 0.2f) / (1.0f + alpha * (1.0f + 2.0f * gg) * (1.0f / 3.0f));
    };
    switch (kind) {
        case PhaseKind::rayleigh: return Float(0.0f);
        case PhaseKind::draine: return draine(clamped_g(parameter.x), max(parameter.y, 0.0f));
        case PhaseKind::fournier_forand: return Float(1.0f);
        case PhaseKind::mie: {
            const Mie m = mie(parameter.x);
            return mix(m.g, draine(clamped_g(m.g_draine), m.alpha), m.share);
        }
        case PhaseKind::henyey_greenstein: break;
    }
    return clamped_g(parameter.x);
}

}  // namespace cardioid::CD_ISA_NS
