// SPDX-License-Identifier: GPL-3.0-or-later
// Writes the tables of tables.h as a C++ source file. Runs at build time. Each entry is a midpoint sum over the visible
// facet normals, in double; no random numbers, so that every build has the same tables.
#include "bsdf/tables.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <vector>

namespace {

using cardioid::bsdf::k_albedo_size;
using cardioid::bsdf::k_glass_size;
constexpr double k_pi = 3.14159265358979323846;

double sqr(double x) { return x * x; }

/// Directions in the plane frame of the normal; wo lies in the xz plane.
struct Vec {
    double x, y, z;
};
Vec normalized(Vec v) {
    const double l = std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z);
    return {v.x / l, v.y / l, v.z / l};
}

/// |v.z|·sqrt(1 + alpha² tan²)
double stretch(double alpha, double z) { return std::sqrt(sqr(alpha) * (1 - z * z) + z * z); }

/// Masking of the light direction given that of wo: G2/G1.
double masking(double alpha, double oz, double iz) {
    const double so = stretch(alpha, oz), si = stretch(alpha, iz);
    return iz * (oz + so) / (so * iz + si * oz);
}

/// Calls visit(h, <wo,h>) for n·n visible normals of equal probability.
template <class Visit>
void for_visible_normals(double alpha, double mu, int n, Visit visit) {
    const Vec v = normalized({alpha * std::sqrt(1 - mu * mu), 0, mu});
    for (int a = 0; a < n; ++a) {
        // The half circle is enough: wo lies in the plane of symmetry.
        const double phi = k_pi * (a + 0.5) / n;
        for (int b = 0; b < n; ++b) {
            const double z = (1 - (b + 0.5) / n) * (1 + v.z) - v.z, r = std::sqrt(std::max(0.0, 1 - z * z));
            const Vec h = normalized({alpha * (r * std::cos(phi) + v.x), alpha * r * std::sin(phi), z + v.z});
            visit(h, h.x * std::sqrt(1 - mu * mu) + h.z * mu);
        }
    }
}

struct Fresnel {
    double reflect, cos_t;
};
Fresnel dielectric(double c, double eta) {
    const double g2 = eta * eta - 1 + c * c;
    if (g2 <= 0) return {1, 0};
    const double g = std::sqrt(g2), s = (c - g) / (c + g), p = (eta * eta * c - g) / (eta * eta * c + g);
    return {0.5 * (s * s + p * p), g / eta};
}

/// Inverse of z = sqrt(|eta - 1|/(eta + 1)); the last entry stands for an infinite index.
double eta_of(double z) {
    const double root = std::min(z * z, 0.995);
    return (1 + root) / (1 - root);
}
double position(double f, double eta) {
    const double f0 = sqr((eta - 1) / (eta + 1));
    return std::clamp((f - f0) / (1 - f0), 0.0, 1.0);
}

double ggx_albedo(double alpha, double mu) {
    constexpr int n = 96;
    double sum = 0;
    for_visible_normals(alpha, mu, n, [&](Vec h, double oh) {
        const double iz = 2 * oh * h.z - mu;
        if (iz > 0) sum += masking(alpha, mu, iz);
    });
    return sum / (n * n);
}

double glass_albedo(double alpha, double mu, double eta) {
    constexpr int n = 48;
    double sum = 0;
    for_visible_normals(alpha, mu, n, [&](Vec h, double oh) {
        const Fresnel f = dielectric(oh, eta);
        const double up = 2 * oh * h.z - mu, down = (oh / eta - f.cos_t) * h.z - mu / eta;
        if (up > 0) sum += f.reflect * masking(alpha, mu, up);
        if (down < 0 && f.cos_t > 0) sum += (1 - f.reflect) * masking(alpha, mu, -down);
    });
    return sum / (n * n);
}

template <class Position>
double schlick_albedo(double alpha, double mu, Position at) {
    constexpr int n = 48;
    double sum = 0, all = 0;
    for_visible_normals(alpha, mu, n, [&](Vec h, double oh) {
        const double iz = 2 * oh * h.z - mu;
        if (iz <= 0) return;
        const double w = masking(alpha, mu, iz);
        all += w;
        sum += w * at(oh);
    });
    return all > 0 ? sum / all : at(mu);
}

/// Entry k of n as (roughness → alpha) and (m → cosine); the ends are moved in to where the model is defined.
double alpha_of(int k, int n) { return sqr(std::max(1e-4, k / (n - 1.0))); }
double cosine_of(int k, int n) { return std::max(1e-5, sqr(k / (n - 1.0))); }

using Table = std::vector<double>;

/// 2∫μE(μ)dμ for row r of a table (r, m) of axis n, by the interpolation that the kernels use.
double mean_of(const double* table, int n, int r) {
    constexpr int steps = 4096;
    double sum = 0;
    for (int k = 0; k < steps; ++k) {
        const double mu = (k + 0.5) / steps, y = std::sqrt(mu) * (n - 1);
        const int j = std::min(static_cast<int>(y), n - 2);
        const double t = y - j;
        sum += 2 * mu * (table[j * n + r] * (1 - t) + table[(j + 1) * n + r] * t);
    }
    return sum / steps;
}

