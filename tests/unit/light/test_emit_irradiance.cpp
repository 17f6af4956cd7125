// SPDX-License-Identifier: GPL-3.0-or-later
// Photons light a patch as sample_light does: two unbiased estimates of its mean irradiance, which Welch's test compares and
// which have to agree within 1 % (width 16).
#include "statistics/ttest.h"

#include <gtest/gtest.h>

#include "emit_tests.h"

namespace cardioid::light_tests {
namespace {

constexpr double k_level = 1e-4;
/// The same source at all widths: the narrow ones are slower and are looked at less closely.
constexpr double k_bound = W == 16 ? 0.01 : W == 8 ? 0.02 : 0.04;
constexpr int k_batch = 1 << 16;
constexpr int k_most_batches = 600;

/// A square that one side of counts; `s` and `t` are unit.
struct Patch {
    const char* name;
    Float3 center, normal;
    float half;
    Float3 s() const {
        return normalize(cross(normal, std::fabs(normal.x) < 0.7f ? Float3{1, 0, 0} : Float3{0, 1, 0}));
    }
    Float3 t() const { return cross(normal, s()); }
    double area() const { return 4.0 * static_cast<double>(half) * static_cast<double>(half); }

    bool is_hit_by(const Photon& photon) const {
        const float along = dot(photon.direction, normal);
        if (!photon.valid || !(along < 0)) return false;
        const float distance = dot(center - photon.origin, normal) / along;
        if (!(distance > photon.t_min && distance < photon.t_max)) return false;
        const Float3 off = photon.origin + photon.direction * distance - center;
        return std::fabs(dot(off, s())) < half && std::fabs(dot(off, t())) < half;
    }
};

const Patch k_floor{"floor", {0, 0, 0}, {0, 0, 1}, 0.8f};
const Patch k_aside{"aside", {1.2f, 0.5f, 0.7f}, normalize(Float3{-0.5f, -0.2f, 0.6f}), 0.5f};
/// Within the larger sphere lamps; facing disks look far from a sphere here.
Patch near_patch(const Source& source) {
    const float radius = source.lamps.empty() ? 0 : source.lamps.front().desc.radius;
    return {"near", {0.4f, -0.15f, 1.75f}, normalize(Float3{0.1f, -0.2f, 1}), std::clamp(0.45f * radius, 0.15f, 0.25f)};
}
/// Light comes from below.
const Patch k_ceiling{"ceiling", {0.2f, -0.3f, 2.4f}, {0, 0, -1}, 0.4f};

statistics::Moments by_sampling(const LightTable& table, const Source& source, const Patch& patch) {
    statistics::Moments m;
    Uniform uniform(11);
    for (int batch = 0; batch < k_most_batches; ++batch) {
        for (int k = 0; k < k_batch; k += W) {
            const Vec3 u = uniform.lanes(), place = uniform.lanes();
            LightReceiver at{u, u};
            for (int i = 0; i < W; ++i) {
                const float a = (2 * place.x[i] - 1) * patch.half, b = (2 * place.y[i] - 1) * patch.half;
                set_lane(at.p, i, patch.center + patch.s() * a + patch.t() * b);
                set_lane(at.n, i, patch.normal);
            }
            const LightSample s = sample_light(table.data(), at, u, mask_of(true));
            for (int i = 0; i < W; ++i) {
                const Float3 wi = lane(s.wi, i);
                const float value =
                    source.radiance_at(lane(s.radiance, i), wi).x * std::max(0.0f, dot(wi, patch.normal));
                m.add(((bits(s.valid) >> i) & 1) != 0 ? static_cast<double>(value / s.pdf[i]) : 0.0);
            }
        }
        if (std::sqrt(m.variance_of_mean()) < 0.08 * k_bound * std::fabs(m.mean)) break;
    }
    return m;
}

/// Photons that forget where they count.
enum class Fault { none, everywhere };

template <class Choose>
statistics::Moments by_photons(const LightTable& table, const Source& source, const Patch& patch, Fault fault,
                               Choose choose) {
    statistics::Moments m;
    for (int batch = 0; batch < k_most_batches; ++batch) {
        for_each_photon(table, k_batch, 1000u + static_cast<std::uint32_t>(batch), choose,
                        [&](Photon photon, float probability) {
                            if (fault == Fault::everywhere) {
                                photon.t_min = 0;
                                photon.t_max = 1e30f;
                            }
                            const Float3 flux = photon.emitter == table.data().environment.emitter
                                                    ? source.radiance_at(photon.flux, photon.direction * -1.0f)
                                                    : photon.flux;
                            const double value = static_cast<double>(flux.x / probability) / patch.area();
                            m.add(patch.is_hit_by(photon) ? value : 0.0);
                        });
        const bool hit = m.mean != 0;
        if (hit && std::sqrt(m.variance_of_mean()) < 0.15 * k_bound * std::fabs(m.mean)) break;
        if (!hit && batch == 15) break;
    }
    return m;
}

statistics::Moments by_photons(const LightTable& table, const Source& source, const Patch& patch, Fault fault) {
    const int emitter = only_emitter(table);
    return by_photons(table, source, patch, fault, [&](float) { return std::pair<int, float>(emitter, 1.0f); });
}

statistics::Moments scaled(statistics::Moments m, double factor) {
    m.mean *= factor;
    m.m2 *= factor * factor;
    return m;
}

void expect_same(const statistics::Moments& photons, const statistics::Moments& samples) {
    const statistics::TResult r = statistics::welch_test(photons, samples);
    EXPECT_FALSE(r.rejected(k_level)) << photons.mean << " instead of " << samples.mean << " ± " << r.error;
    EXPECT_TRUE(r.equivalent(k_bound * std::fabs(samples.mean), 0.05))
        << photons.mean << " instead of " << samples.mean << " ± " << r.error << " from " << photons.n << " photons";
}

class Emission : public testing::TestWithParam<Source> {};
INSTANTIATE_TEST_SUITE_P(All, Emission, testing::ValuesIn(all_sources()),
                         [](const auto& which) { return which.param.name; });

TEST_P(Emission, LightsPatchesAsSamplingDoes) {
    const Source& source = GetParam();
    for (const Patch& patch : {k_floor, k_aside, near_patch(source), k_ceiling}) {
        // Few of the photons of so large a lamp cross a patch inside of it; the inside of the other spot is looked at.
        if (source.name == "spot_narrow" && patch.name == std::string("near")) continue;
        SCOPED_TRACE(patch.name);
        // The sphere around the casters holds the patch: the few photons beside it carry hundreds of times as much.
        const LightTable aimed =
            table_of(source, {-2, -2, -0.1f}, {2, 2, 2.5f}, casters_in(patch.center, 0.85f * patch.half));
        ASSERT_GE(only_emitter(aimed), 0);
        const statistics::Moments samples = by_sampling(aimed, source, patch);
        const statistics::Moments photons = by_photons(aimed, source, patch, Fault::none);
        if (samples.mean == 0) {
            EXPECT_EQ(photons.mean, 0);
            continue;
        }
        expect_same(photons, samples);
        EXPECT_TRUE(statistics::welch_test(scaled(photons, 1.05), samples).rejected(k_level)) << "would not notice 5 %";
    }
}

/// Without casters, and with casters that are not where the patch is: the other half of the emission.
TEST_P(Emission, LightsWhatItDoesNotAimAt) {
    const Source& source = GetParam();
    const light::PhotonTargets elsewhere = casters_in({-1.1f, 0.8f, 0.4f}, 0.2f);
    for (const light::PhotonTargets& targets : {light::PhotonTargets{}, elsewhere}) {
        SCOPED_TRACE(targets.any_casters);
        const LightTable table = table_of(source, {-1.5f, -1.5f, -0.1f}, {1.5f, 1.5f, 1.5f}, targets);
        expect_same(by_photons(table, source, k_floor, Fault::none), by_sampling(table, source, k_floor));
    }
}

/// Photons know where they count: without it, spheres would light twice, and disks what they do not face.
TEST(EmissionNear, RangesCount) {
    for (const Source& source : all_sources()) {
        if (source.name != "facing_disk" && source.name != "sphere") continue;
        const Patch patch = source.name == "sphere" ? k_floor : near_patch(source);
        const LightTable table = table_of(source, {-2, -2, -0.1f}, {2, 2, 2.5f}, casters_in(patch.center, patch.half));
        const statistics::Moments samples = by_sampling(table, source, patch);
        EXPECT_TRUE(
            statistics::welch_test(by_photons(table, source, patch, Fault::everywhere), samples).rejected(k_level))
            << source.name;
    }
}

/// Lanes with different emitters, chosen by their power.
TEST(EmissionOfMany, LightsPatchesAsSamplingDoes) {
    Source all;
    for (const Source& s : all_sources()) {
        all.lamps.insert(all.lamps.end(), s.lamps.begin(), s.lamps.end());
        all.triangles.insert(all.triangles.end(), s.triangles.begin(), s.triangles.end());
        if (s.name == "world") {
            all.has_world = true;
            all.world = s.world;
        }
    }
    for (std::size_t i = 0; i < all.triangles.size(); ++i) all.triangles[i].triangle = static_cast<std::int32_t>(i);
    for (const Patch& patch : {k_floor, k_aside}) {
        SCOPED_TRACE(patch.name);
        const LightTable table = table_of(all, {-2, -2, -0.1f}, {2, 2, 2.5f}, casters_in(patch.center, patch.half));
        const light::LightData& data = table.data();
        std::vector<float> sums(static_cast<std::size_t>(data.emitter_count));
        float total = 0;
        for (std::size_t i = 0; i < sums.size(); ++i) sums[i] = total += data.emission_power[i];
        const auto choose = [&](float u) {
            const auto found = std::upper_bound(sums.begin(), sums.end() - 1, u * total);
            const auto id = static_cast<int>(found - sums.begin());
            return std::pair<int, float>(id, data.emission_power[id] / total);
        };
        expect_same(by_photons(table, all, patch, Fault::none, choose), by_sampling(table, all, patch));
    }
}

/// From millimetres to ten kilometres, and far from the middle of the coordinates.
TEST(EmissionScale, SunOfLargeAndSmallScenes) {
    for (const Source& source : all_sources()) {
        if (source.name != "sun" && source.name != "world") continue;
        for (const float size : {1e-3f, 1.0f, 1e4f}) {
            for (const Float3 shift : {Float3{0, 0, 0}, Float3{100, -50, 20} * size}) {
                SCOPED_TRACE(source.name + " " + std::to_string(size) + " " + std::to_string(shift.x));
                const Patch patch{"", shift + Float3{0.1f, 0, 0} * size, {0, 0, 1}, 0.5f * size};
                const LightTable table =
                    table_of(source, shift + Float3{-1, -1, -0.1f} * size, shift + Float3{1, 1, 0.5f} * size,
                             casters_in(patch.center, 0.5f * size));
                expect_same(by_photons(table, source, patch, Fault::none), by_sampling(table, source, patch));
            }
        }
    }
}

}  // namespace
}  // namespace cardioid::light_tests
