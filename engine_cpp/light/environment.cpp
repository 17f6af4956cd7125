// SPDX-License-Identifier: GPL-3.0-or-later
#include "light/environment.h"

#include "light/choose.h"

namespace cardioid::CD_ISA_NS {
namespace {

/// Largest i in [0, n) with cdf[base + i] <= u; cells of no width are never found.
Int find_cell(const float* cdf, Int base, int n, Float u) {
    Int low = 0;
    for (int left = n; left > 1; left -= left / 2) {
        const Int middle = low + Int(left / 2);
        low = select(gather(cdf, base + middle) <= u, middle, low);
    }
    return low;
}

/// Density of one cell: its two probabilities over its solid angle.
Float cell_density(const light::EnvironmentData& env, const light::DirectionTable& table, Int row, Int column) {
    const Int base = row * Int(env.width + 1) + column;
    const Float in_row = gather(table.conditional, base + Int(1)) - gather(table.conditional, base);
    const Float of_row = gather(table.marginal, row + Int(1)) - gather(table.marginal, row);
    const Float height = gather(env.row_z, row) - gather(env.row_z, row + Int(1));
    return in_row * of_row * static_cast<float>(env.width) / (k_two_pi * max(height, 1e-20f));
}

EnvironmentSample sample_map(const light::EnvironmentData& env, const light::DirectionTable& table, Float u, Float v) {
    const Int row = find_cell(table.marginal, Int(0), env.height, v);
    const Float m0 = gather(table.marginal, row), m1 = gather(table.marginal, row + Int(1));
    const Float within_row = saturate((v - m0) / max(m1 - m0, 1e-20f));
    const Int base = row * Int(env.width + 1);
    const Int column = find_cell(table.conditional, base, env.width, u);
    const Float c0 = gather(table.conditional, base + column), c1 = gather(table.conditional, base + column + Int(1));
    const Float within_column = saturate((u - c0) / max(c1 - c0, 1e-20f));

    const Float z0 = gather(env.row_z, row), z1 = gather(env.row_z, row + Int(1));
    const Float z = fma(within_row, z1 - z0, z0);
    const Float phi = (to_float(column) + within_column) * (k_two_pi / static_cast<float>(env.width)) - k_pi;
    const Float r = safe_sqrt((1.0f - z) * (1.0f + z));
    Float s, c;
    sincos(phi, s, c);
    return {{r * c, r * s, z}, cell_density(env, table, row, column)};
}

Float map_density(const light::EnvironmentData& env, const light::DirectionTable& table, Vec3 d) {
    const Float across = sqrt(fma(d.x, d.x, d.y * d.y));
    const Float polar = atan2(across, d.z) * k_inv_pi;
    const Float azimuth = (atan2(d.y, d.x) + k_pi) * (1.0f / k_two_pi);
    const Int row = min(to_int(polar * static_cast<float>(env.height)), Int(env.height - 1));
    const Int column = min(to_int(azimuth * static_cast<float>(env.width)), Int(env.width - 1));
    return cell_density(env, table, max(row, Int(0)), max(column, Int(0)));
}

}  // namespace

EnvironmentSample sample_environment(const light::LightData& lights, LightReceiver at, Float u, Float v) {
    const light::EnvironmentData& env = lights.environment;
    if (!env.constant) return sample_map(env, env.seen, u, v);
    const AllAround around = sample_all_around(at, u, v);
    return {around.wi, around.pdf};
}

Float environment_density(const light::LightData& lights, LightReceiver at, Vec3 d) {
    const light::EnvironmentData& env = lights.environment;
    return env.constant ? pdf_all_around(at, d) : map_density(env, env.seen, d);
}

EnvironmentSample sample_sent_direction(const light::LightData& lights, Float u, Float v) {
    const light::EnvironmentData& env = lights.environment;
    if (!env.constant) return sample_map(env, env.sent, u, v);
    const Vec3 none{0.0f, 0.0f, 0.0f};
    const AllAround around = sample_all_around({none, none}, u, v);
    return {around.wi, around.pdf};
}

Float sent_direction_density(const light::LightData& lights, Vec3 d) {
    const light::EnvironmentData& env = lights.environment;
    const Vec3 none{0.0f, 0.0f, 0.0f};
    return env.constant ? pdf_all_around({none, none}, d) : map_density(env, env.sent, d);
}

Float pdf_environment(const light::LightData& lights, LightReceiver at, Vec3 d, Mask active) {
    if (lights.environment.emitter < 0) return 0.0f;
    const Float chosen = pick_probability(lights, at, Int(lights.environment.emitter), active);
    return select(active, chosen * environment_density(lights, at, d), Float(0.0f));
}

}  // namespace cardioid::CD_ISA_NS