template <class Entry>
Table table2(int n, Entry entry) {
    Table t;
    for (int m = 0; m < n; ++m)
        for (int r = 0; r < n; ++r) t.push_back(entry(alpha_of(r, n), cosine_of(m, n)));
    return t;
}
template <class Entry>
Table table3(int n, Entry entry) {
    Table t;
    for (int z = 0; z < n; ++z) {
        const double eta = eta_of(std::max(z / (n - 1.0), 0.02));
        const Table slice = table2(n, [&](double alpha, double mu) { return entry(alpha, mu, eta); });
        t.insert(t.end(), slice.begin(), slice.end());
    }
    return t;
}
Table means(const Table& table, int n) {
    Table t;
    for (std::size_t slice = 0; slice < table.size(); slice += n * n)
        for (int r = 0; r < n; ++r) t.push_back(mean_of(table.data() + slice, n, r));
    return t;
}

/// CIE 1931 colour matching functions by the fits of Wyman, Sloan & Shirley 2013; wavelength in nm.
std::array<double, 3> color_matching(double wavelength) {
    const auto lobe = [wavelength](double height, double at, double below, double above) {
        return height * std::exp(-0.5 * sqr((wavelength - at) / (wavelength < at ? below : above)));
    };
    return {lobe(1.056, 599.8, 37.9, 31.0) + lobe(0.362, 442.0, 16.0, 26.7) + lobe(-0.065, 501.1, 20.4, 26.2),
            lobe(0.821, 568.8, 46.9, 40.5) + lobe(0.286, 530.9, 16.3, 31.1),
            lobe(1.217, 437.0, 11.8, 36.0) + lobe(0.681, 459.0, 26.0, 13.8)};
}

/// See k_film_response; Rec.709.
Table film_response() {
    using cardioid::bsdf::k_film_size;
    constexpr double to_rgb[3][3] = {
        {3.2404542, -1.5371385, -0.4985314}, {-0.9692660, 1.8760108, 0.0415560}, {0.0556434, -0.2040259, 1.0572252}};
    Table t(6 * k_film_size);
    double whole[3] = {};
    for (int k = 0; k < k_film_size; ++k) {
        const double d = k * static_cast<double>(cardioid::bsdf::k_film_reach) / (k_film_size - 1);
        double xyz[6] = {};
        for (double wavelength = 360.5; wavelength < 830; wavelength += 1) {
            const std::array<double, 3> cmf = color_matching(wavelength);
            const double angle = 2 * k_pi * d / wavelength;
            for (std::size_t c = 0; c < 3; ++c) {
                xyz[c] += cmf[c] * std::cos(angle);
                xyz[3 + c] -= cmf[c] * std::sin(angle);
            }
        }
        for (int row = 0; row < 6; ++row) {
            const int c = row % 3, part = row - c;
            const double v = to_rgb[c][0] * xyz[part] + to_rgb[c][1] * xyz[part + 1] + to_rgb[c][2] * xyz[part + 2];
            if (k == 0 && part == 0) whole[c] = v;
            t[static_cast<std::size_t>(row * k_film_size + k)] = v / whole[c];
        }
    }
    return t;
}

void write(std::FILE* file, const char* name, const Table& table) {
    std::fprintf(file, "const float %s[%zu] = {", name, table.size());
    for (std::size_t k = 0; k < table.size(); ++k)
        std::fprintf(file, "%s%.8ef",
                     k == 0       ? ""
                     : k % 8 == 0 ? ",\n"
                                  : ", ",
                     std::abs(table[k]) < 1e-30 ? 1e-30 : table[k]);
    std::fprintf(file, "};\n\n");
}

}  // namespace

int main(int argc, char** argv) {
    std::FILE* file = argc == 2 ? std::fopen(argv[1], "w") : nullptr;
    if (file == nullptr) {
        std::fprintf(stderr, "usage: cardioid_bsdf_tables FILE\n");
        return 1;
    }
    std::fprintf(file, "// Written by make_tables.cpp.\n#include \"bsdf/tables.h\"\n\nnamespace cardioid::bsdf {\n\n");
    const Table albedo = table2(k_albedo_size, ggx_albedo);
    write(file, "k_ggx_albedo", albedo);
    write(file, "k_ggx_mean_albedo", means(albedo, k_albedo_size));
    const Table glass = table3(k_glass_size, glass_albedo);
    write(file, "k_glass_albedo", glass);
    write(file, "k_glass_mean_albedo", means(glass, k_glass_size));
    const Table inverse =
        table3(k_glass_size, [](double alpha, double mu, double eta) { return glass_albedo(alpha, mu, 1 / eta); });
    write(file, "k_glass_albedo_inverse", inverse);
    write(file, "k_glass_mean_albedo_inverse", means(inverse, k_glass_size));
    write(file, "k_schlick_dielectric", table3(k_glass_size, [](double alpha, double mu, double eta) {
              return schlick_albedo(alpha, mu, [eta](double c) { return position(dielectric(c, eta).reflect, eta); });
          }));
    write(file, "k_schlick_power5", table2(k_glass_size, [](double alpha, double mu) {
              return schlick_albedo(alpha, mu, [](double c) { return std::pow(1 - c, 5); });
          }));
    write(file, "k_film_response", film_response());
    std::fprintf(file, "}  // namespace cardioid::bsdf\n");
    return std::fclose(file) == 0 ? 0 : 1;
}
